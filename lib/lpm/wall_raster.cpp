#include "lpm/wall_raster.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include "base/check.hpp"

namespace cairn {
namespace {

constexpr double kFullScore = 255.0;
constexpr double kMaxAngles = 1'000.0;  // on either side of the centre

double least_magnitude(double low, double high) {
  return low > 0.0 ? low : (high < 0.0 ? -high : 0.0);
}

}  // namespace

/// The points turned by one angle of the window.
struct WallRaster::Turned {
  double by_rad = 0.0;
  CellOffsets cells;  // from the cell that an offset of the window is added to
};

/// Offsets of 2^level cells a side, at one angle.
struct WallRaster::Block {
  double bound = 0.0;
  int turned = 0;
  int x = 0;  // lowest offset, in cells
  int y = 0;
  int level = 0;
};

struct WallRaster::Search {
  SearchWindow window;
  std::vector<Turned> turned;
  double worth = 0.0;  // of one unit of likelihood
  int range_cells = 0;
  int top = 0;
  Block best;
  std::vector<Block> open;

  /// By bound, and in a fixed order where bounds are equal.
  static bool is_worse(const Block& a, const Block& b) {
    return std::tie(a.bound, b.turned, b.y, b.x) < std::tie(b.bound, a.turned, a.y, a.x);
  }
};

WallRaster::WallRaster(const DistanceField& walls, double hit_sigma_m, double reach_m) {
  const GridGeometry& fine = walls.geometry();
  geometry_.cell_m = kCoarser * fine.cell_m;
  reach_cells_ = static_cast<int>(std::ceil(reach_m / geometry_.cell_m));
  const int padding = 2 * reach_cells_;
  geometry_.origin_m = fine.origin_m - Vector2d::Constant(padding * geometry_.cell_m);
  geometry_.width = (fine.width + kCoarser - 1) / kCoarser + 2 * padding;
  geometry_.height = (fine.height + kCoarser - 1) / kCoarser + 2 * padding;
  std::array<std::uint8_t, DistanceField::kFar + 1> likelihood{};
  const double sigma_cells = hit_sigma_m / fine.cell_m;
  for (std::size_t squared = 0; squared < DistanceField::kFar; ++squared) {
    const double exponent = -0.5 * static_cast<double>(squared) / (sigma_cells * sigma_cells);
    likelihood[squared] = static_cast<std::uint8_t>(std::lround(kFullScore * std::exp(exponent)));
  }
  std::vector<std::uint8_t> values(geometry_.cell_count(), 0);
  std::vector<std::uint8_t> row(static_cast<std::size_t>(fine.width));
  for (int y = 0; y < fine.height && fine.width > 0; ++y) {
    walls.look_up({0, y}, fine.width, likelihood, row.data());
    std::uint8_t* const coarse =
        values.data() + geometry_.index_of({padding, padding + y / kCoarser});
    for (int x = 0; x < fine.width; ++x) {
      std::uint8_t& value = coarse[x / kCoarser];
      value = std::max(value, row[static_cast<std::size_t>(x)]);
    }
  }
  likelihood_ = MaxPyramid(geometry_, std::move(values), kLevels);
}

std::vector<WallRaster::Turned> WallRaster::turned(const std::vector<SurfacePoint>& points,
                                                   const SearchWindow& window) const {
  double farthest_m = 1.0;
  for (const SurfacePoint& point : points) {
    farthest_m = std::max(farthest_m, point.p.norm());
  }
  const double wanted = std::ceil(window.turn_rad * farthest_m / geometry_.cell_m);
  const int angles = static_cast<int>(std::min(wanted, kMaxAngles));
  std::vector<Turned> all;
  for (int i = -angles; i <= angles; ++i) {
    Turned turned{angles > 0 ? i * window.turn_rad / angles : 0.0, {}};
    const double c = std::cos(window.center.theta() + turned.by_rad);
    const double s = std::sin(window.center.theta() + turned.by_rad);
    for (const SurfacePoint& point : points) {
      const Vector2d p(window.center.x() + c * point.p.x() - s * point.p.y(),
                       window.center.y() + s * point.p.x() + c * point.p.y());
      const Cell cell = geometry_.cell_at(p);
      // Points that no offset brings onto the map count nothing.
      if (cell.x >= reach_cells_ && cell.y >= reach_cells_ &&
          cell.x < geometry_.width - reach_cells_ && cell.y < geometry_.height - reach_cells_) {
        turned.cells.add({cell.x - reach_cells_, cell.y - reach_cells_}, geometry_.width);
      }
    }
    all.push_back(std::move(turned));
  }
  return all;
}

void WallRaster::add_block(Block block, Search* search) const {
  if (block.x > search->range_cells || block.y > search->range_cells) {
    return;
  }
  const SearchWindow& window = search->window;
  const Turned& turned = search->turned[static_cast<std::size_t>(block.turned)];
  const int last = (1 << block.level) - 1;
  const double dx = least_magnitude(block.x, block.x + last) * geometry_.cell_m / window.sigma_m;
  const double dy = least_magnitude(block.y, block.y + last) * geometry_.cell_m / window.sigma_m;
  const double turn = turned.by_rad / window.sigma_rad;
  const Cell low{reach_cells_ + block.x, reach_cells_ + block.y};
  block.bound = search->worth * likelihood_.greatest_sum(turned.cells, low, block.level) -
                0.5 * (dx * dx + dy * dy + turn * turn);
  if (block.bound > search->best.bound) {
    search->open.push_back(block);
  }
}

void WallRaster::add_whole_window(Search* search) const {
  while (search->top + 1 < kLevels && (2 << search->top) <= search->range_cells) {
    ++search->top;
  }
  for (int turned = 0; turned < static_cast<int>(search->turned.size()); ++turned) {
    for (int y = -search->range_cells; y <= search->range_cells; y += 1 << search->top) {
      for (int x = -search->range_cells; x <= search->range_cells; x += 1 << search->top) {
        add_block({0.0, turned, x, y, search->top}, search);
      }
    }
  }
  // The best last, so that it is taken first.
  std::sort(search->open.begin(), search->open.end(), Search::is_worse);
}

/// Depth first, the more promising block first.
void WallRaster::search_through(Search* search) const {
  while (!search->open.empty()) {
    const Block block = search->open.back();
    search->open.pop_back();
    if (block.bound <= search->best.bound) {
      continue;
    }
    if (block.level == 0) {
      search->best = block;
      continue;
    }
    const std::size_t first = search->open.size();
    const int half = 1 << (block.level - 1);
    for (const int dy : {0, half}) {
      for (const int dx : {0, half}) {
        add_block({0.0, block.turned, block.x + dx, block.y + dy, block.level - 1}, search);
      }
    }
    std::sort(search->open.begin() + static_cast<std::ptrdiff_t>(first), search->open.end(),
              Search::is_worse);
  }
}

SearchResult WallRaster::find(const std::vector<SurfacePoint>& points,
                              const SearchWindow& window) const {
  if (points.empty() || geometry_.cell_count() == 0) {
    return {window.center, 0.0};
  }
  Search search;
  search.window = window;
  search.turned = turned(points, window);
  // A point on a wall is worth 2, as one of two sigmas off would cost in squares.
  search.worth = 2.0 * window.independent_share / kFullScore;
  search.range_cells = static_cast<int>(std::ceil(window.range_m / geometry_.cell_m));
  CAIRN_CHECK(search.range_cells <= reach_cells_);
  search.best.bound = -1e300;
  const int middle = static_cast<int>(search.turned.size() / 2);
  add_block({0.0, middle, 0, 0, 0}, &search);  // the centre is the one to beat
  search.best = search.open.back();
  search.open.clear();
  add_whole_window(&search);
  search_through(&search);
  const Block& best = search.best;
  const Turned& turned = search.turned[static_cast<std::size_t>(best.turned)];
  const Cell low{reach_cells_ + best.x, reach_cells_ + best.y};
  return {
      Pose2(window.center.x() + best.x * geometry_.cell_m,
            window.center.y() + best.y * geometry_.cell_m, window.center.theta() + turned.by_rad),
      likelihood_.greatest_sum(turned.cells, low, 0) /
          (kFullScore * static_cast<double>(points.size()))};
}

}  // namespace cairn
