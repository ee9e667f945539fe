// How well any pose of a block may do.

#include <algorithm>

#include "lpm/global_search_run.hpp"

namespace cairn {
namespace {

constexpr double kFullScore = 255.0;
constexpr double kPointsPerWay = 2.0;
constexpr std::size_t kPointsAtOnce = 16;  // lookups before asking whether more are worth it

/// Where lookups for several blocks begin.
using Origins = std::array<std::int32_t, GlobalSearchRun::kAtOnce>;
using Sums = std::array<std::int32_t, GlobalSearchRun::kAtOnce>;

/// The sums of what a map has at the squares first to last - 1 of a turned scan, for each block.
Sums sums_of(const SquareMaxima& maxima,
             const TurnedScan& turned,
             const Origins& origins,
             std::size_t first,
             std::size_t last) {
  const std::uint8_t* const a = maxima.values() + origins[0];
  const std::uint8_t* const b = maxima.values() + origins[1];
  const std::uint8_t* const c = maxima.values() + origins[2];
  const std::uint8_t* const d = maxima.values() + origins[3];
  Sums sums{};
  for (std::size_t i = first; i < last; ++i) {
    const std::int32_t offset = turned.offsets[i];
    sums[0] += a[offset];
    sums[1] += b[offset];
    sums[2] += c[offset];
    sums[3] += d[offset];
  }
  return sums;
}

/// The same where some squares do not begin on the map or its rim.
Sums sums_beyond(const SquareMaxima& maxima,
                 const TurnedScan& turned,
                 const std::array<Cell, GlobalSearchRun::kAtOnce>& lows,
                 std::size_t first,
                 std::size_t last) {
  Sums sums{};
  for (std::size_t i = first; i < last; ++i) {
    const TurnedScan::Square& square = turned.squares[i];
    const std::uint8_t* const values = maxima.values() + maxima.offset_of(square.kind, 0, 0);
    for (std::size_t k = 0; k < lows.size(); ++k) {
      sums[k] +=
          values[maxima.index_of(maxima.inside({lows[k].x + square.x, lows[k].y + square.y}))];
    }
  }
  return sums;
}

}  // namespace

bool GlobalSearchRun::are_inside(const Blocks& blocks, const TurnedScan& turned) const {
  return std::all_of(blocks.lows.begin(), blocks.lows.end(), [&](Cell low) {
    return search_.likelihood_.is_inside({low.x + turned.low.x, low.y + turned.low.y}) &&
           search_.likelihood_.is_inside({low.x + turned.high.x, low.y + turned.high.y});
  });
}

/// The best scores that there may be in blocks; if all are below the cut, less than that.
GlobalSearchRun::Scores GlobalSearchRun::bounds_of(const Blocks& blocks) {
  const TurnedScan& turned =
      turned_.group(blocks.level, static_cast<std::size_t>(blocks.group), search_.likelihood_);
  Origins origins{};
  std::transform(blocks.lows.begin(), blocks.lows.end(), origins.begin(),
                 [this](Cell low) { return search_.likelihood_.index_of(low); });
  const bool is_inside = are_inside(blocks, turned);
  const double free_weight = search_.options_.free_weight;
  const std::size_t returns = turned_.return_count();
  const std::size_t all = free_weight > 0.0 ? turned.offsets.size() : returns;
  const double full = kFullScore * (1.0 + free_weight) * static_cast<double>(returns);
  double rest = full;  // what is still to come if all of it is perfect
  Scores sums{};
  for (std::size_t first = 0; first < all;) {
    const bool is_way = first >= returns;
    const std::size_t last = std::min(first + kPointsAtOnce, is_way ? all : returns);
    const SquareMaxima& maxima = is_way ? search_.freeness_ : search_.likelihood_;
    const double weight = is_way ? free_weight / kPointsPerWay : 1.0;
    const Sums more = is_inside ? sums_of(maxima, turned, origins, first, last)
                                : sums_beyond(maxima, turned, blocks.lows, first, last);
    rest -= weight * kFullScore * static_cast<double>(last - first);
    lookups_ += static_cast<std::int64_t>((last - first) * kAtOnce);
    first = last;
    double best = 0.0;
    for (std::size_t k = 0; k < kAtOnce; ++k) {
      sums[k] += weight * more[k];
      best = std::max(best, sums[k]);
    }
    if (best + rest < (cut_ - kRounding) * full) {
      return {-1.0, -1.0, -1.0, -1.0};
    }
  }
  std::for_each(sums.begin(), sums.end(), [full](double& sum) { sum /= full; });
  return sums;
}

}  // namespace cairn
