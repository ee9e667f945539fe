#include "layout/shared_layouts.hpp"

#include <algorithm>
#include <bit>
#include <utility>

namespace cairn {
namespace {

/// Of a layout, about: its travel, what belongs to its place, and its share of the cliques.
constexpr std::size_t kBytesPerTravel = 1'000;

std::uint64_t mixed(std::uint64_t key, std::uint64_t value) {
  key ^= value + 0x9E3779B97F4A7C15U + (key << 6U) + (key >> 2U);
  key *= 0xBF58476D1CE4E5B9U;
  return key ^ (key >> 31U);
}

std::uint64_t mixed(std::uint64_t key, double value) {
  return mixed(key, std::bit_cast<std::uint64_t>(value));
}

/// Of the travels up to each one.
std::vector<std::uint64_t> keys_of(const std::vector<TravelConstraint>& travels) {
  std::vector<std::uint64_t> keys;
  keys.reserve(travels.size());
  std::uint64_t key = 0;
  for (const TravelConstraint& travel : travels) {
    key = mixed(key, static_cast<std::uint64_t>(travel.from));
    key = mixed(key, static_cast<std::uint64_t>(travel.to));
    key = mixed(key, travel.T_from_to.mean.x());
    key = mixed(key, travel.T_from_to.mean.y());
    key = mixed(key, travel.T_from_to.mean.theta());
    for (const double entry : travel.T_from_to.covariance.reshaped()) {
      key = mixed(key, entry);
    }
    keys.push_back(key);
  }
  return keys;
}

bool is_same(const TravelConstraint& a, const TravelConstraint& b) {
  return a.from == b.from && a.to == b.to && a.T_from_to.mean == b.T_from_to.mean &&
         a.T_from_to.covariance == b.T_from_to.covariance;
}

std::size_t bytes_of(const IncrementalLayout& layout) {
  return sizeof(IncrementalLayout) + kBytesPerTravel * layout.travels().size();
}

Status add(const TravelConstraint& travel, IncrementalLayout* layout) {
  return std::max(travel.from, travel.to) < layout->place_count() ? layout->add_travel(travel)
                                                                  : layout->add_place(travel);
}

}  // namespace

Result<LaidPlaces> SharedLayouts::lay_out(int place_count,
                                          const std::vector<TravelConstraint>& travels) {
  if (options_.outlier_sigmas > 0.0) {
    return solved(place_count, travels);
  }
  const std::vector<std::uint64_t> keys = keys_of(travels);
  IncrementalLayout layout = longest_beginning(travels, keys);
  const std::size_t shared = layout.travels().size();
  for (std::size_t i = shared; i < travels.size(); ++i) {
    if (!add(travels[i], &layout)) {
      return solved(place_count, travels);
    }
  }
  added_count_ += static_cast<std::int64_t>(travels.size() - shared);
  if (layout.place_count() != place_count) {
    return solved(place_count, travels);
  }
  LaidPlaces laid{layout.T_global_place(), layout.chi2()};
  if (shared < travels.size()) {
    keep(keys.back(), std::move(layout));
  }
  return laid;
}

Result<LaidPlaces> SharedLayouts::solved(int place_count,
                                         const std::vector<TravelConstraint>& travels) {
  ++solved_count_;
  Result<PlaceLayout> layout = solve_layout(place_count, travels, options_);
  if (!layout) {
    return layout.error();
  }
  return LaidPlaces{std::move(layout->T_global_place), layout->chi2};
}

IncrementalLayout SharedLayouts::longest_beginning(const std::vector<TravelConstraint>& travels,
                                                   const std::vector<std::uint64_t>& keys) {
  for (std::size_t i = keys.size(); i > 0; --i) {
    const auto found = kept_.find(keys[i - 1]);
    if (found == kept_.end()) {
      continue;
    }
    const std::vector<TravelConstraint>& known = found->second.layout.travels();
    if (known.size() == i && std::equal(known.begin(), known.end(), travels.begin(), is_same)) {
      found->second.used = ++uses_;
      return found->second.layout;
    }
  }
  return {};
}

void SharedLayouts::keep(std::uint64_t key, IncrementalLayout layout) {
  const std::size_t bytes = bytes_of(layout);
  Kept& kept = kept_[key];
  bytes_ += bytes - kept.bytes;
  kept = {std::move(layout), bytes, ++uses_};
  while (bytes_ > max_bytes_ && kept_.size() > 1) {
    auto oldest = kept_.begin();
    for (auto at = kept_.begin(); at != kept_.end(); ++at) {
      oldest = at->second.used < oldest->second.used ? at : oldest;
    }
    bytes_ -= oldest->second.bytes;
    kept_.erase(oldest);
  }
}

}  // namespace cairn
