#include "lpm/turned_scans.hpp"

#include <random>

#include <gmock/gmock.h>

namespace cairn {
namespace {

std::vector<SurfacePoint> random_points(unsigned seed, double range_m) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> any(-range_m, range_m);
  std::vector<SurfacePoint> points;
  for (int i = 0; i < 25; ++i) {
    points.push_back({{any(random), any(random)}, Vector2d::Zero()});
  }
  return points;
}

SquareMaxima small_map() {
  GridGeometry geometry;
  geometry.width = 40;
  geometry.height = 30;
  return {geometry, std::vector<std::uint8_t>(geometry.cell_count())};
}

/// What a robot anywhere in a block at any angle of the group meets lies in the group's squares.
void expect_covers_its_angles(TurnedScans* scans, const SquareMaxima& map) {
  for (int level = 1; level < TurnedScans::kLevels; ++level) {
    for (std::size_t group = 0; group < scans->group_count(level); ++group) {
      const TurnedScan all = scans->group(level, group, map);
      for (std::size_t angle = group * scans->group_size(level);
           angle < std::min((group + 1) * scans->group_size(level), scans->angle_count());
           ++angle) {
        const TurnedScan& one = scans->group(0, angle, map);
        for (std::size_t i = 0; i < one.squares.size(); ++i) {
          const int side =
              SquareMaxima::kSides_cells[static_cast<std::size_t>(all.squares[i].kind)];
          const int last = (1 << level) - 1;
          ASSERT_GE(one.squares[i].x, all.squares[i].x);
          ASSERT_GE(one.squares[i].y, all.squares[i].y);
          ASSERT_LT(one.squares[i].x + last, all.squares[i].x + side);
          ASSERT_LT(one.squares[i].y + last, all.squares[i].y + side);
        }
      }
    }
  }
}

TEST(TurnedScans, CoverAllAnglesOfAGroup) {
  const SquareMaxima map = small_map();
  for (unsigned seed = 0; seed < 4; ++seed) {
    SCOPED_TRACE(seed);
    TurnedScans all(random_points(seed, 2.0), 0.1, 0.0, 4.0);
    expect_covers_its_angles(&all, map);
    TurnedScans window(random_points(seed, 2.0), 0.1, kPi - 0.1, 0.5);
    expect_covers_its_angles(&window, map);
    TurnedScans coarse(random_points(seed, 300.0), 0.1, 0.0, 0.5);
    expect_covers_its_angles(&coarse, map);
  }
}

TEST(TurnedScans, KeepToTheWindowAndLeaveNoneOfItsAnglesOut) {
  const std::vector<SurfacePoint> points = random_points(1, 2.0);
  const TurnedScans all(points, 0.1, 0.0, 4.0);
  for (const double center_rad : {0.0, 1.0, kPi, -2.0}) {
    const TurnedScans window(points, 0.1, center_rad, 0.3);
    for (std::size_t i = 0; i < window.angle_count(); ++i) {
      EXPECT_LE(std::abs(turn_between(center_rad, window.angle_rad(i))), 0.3);
    }
    const double expected = 0.6 / (2.0 * kPi) * static_cast<double>(all.angle_count());
    EXPECT_NEAR(static_cast<double>(window.angle_count()), expected, 1.0);
  }
}

TEST(TurnedScans, AreMadeOnce) {
  const SquareMaxima map = small_map();
  TurnedScans scans(random_points(1, 2.0), 0.1, 0.0, 4.0);
  EXPECT_EQ(scans.points_turned(), 0);
  static_cast<void>(scans.group(2, 1, map));
  EXPECT_EQ(scans.points_turned(), 4 * 3 * 25);
  static_cast<void>(scans.group(2, 1, map));
  EXPECT_EQ(scans.points_turned(), 4 * 3 * 25);
}

}  // namespace
}  // namespace cairn
