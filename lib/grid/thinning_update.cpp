#include "grid/thinning_update.hpp"

#include <algorithm>
#include <functional>

#include "grid/shift_rows.hpp"

namespace cairn {
namespace {

constexpr unsigned kSides = 8;

}  // namespace

bool ThinningUpdate::is_of_size(int width, int height) const {
  return set.stride() == static_cast<std::size_t>(width) + 2 &&
         set.size() == set.stride() * (static_cast<std::size_t>(height) + 2);
}

void ThinningUpdate::clear(int width, int height) {
  const bool is_same_size = is_of_size(width, height);
  set.clear(width, height);
  kept.clear(width, height);
  left_.clear(width, height);
  if (is_same_size) {
    return;  // What is held of cells outside of the set is of no account.
  }
  squared.assign(set.size(), 0);
  pass_.assign(set.size(), kStays);
  was_.resize(set.size());
  is_doubted_.assign(set.size(), 0);
  pending_.assign(set.size(), 0);
  const auto stride = static_cast<std::int32_t>(set.stride());
  offsets_ = {1, stride + 1, stride, stride - 1, -1, -stride - 1, -stride, -stride + 1};
}

void ThinningUpdate::shift(Cell moved) {
  set.shift(moved);
  kept.shift(moved);
  left_.shift(moved);
  const auto width = static_cast<int>(set.stride());
  const auto height = static_cast<int>(set.size() / set.stride());
  shift_rows<std::int32_t>(moved, width, height, 0, &squared);
  shift_rows<Pass>(moved, width, height, kStays, &pass_);
}

void ThinningUpdate::thin(const std::vector<std::uint32_t>& order) {
  std::vector<std::uint32_t> candidates;
  candidates.reserve(order.size());
  for (const std::uint32_t at : order) {
    left_.add(at);
    pass_[at] = kStays;
    if (!kept.has(at)) {
      candidates.push_back(at);
    }
  }
  std::size_t before = candidates.size() + 1;
  for (Pass pass = 1; candidates.size() < before; ++pass) {
    before = candidates.size();
    std::size_t stay = 0;
    for (const std::uint32_t at : candidates) {
      if (is_simple(left_.neighbours_of(at))) {
        left_.remove(at);
        pass_[at] = pass;
      } else {
        candidates[stay++] = at;
      }
    }
    candidates.resize(stay);
  }
}

void ThinningUpdate::update(const std::vector<std::uint32_t>& seeds) {
  for (const std::uint32_t at : seeds) {
    left_.put(at, set.has(at));
    pass_[at] = kStays;
  }
  const Moment beginning;
  for (const std::uint32_t at : seeds) {
    doubt(at, beginning);
    doubt_neighbours(at, beginning);
  }
  while (!looks_.empty()) {
    std::pop_heap(looks_.begin(), looks_.end(), std::greater<>());
    const Moment now = looks_.back();
    looks_.pop_back();
    look(now);
  }
  for (const std::uint32_t at : doubted_) {
    is_doubted_[at] = 0;
    pending_[at] = 0;
  }
  doubted_.clear();
}

ThinningUpdate::Moment ThinningUpdate::next_look(std::uint32_t at, Moment after) const {
  const std::uint64_t rank = rank_of(at);
  return {rank > after.rank ? std::max(after.pass, 1U) : after.pass + 1, rank};
}

/// Whether a cell is still in the set when another one is looked at.
bool ThinningUpdate::is_there(std::uint32_t at, Moment now) const {
  return set.has(at) && (pass_[at] == kStays || Moment{pass_[at], rank_of(at)} > now);
}

void ThinningUpdate::schedule(Moment look) {
  // Most looks are asked for several times.
  if (look.pass < kPassesNoted) {
    std::uint32_t& pending = pending_[cell_of(look)];
    const std::uint32_t bit = 1U << look.pass;
    if ((pending & bit) != 0) {
      return;
    }
    pending |= bit;
  }
  looks_.push_back(look);
  std::push_heap(looks_.begin(), looks_.end(), std::greater<>());
}

/// From some moment on a cell's neighbours are not what they were before: it is looked at again,
/// whenever they change, and when it was removed before.
void ThinningUpdate::doubt(std::uint32_t at, Moment from) {
  if (!set.has(at)) {
    return;
  }
  if (is_doubted_[at] != 0) {
    if (pass_[at] == kStays && !kept.has(at)) {
      schedule(next_look(at, from));
    }
    return;
  }
  const Pass was = pass_[at];
  if (was != kStays && Moment{was, rank_of(at)} < from) {
    return;
  }
  is_doubted_[at] = 1;
  doubted_.push_back(at);
  was_[at] = was;
  pass_[at] = kStays;
  left_.add(at);
  if (was != kStays) {
    schedule({was, rank_of(at)});
  }
  if (kept.has(at)) {
    return;
  }
  schedule(next_look(at, from));
  for (unsigned side = 0; side < kSides; ++side) {
    const std::uint32_t beside = neighbour(at, side);
    if (set.has(beside) && pass_[beside] != kStays) {
      const Moment gone{pass_[beside], rank_of(beside)};
      if (gone > from) {
        schedule(next_look(at, gone));
      }
    }
  }
}

void ThinningUpdate::doubt_neighbours(std::uint32_t at, Moment from) {
  for (unsigned side = 0; side < kSides; ++side) {
    doubt(neighbour(at, side), from);
  }
}

void ThinningUpdate::look(Moment now) {
  const std::uint32_t at = cell_of(now);
  if (pass_[at] != kStays) {
    return;
  }
  unsigned bits = 0;
  for (unsigned side = 0; side < kSides; ++side) {
    bits |= is_there(neighbour(at, side), now) ? 1U << side : 0U;
  }
  const bool was_removed_now = was_[at] == now.pass;
  if (kept.has(at) || !is_simple(bits)) {
    if (was_removed_now) {
      was_[at] = kStays;
      doubt_neighbours(at, now);
    }
    return;
  }
  pass_[at] = now.pass;
  left_.remove(at);
  for (unsigned side = 0; side < kSides; ++side) {
    const std::uint32_t beside = neighbour(at, side);
    if (!was_removed_now || is_doubted_[beside] != 0) {
      doubt(beside, now);
    }
  }
}

}  // namespace cairn
