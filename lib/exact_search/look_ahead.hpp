#pragma once

#include <cstdint>
#include <vector>

#include "exact_search/observed_walk.hpp"

namespace cairn {

/// Tells which maps cannot be without pending gateways at the end of a known experience: for every
/// kind of gateway, no more may be pending than there are ends of travels still to come.
///
/// The slack of a kind is the difference of the two. Linking two pending gateways keeps it; passing
/// a link uses up one end each of two kinds; a new place adds its gateways, of which the travel
/// itself links two.
class LookAhead {
 public:
  explicit LookAhead(const ObservedWalk& walk);

  /// Whether anything can be closed at all.
  [[nodiscard]] bool allows_start() const;
  [[nodiscard]] bool allows_follow(const ObservedStep& step) const;
  [[nodiscard]] bool allows_place(StarId star) const;

  void follow(const ObservedStep& step) { change_by_follow(step, -1); }
  void undo_follow(const ObservedStep& step) { change_by_follow(step, 1); }
  void add_place(StarId star) { change_by_place(star, -1); }
  void remove_place(StarId star) { change_by_place(star, 1); }

  [[nodiscard]] std::size_t view_count() const { return slack_.size(); }
  /// Ends of travels to come, less pending gateways that look like this.
  [[nodiscard]] int slack(ViewClassId view) const { return slack_[view.index()]; }

  /// Arrivals at places of type L from this step on.
  [[nodiscard]] int corners_to_come(int step) const {
    return corners_to_come_[static_cast<std::size_t>(step)];
  }

 private:
  void change_by_follow(const ObservedStep& step, int by);
  void change_by_place(StarId star, int by);

  const ObservedWalk* walk_;
  std::vector<std::int32_t> slack_;            // By view class.
  std::vector<std::int32_t> corners_to_come_;  // By step; the last entry is 0.
};

}  // namespace cairn
