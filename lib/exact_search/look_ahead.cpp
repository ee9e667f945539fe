#include "exact_search/look_ahead.hpp"

#include <algorithm>

namespace cairn {

LookAhead::LookAhead(const ObservedWalk& walk)
    : walk_(&walk), corners_to_come_(static_cast<std::size_t>(walk.step_count()) + 1, 0) {
  std::int32_t kinds = 0;
  for (StarId star{0}; star.value < walk.star_count(); ++star.value) {
    for (const auto& [view, count] : walk.facts(star).views) {
      kinds = std::max(kinds, view.value + 1);
    }
  }
  slack_.assign(static_cast<std::size_t>(kinds), 0);
  for (int number = walk.step_count() - 1; number >= 0; --number) {
    const ObservedStep& step = walk.step(number);
    change_by_follow(step, 1);
    corners_to_come_[static_cast<std::size_t>(number)] =
        corners_to_come(number + 1) + (walk.facts(step.star).is_corner ? 1 : 0);
  }
  change_by_place(walk.start(), -1);
}

bool LookAhead::allows_start() const {
  return std::all_of(slack_.begin(), slack_.end(), [](std::int32_t slack) { return slack >= 0; });
}

bool LookAhead::allows_follow(const ObservedStep& step) const {
  const int ends = step.departure_view == step.arrival_view ? 2 : 1;
  return slack_[step.departure_view.index()] >= ends && slack_[step.arrival_view.index()] >= ends;
}

bool LookAhead::allows_place(StarId star) const {
  const auto& views = walk_->facts(star).views;
  return std::all_of(views.begin(), views.end(),
                     [&](const auto& view) { return slack_[view.first.index()] >= view.second; });
}

void LookAhead::change_by_follow(const ObservedStep& step, int by) {
  slack_[step.departure_view.index()] += by;
  slack_[step.arrival_view.index()] += by;
}

void LookAhead::change_by_place(StarId star, int by) {
  for (const auto& [view, count] : walk_->facts(star).views) {
    slack_[view.index()] += by * count;
  }
}

}  // namespace cairn
