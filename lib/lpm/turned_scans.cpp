#include "lpm/turned_scans.hpp"

#include <cmath>
#include <numeric>

namespace cairn {
namespace {

constexpr double kMaxAngles = 4'000.0;
constexpr std::array<double, 2> kOnTheWay{0.4, 0.8};  // shares of the range of a return
constexpr double kSpread = 0.381966;                  // no two numbers of steps of this come close

/// As std::lround, and faster.
int rounded(double value) {
  return static_cast<int>(value < 0.0 ? value - 0.5 : value + 0.5);
}

/// 0 to count - 1, each far from those before it.
std::vector<std::size_t> spread_out(std::size_t count) {
  auto step = static_cast<std::size_t>(kSpread * static_cast<double>(count)) + 1;
  while (std::gcd(step, count) > 1) {
    ++step;
  }
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < count; ++i) {
    order.push_back(i * step % count);
  }
  return order;
}

/// The cells that a point meets at several angles.
struct Extent {
  Cell low;
  Cell high;
};

}  // namespace

TurnedScans::TurnedScans(const std::vector<SurfacePoint>& points,
                         double cell_m,
                         double center_rad,
                         double half_rad) {
  double farthest_cells = 1.0;
  for (const SurfacePoint& point : points) {
    farthest_cells = std::max(farthest_cells, point.p.norm() / cell_m);
  }
  const int angles = static_cast<int>(std::min(std::ceil(2.0 * kPi * farthest_cells), kMaxAngles));
  const double step_rad = 2.0 * kPi / angles;
  // Neighbours in the window are neighbours in the list.
  const bool is_all = half_rad >= kPi;
  const int low = is_all ? 0 : static_cast<int>(std::ceil((center_rad - half_rad) / step_rad));
  const int high =
      is_all ? angles - 1 : static_cast<int>(std::floor((center_rad + half_rad) / step_rad));
  for (int i = low; i <= high; ++i) {
    angles_rad_.push_back(wrap_angle(step_rad * ((i % angles + angles) % angles)));
  }
  while (2.0 * kPi * farthest_cells > angles * std::exp2(coarseness_)) {
    ++coarseness_;
  }
  const std::vector<std::size_t> order = spread_out(points.size());
  for (const std::size_t i : order) {
    points_cells_.emplace_back(points[i].p / cell_m);
  }
  for (const std::size_t i : order) {
    for (const double share : kOnTheWay) {
      points_cells_.emplace_back(share * points[i].p / cell_m);
    }
  }
  for (int level = 0; level < kLevels; ++level) {
    const std::size_t size = group_size(level);
    groups_[static_cast<std::size_t>(level)].resize((angle_count() + size - 1) / size);
  }
}

const TurnedScan& TurnedScans::group(int level, std::size_t group, const SquareMaxima& maxima) {
  TurnedScan& turned = groups_[static_cast<std::size_t>(level)][group];
  if (turned.offsets.empty()) {
    make(level, group, maxima, &turned);
  }
  return turned;
}

void TurnedScans::make(int level,
                       std::size_t group,
                       const SquareMaxima& maxima,
                       TurnedScan* turned) {
  const std::size_t first = group * group_size(level);
  const std::size_t last = std::min(first + group_size(level), angle_count());
  std::vector<Extent> extents(points_cells_.size());
  for (std::size_t angle = first; angle < last; ++angle) {
    const double cosine = std::cos(angles_rad_[angle]);
    const double sine = std::sin(angles_rad_[angle]);
    for (std::size_t i = 0; i < points_cells_.size(); ++i) {
      const Vector2d& p = points_cells_[i];
      const Cell cell{rounded(cosine * p.x() - sine * p.y()),
                      rounded(sine * p.x() + cosine * p.y())};
      Extent& extent = extents[i];
      extent = angle == first
                   ? Extent{cell, cell}
                   : Extent{{std::min(extent.low.x, cell.x), std::min(extent.low.y, cell.y)},
                            {std::max(extent.high.x, cell.x), std::max(extent.high.y, cell.y)}};
    }
  }
  points_turned_ += static_cast<std::int64_t>((last - first) * points_cells_.size());
  turned->low = turned->high = extents.front().low;
  for (const auto& [low, high] : extents) {
    const int kind =
        SquareMaxima::kind_for((1 << level) + std::max(high.x - low.x, high.y - low.y));
    turned->squares.push_back({static_cast<std::int16_t>(low.x), static_cast<std::int16_t>(low.y),
                               static_cast<std::int16_t>(kind)});
    turned->offsets.push_back(maxima.offset_of(kind, low.x, low.y));
    turned->low = {std::min(turned->low.x, low.x), std::min(turned->low.y, low.y)};
    turned->high = {std::max(turned->high.x, low.x), std::max(turned->high.y, low.y)};
  }
}

}  // namespace cairn
