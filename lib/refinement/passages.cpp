#include "refinement/passages.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "refinement/patch_matcher.hpp"

namespace cairn {
namespace {

/// Between two patches of one passage there is no more travel than this.
constexpr double kSamePassage_m = 4.0;

}  // namespace

Passages::Passages(const KeyScans& keys,
                   const std::vector<Pose2>& T_global_key,
                   const PatchMatchOptions& options)
    : keys_(keys), T_global_key_(T_global_key), options_(options) {
  double next_m = 0.0;
  for (std::size_t key = 0; key < keys.size(); ++key) {
    // A patch that still grows would not be the same next time.
    const bool is_whole = keys.back()->travel_m > keys[key]->travel_m + options.patch_reach_m;
    if (is_whole && keys[key]->travel_m >= next_m) {
      next_m = keys[key]->travel_m + options.patch_every_m;
      patches_.emplace_back(tile_of(T_global_key[key].translation()), static_cast<int>(key));
    }
  }
  std::sort(patches_.begin(), patches_.end());
}

Passages::Tile Passages::tile_of(const Vector2d& p) const {
  return {static_cast<std::int32_t>(std::floor(p.x() / options_.near_m)),
          static_cast<std::int32_t>(std::floor(p.y() / options_.near_m))};
}

/// In the order of the way.
std::vector<int> Passages::patches_around(const Vector2d& p) const {
  const Tile tile = tile_of(p);
  std::vector<int> patches;
  for (std::int32_t x = tile.x - 1; x <= tile.x + 1; ++x) {
    const std::pair<Tile, int> low{{x, tile.y - 1}, std::numeric_limits<int>::min()};
    const std::pair<Tile, int> high{{x, tile.y + 1}, std::numeric_limits<int>::max()};
    const auto last = std::upper_bound(patches_.begin(), patches_.end(), high);
    for (auto at = std::lower_bound(patches_.begin(), patches_.end(), low); at != last; ++at) {
      patches.push_back(at->second);
    }
  }
  std::sort(patches.begin(), patches.end());
  return patches;
}

std::vector<int> Passages::near(int key) const {
  const auto index = static_cast<std::size_t>(key);
  const Vector2d p = T_global_key_[index].translation();
  std::vector<std::pair<double, int>> nearest;  // of each passage
  double last_travel_m = -std::numeric_limits<double>::infinity();
  for (const int patch : patches_around(p)) {
    const auto at = static_cast<std::size_t>(patch);
    const double travel_m = keys_[at]->travel_m;
    const double distance_m = (T_global_key_[at].translation() - p).norm();
    if (distance_m > options_.near_m ||
        std::abs(travel_m - keys_[index]->travel_m) < options_.apart_m) {
      continue;
    }
    if (travel_m - last_travel_m > kSamePassage_m) {
      nearest.emplace_back(distance_m, patch);
    } else {
      nearest.back() = std::min(nearest.back(), {distance_m, patch});
    }
    last_travel_m = travel_m;
  }
  std::sort(nearest.begin(), nearest.end());
  nearest.resize(std::min(nearest.size(), static_cast<std::size_t>(options_.passes)));
  std::vector<int> patches;
  for (const auto& [distance_m, patch] : nearest) {
    patches.push_back(patch);
  }
  return patches;
}

}  // namespace cairn
