#include "global_map/scan_footprint.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <set>

#include <gmock/gmock.h>

namespace cairn {
namespace {

constexpr double kCell_m = 0.05;
constexpr double kDrawRange_m = 2.0;
constexpr float kNothing = std::numeric_limits<float>::infinity();
constexpr float kNoStatement = std::numeric_limits<float>::quiet_NaN();

/// A beam in cells of the global frame.
struct Segment {
  Vector2d from;
  Vector2d to;
};

double distance_to(const Segment& segment, const Vector2d& p) {
  const Vector2d way = segment.to - segment.from;
  const double share = std::clamp((p - segment.from).dot(way) / way.squaredNorm(), 0.0, 1.0);
  return (segment.from + share * way - p).norm();
}

/// Whether it passes through a cell; nearly is enough.
bool crosses(const Segment& segment, Cell cell) {
  constexpr double kNearly = 1e-9;
  double begin = 0.0;
  double end = 1.0;
  const Vector2d way = segment.to - segment.from;
  const Vector2d low(cell.x - kNearly, cell.y - kNearly);
  for (int axis = 0; axis < 2; ++axis) {
    const double a = (low[axis] - segment.from[axis]) / way[axis];
    const double b = (low[axis] + 1.0 + 2.0 * kNearly - segment.from[axis]) / way[axis];
    begin = std::max(begin, std::min(a, b));
    end = std::min(end, std::max(a, b));
  }
  return begin <= end;
}

/// Sees walls with corners, poles, gaps and beams that say nothing, more or less densely.
LaserScan random_scan(std::mt19937* random) {
  std::uniform_real_distribution<float> uniform(0.0F, 1.0F);
  LaserScan scan;
  scan.max_range_m = 8.0;
  const int count = 20 + static_cast<int>((*random)() % 300);
  const float opening_rad = 1.0F + 5.2F * uniform(*random);
  float range_m = 1.0F;
  for (int i = 0; i < count; ++i) {
    const float chance = uniform(*random);
    range_m = chance < 0.1F ? 0.1F + 2.5F * uniform(*random) : range_m * (0.98F + 0.04F * chance);
    scan.bearings_rad.push_back(opening_rad *
                                (static_cast<float>(i) / static_cast<float>(count) - 0.5F));
    scan.ranges_m.push_back(chance > 0.98F ? kNoStatement : range_m);
  }
  scan.ranges_m[3] = kNothing;
  return scan;
}

Pose2 random_pose(std::mt19937* random) {
  std::uniform_real_distribution<double> uniform(-30.0, 30.0);
  return {uniform(*random), uniform(*random), uniform(*random)};
}

std::vector<Segment> beams_of(const LaserScan& scan, const Pose2& T_global_laser) {
  std::vector<Segment> beams;
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    if (std::isfinite(scan.ranges_m[i])) {
      const double range_m = std::min(static_cast<double>(scan.ranges_m[i]), kDrawRange_m);
      const auto bearing_rad = static_cast<double>(scan.bearings_rad[i]);
      const Vector2d end = range_m * Vector2d(std::cos(bearing_rad), std::sin(bearing_rad));
      beams.push_back({T_global_laser.translation() / kCell_m, T_global_laser * end / kCell_m});
    }
  }
  return beams;
}

/// The cells that are passed; fails where one is named twice or out of order.
std::set<Cell> passed_cells(const TouchedCells& touched) {
  std::set<Cell> cells;
  const CellSpan* before = nullptr;
  for (const CellSpan& span : touched.passed) {
    EXPECT_LT(span.begin_x, span.end_x);
    EXPECT_TRUE(before == nullptr || before->y < span.y ||
                (before->y == span.y && before->end_x <= span.begin_x));
    before = &span;
    for (int x = span.begin_x; x < span.end_x; ++x) {
      cells.insert({x, span.y});
    }
  }
  return cells;
}

/// No cell is touched that no beam crosses, and none is left out that a beam goes well through.
void expect_sound(const LaserScan& scan, const Pose2& T_global_laser, const TouchedCells& touched) {
  const std::vector<Segment> beams = beams_of(scan, T_global_laser);
  const std::set<Cell> passed = passed_cells(touched);
  const std::set<Cell> hits(touched.hits.begin(), touched.hits.end());
  EXPECT_EQ(hits.size(), touched.hits.size());
  const Vector2d laser = T_global_laser.translation() / kCell_m;
  const int reach = static_cast<int>(kDrawRange_m / kCell_m) + 3;
  for (int y = static_cast<int>(laser.y()) - reach; y <= laser.y() + reach; ++y) {
    for (int x = static_cast<int>(laser.x()) - reach; x <= laser.x() + reach; ++x) {
      const Cell cell{x, y};
      const Vector2d center(x + 0.5, y + 0.5);
      const bool is_touched = passed.count(cell) + hits.count(cell) != 0;
      EXPECT_LE(passed.count(cell) + hits.count(cell), 1U);
      if (is_touched) {
        ASSERT_TRUE(std::any_of(beams.begin(), beams.end(),
                                [&](const Segment& beam) { return crosses(beam, cell); }))
            << x << ", " << y;
      } else {
        ASSERT_FALSE(
            std::any_of(beams.begin(), beams.end(),
                        [&](const Segment& beam) { return distance_to(beam, center) < 0.499; }))
            << x << ", " << y;
      }
    }
  }
}

/// Without the beams that have no return: how far these go is told elsewhere.
LaserScan with_returns_only(LaserScan scan) {
  std::replace(scan.ranges_m.begin(), scan.ranges_m.end(), kNothing, kNoStatement);
  return scan;
}

TEST(ScanFootprint, TouchesWhatBeamsCrossAndNothingBehindTheirEnds) {
  ScanFootprint footprint(kCell_m, kDrawRange_m);
  for (unsigned seed = 0; seed < 12; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const LaserScan scan = with_returns_only(random_scan(&random));
    const Pose2 T_global_laser = random_pose(&random);
    expect_sound(scan, T_global_laser, footprint.of(scan, T_global_laser));
  }
}

TEST(ScanFootprint, BearingsMayRunClockwiseOrInNoOrder) {
  ScanFootprint footprint(kCell_m, kDrawRange_m);
  std::mt19937 random(5);
  const LaserScan scan = with_returns_only(random_scan(&random));
  const Pose2 T_global_laser = random_pose(&random);
  const std::size_t count = scan.ranges_m.size();
  std::vector<std::size_t> clockwise(count);
  std::iota(clockwise.rbegin(), clockwise.rend(), 0U);
  std::vector<std::size_t> interlaced = clockwise;  // Every other one, then those between.
  std::stable_partition(interlaced.begin(), interlaced.end(), [](auto i) { return i % 2 == 0; });
  std::vector<std::size_t> shuffled = clockwise;
  std::shuffle(shuffled.begin(), shuffled.end(), random);
  for (const std::vector<std::size_t>& order : {clockwise, interlaced, shuffled}) {
    LaserScan other = scan;
    for (std::size_t i = 0; i < count; ++i) {
      other.ranges_m[i] = scan.ranges_m[order[i]];
      other.bearings_rad[i] = scan.bearings_rad[order[i]];
    }
    expect_sound(other, T_global_laser, footprint.of(other, T_global_laser));
  }
}

TEST(ScanFootprint, ItsHitsAreTheCellsInWhichBeamsEnd) {
  ScanFootprint footprint(kCell_m, kDrawRange_m);
  for (unsigned seed = 0; seed < 20; ++seed) {
    std::mt19937 random(seed);
    const LaserScan scan = with_returns_only(random_scan(&random));
    const Pose2 T_global_laser = random_pose(&random);
    std::set<Cell> ends;
    for (const Segment& beam : beams_of(scan, T_global_laser)) {
      if ((beam.to - beam.from).norm() < kDrawRange_m / kCell_m - 1e-6) {
        ends.insert(
            {static_cast<int>(std::floor(beam.to.x())), static_cast<int>(std::floor(beam.to.y()))});
      }
    }
    EXPECT_THAT(footprint.of(scan, T_global_laser).hits,
                ::testing::UnorderedElementsAreArray(ends));
  }
}

TEST(ScanFootprint, DoesNotDependOnTheScanBefore) {
  ScanFootprint footprint(kCell_m, kDrawRange_m);
  for (unsigned seed = 0; seed < 20; ++seed) {
    std::mt19937 random(seed);
    const LaserScan scan = random_scan(&random);
    const Pose2 T_global_laser = random_pose(&random);
    ScanFootprint fresh(kCell_m, kDrawRange_m);
    const TouchedCells& expected = fresh.of(scan, T_global_laser);
    const TouchedCells& touched = footprint.of(scan, T_global_laser);
    EXPECT_EQ(touched.hits, expected.hits);
    EXPECT_EQ(passed_cells(touched), passed_cells(expected));
  }
}

// A wall right of the laser, with a slit that the beams look through: what they see beyond is as
// wide as the slit.
TEST(ScanFootprint, NoFreeSpaceLeaksThroughAWall) {
  constexpr double kWall_m = 0.51;
  constexpr double kSlit_m = 0.1;
  LaserScan scan;
  scan.max_range_m = 8.0;
  for (int i = -400; i <= 400; ++i) {
    const double bearing_rad = 0.002 * i;
    const bool is_slit = std::abs(kWall_m * std::tan(bearing_rad)) < 0.5 * kSlit_m;
    scan.bearings_rad.push_back(static_cast<float>(bearing_rad));
    scan.ranges_m.push_back(static_cast<float>((is_slit ? 1.5 : kWall_m) / std::cos(bearing_rad)));
  }
  ScanFootprint footprint(kCell_m, kDrawRange_m);
  const Pose2 T_global_laser(0.0, 0.025, 0.0);
  for (const Cell& cell : passed_cells(footprint.of(scan, T_global_laser))) {
    const double x_m = kCell_m * cell.x;  // of its left side
    const double beside_m = std::abs(kCell_m * (cell.y + 0.5) - 0.025) - 0.5 * kCell_m;
    if (x_m > kWall_m) {
      EXPECT_LT(beside_m, 0.5 * kSlit_m * (x_m + kCell_m) / kWall_m) << cell.x << ", " << cell.y;
    }
  }
}

}  // namespace
}  // namespace cairn
