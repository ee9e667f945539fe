#include "exact_search/quadrangulation.hpp"

namespace cairn {
namespace {

constexpr int kCorners = 4;

std::size_t index(int position) {
  return static_cast<std::size_t>(position);
}

}  // namespace

bool Quadrangulation::may_exist(const FaceRing& ring, const CanLink& can_link) {
  const auto size = static_cast<int>(ring.stretches.size());
  if (size % 2 != 0) {
    return false;
  }
  stretch_ = ring.stretches;
  next_.resize(stretch_.size());
  previous_.resize(stretch_.size());
  for (int position = 0; position < size; ++position) {
    if (stretch_[index(position)] > kCorners) {
      return false;
    }
    next_[index(position)] = (position + 1) % size;
    previous_[index(position)] = (position + size - 1) % size;
  }
  bool is_undecided = false;
  int at = 0;
  for (int left = size, idle = 0; left > 0;) {
    if (idle > left) {
      return is_undecided;
    }
    if (stretch_[index(at)] != kCorners || (left > 2 && !is_forced(at, ring, can_link))) {
      is_undecided = is_undecided || stretch_[index(at)] == kCorners;
      at = next_[index(at)];
      ++idle;
      continue;
    }
    const int before = previous_[index(at)];
    if (left == 2) {
      return stretch_[index(before)] == kCorners && cut_off(at, ring, can_link);
    }
    if (!cut_off(at, ring, can_link)) {
      return false;
    }
    at = before;
    left -= 2;
    idle = 0;
  }
  return true;
}

/// A path that passes one end straight on would have to be met again along a stretch without
/// corners, on both sides.
bool Quadrangulation::is_forced(int first, const FaceRing& ring, const CanLink& can_link) const {
  const int second = next_[index(first)];
  const ViewClassId first_view = ring.views[index(first)];
  const ViewClassId second_view = ring.views[index(second)];
  bool first_passes = false;
  bool second_passes = false;
  int at = first;
  do {
    const int after = next_[index(at)];
    if (stretch_[index(at)] == 0) {
      second_passes = second_passes || can_link(second_view, ring.views[index(at)]);
      first_passes = first_passes || can_link(first_view, ring.views[index(after)]);
    }
    at = after;
  } while (at != first);
  return !first_passes || !second_passes;
}

/// Links a position with the next one.
bool Quadrangulation::cut_off(int first, const FaceRing& ring, const CanLink& can_link) {
  const int second = next_[index(first)];
  if (!can_link(ring.views[index(first)], ring.views[index(second)])) {
    return false;
  }
  const int before = previous_[index(first)];
  const int after = next_[index(second)];
  if (before == second) {
    return true;
  }
  stretch_[index(before)] += stretch_[index(second)];
  next_[index(before)] = after;
  previous_[index(after)] = before;
  return stretch_[index(before)] <= kCorners;
}

}  // namespace cairn
