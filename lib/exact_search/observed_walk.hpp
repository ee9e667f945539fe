#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "exact_search/exploration.hpp"
#include "topology/star_catalogue.hpp"

namespace cairn {

/// What the searches ask of a star.
struct StarFacts {
  int gateway_count = 0;
  int fragment_count = 0;
  int terminated_ends = 0;  ///< Slots without a gateway.
  bool is_corner = false;   ///< Of type L.
  /// By gateway: corners (0 or 1) between it and the next one clockwise. None if both belong to one
  /// fragment.
  std::vector<std::int32_t> corners_after;
  int corner_count = 0;                            ///< Sum of corners_after.
  std::vector<std::pair<ViewClassId, int>> views;  ///< How many gateways look like this.
};

/// A travel in numbers.
struct ObservedStep {
  int turn = 0;
  StarId star;
  int arrival_gateway = 0;
  ViewClassId departure_view;  ///< Of the gateway by which the robot left.
  ViewClassId arrival_view;
};

/// An exploration as the searches use it: every star once, every view a number.
class ObservedWalk {
 public:
  /// @pre validate(exploration).ok()
  explicit ObservedWalk(const Exploration& exploration);

  [[nodiscard]] const StarCatalogue& stars() const { return stars_; }
  [[nodiscard]] const StarFacts& facts(StarId star) const { return facts_[star.index()]; }
  [[nodiscard]] int star_count() const { return static_cast<int>(facts_.size()); }
  [[nodiscard]] StarId start() const { return start_; }
  [[nodiscard]] int start_gateway() const { return start_gateway_; }
  [[nodiscard]] int step_count() const { return static_cast<int>(steps_.size()); }
  [[nodiscard]] const ObservedStep& step(int number) const {
    return steps_[static_cast<std::size_t>(number)];
  }

 private:
  StarId learn(const Star& star);

  StarCatalogue stars_;
  std::vector<StarFacts> facts_;
  StarId start_;
  int start_gateway_ = 0;
  std::vector<ObservedStep> steps_;
};

}  // namespace cairn
