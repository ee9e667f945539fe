#pragma once

#include <vector>

#include "layout/travel_residual.hpp"

namespace cairn {

/// Travels between places, found from either place; both only ever grow. Part of the place layout;
/// not for other layers.
class TravelGraph {
 public:
  [[nodiscard]] int place_count() const { return static_cast<int>(last_end_.size()); }
  [[nodiscard]] int travel_count() const { return static_cast<int>(travels_.size()); }
  [[nodiscard]] const TravelResidual& travel(int index) const {
    return travels_[static_cast<std::size_t>(index)];
  }

  void add_place() { last_end_.push_back(-1); }
  /// @pre both places are known
  void add_travel(const TravelResidual& travel) {
    travels_.push_back(travel);
    link(travel.from);
    link(travel.to);
  }
  /// Takes back the travel added last.
  /// @pre there is one
  void remove_last_travel() {
    unlink(travels_.back().to);
    unlink(travels_.back().from);
    travels_.pop_back();
  }

  /// Calls visit(index of travel) for all travels of a place, the newest first; twice for one from
  /// the place to itself.
  template <typename Visit>
  void for_each_travel_of(int place, Visit visit) const {
    for (int end = last_end_[static_cast<std::size_t>(place)]; end >= 0;
         end = previous_end_[static_cast<std::size_t>(end)]) {
      visit(end / 2);
    }
  }

 private:
  void link(int place) {
    int& last = last_end_[static_cast<std::size_t>(place)];
    previous_end_.push_back(last);
    last = static_cast<int>(previous_end_.size()) - 1;
  }
  void unlink(int place) {
    last_end_[static_cast<std::size_t>(place)] = previous_end_.back();
    previous_end_.pop_back();
  }

  std::vector<TravelResidual> travels_;
  std::vector<int> last_end_;      ///< By place: its newest end of a travel, -1 for none.
  std::vector<int> previous_end_;  ///< By end, two for each travel: the one before at its place.
};

}  // namespace cairn
