#include "global_map/global_map.hpp"

#include <cmath>
#include <limits>
#include <random>

#include <gmock/gmock.h>

namespace cairn {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr float kNothing = std::numeric_limits<float>::infinity();
constexpr float kNoStatement = std::numeric_limits<float>::quiet_NaN();

std::shared_ptr<const LaserScan> scan_of(std::vector<float> bearings_rad,
                                         std::vector<float> ranges_m,
                                         double max_range_m = 8.0) {
  LaserScan scan;
  scan.bearings_rad = std::move(bearings_rad);
  scan.ranges_m = std::move(ranges_m);
  scan.max_range_m = max_range_m;
  return std::make_shared<const LaserScan>(scan);
}

/// Sees a round wall at a random distance for every beam.
std::shared_ptr<const LaserScan> random_scan(std::mt19937* random) {
  std::uniform_real_distribution<float> range_m(0.5F, 6.0F);
  std::vector<float> bearings_rad;
  std::vector<float> ranges_m;
  for (int i = 0; i < 90; ++i) {
    bearings_rad.push_back(static_cast<float>(i) * 0.07F - 3.1F);
    ranges_m.push_back(i % 10 == 3 ? kNothing : range_m(*random));
  }
  return scan_of(bearings_rad, ranges_m);
}

std::vector<PosedScan> random_scans(unsigned seed, int count) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-5.0, 5.0);
  std::vector<PosedScan> scans;
  for (int i = 0; i < count; ++i) {
    scans.push_back({random_scan(&random), {uniform(random), uniform(random), uniform(random)}});
  }
  return scans;
}

/// Percent of the cell at a point; by tiles, as a client reads it.
int percent_at(const GlobalMap& map, double x_m, double y_m) {
  const int side = map.options().tile_cells;
  const int x = static_cast<int>(std::floor(x_m / map.options().cell_m));
  const int y = static_cast<int>(std::floor(y_m / map.options().cell_m));
  const TileIndex tile{static_cast<int>(std::floor(static_cast<double>(x) / side)),
                       static_cast<int>(std::floor(static_cast<double>(y) / side))};
  return map.percent_of(
      tile)[static_cast<std::size_t>((y - tile.y * side) * side + x - tile.x * side)];
}

void expect_same(const GlobalMap& a, const GlobalMap& b) {
  std::vector<TileIndex> all = a.tiles();
  const std::vector<TileIndex> of_b = b.tiles();
  all.insert(all.end(), of_b.begin(), of_b.end());
  for (const TileIndex tile : all) {
    ASSERT_EQ(a.percent_of(tile), b.percent_of(tile)) << tile.x << ", " << tile.y;
  }
}

TEST(GlobalMap, ABeamIsFreeUpToItsWallAndSaysNothingBehindIt) {
  GlobalMap map;
  const std::vector<TileIndex> changed =
      map.draw({{scan_of({0.0F, 1.0F}, {2.0F, kNoStatement}), {0.52, 0.52, 0.0}}});
  EXPECT_THAT(changed, ElementsAre(TileIndex{0, 0}));
  EXPECT_LT(percent_at(map, 0.52, 0.52), 50);
  EXPECT_LT(percent_at(map, 2.42, 0.52), 50);
  EXPECT_GT(percent_at(map, 2.52, 0.52), 50);
  EXPECT_EQ(percent_at(map, 2.62, 0.52), GlobalMap::kUnknownPercent);
  EXPECT_EQ(percent_at(map, 0.52 + std::cos(1.0), 0.52 + std::sin(1.0)),
            GlobalMap::kUnknownPercent);
}

TEST(GlobalMap, ABeamWithoutEchoIsFreeUpToTheSensorsRange) {
  GlobalMap map;
  map.draw({{scan_of({0.0F, 1.0F}, {kNothing, kNoStatement}, 3.0), {0.52, 0.52, 0.0}}});
  EXPECT_LT(percent_at(map, 3.42, 0.52), 50);
  EXPECT_EQ(percent_at(map, 3.62, 0.52), GlobalMap::kUnknownPercent);
}

TEST(GlobalMap, AWallBeyondTheDrawRangeIsNotDrawn) {
  GlobalMapOptions options;
  options.draw_range_m = 2.0;
  GlobalMap map(options);
  map.draw({{scan_of({0.0F, 1.0F}, {5.0F, kNothing}, 8.0), {0.02, 0.02, 0.0}}});
  EXPECT_LT(percent_at(map, 1.92, 0.02), 50);
  EXPECT_EQ(percent_at(map, 5.02, 0.02), GlobalMap::kUnknownPercent);
}

TEST(GlobalMap, TheLaserLooksFromWhereItIsMounted) {
  LaserScan scan = *scan_of({0.0F, 0.1F}, {1.0F, kNoStatement});
  scan.T_robot_laser = Pose2(0.5, 0.0, kPi / 2.0);
  GlobalMap map;
  map.draw({{std::make_shared<const LaserScan>(scan), {1.02, 1.02, 0.0}}});
  EXPECT_GT(percent_at(map, 1.52, 2.02), 50);
  EXPECT_EQ(percent_at(map, 1.02, 1.02), GlobalMap::kUnknownPercent);
}

TEST(GlobalMap, BeamsThatGrazeAWallDoNotEraseIt) {
  std::vector<float> bearings_rad;
  std::vector<float> ranges_m;
  for (int i = 1; i <= 400; ++i) {  // A wall 0.3 m to the left, seen along.
    bearings_rad.push_back(0.001F * static_cast<float>(i) + 0.1F);
    ranges_m.push_back(0.3F / std::sin(bearings_rad.back()));
  }
  GlobalMap map;
  map.draw({{scan_of(bearings_rad, ranges_m), {0.025, 0.025, 0.0}}});
  for (double x_m = 1.0; x_m < 2.5; x_m += 0.25) {
    EXPECT_GT(percent_at(map, x_m + 0.025, 0.325), 50) << x_m;
  }
}

TEST(GlobalMap, TilesLieAboutTheOriginOfTheFrame) {
  GlobalMap map;
  const double tile_m = 64 * 0.05;
  map.draw({{scan_of({0.0F, 1.0F}, {0.1F, kNoStatement}), {-0.5, -0.5, 0.0}},
            {scan_of({0.0F, 1.0F}, {0.1F, kNoStatement}), {tile_m + 0.5, 0.5, 0.0}}});
  EXPECT_THAT(map.tiles(), ElementsAre(TileIndex{-1, -1}, TileIndex{1, 0}));
  // Row by row, y up: the cell of (-0.5, -0.5) is number (54, 54) of its tile.
  EXPECT_LT(map.percent_of({-1, -1})[54 * 64 + 54], 50);
}

TEST(GlobalMap, ScansThatStayAreNotDrawnAgain) {
  std::vector<PosedScan> scans = random_scans(1, 10);
  GlobalMap map;
  EXPECT_FALSE(map.draw(scans).empty());
  EXPECT_THAT(map.draw(scans), IsEmpty());
  scans[4].T_global_robot = scans[4].T_global_robot * Pose2(0.005, 0.0, 0.0);
  EXPECT_THAT(map.draw(scans), IsEmpty());
}

TEST(GlobalMap, OnlyTilesUnderAMovedScanChange) {
  const auto scan = scan_of({0.0F, 1.0F}, {0.5F, kNoStatement});
  const auto far_scan = scan_of({0.0F, 1.0F}, {0.5F, kNoStatement});
  GlobalMap map;
  map.draw({{scan, {0.5, 0.5, 0.0}}, {far_scan, {20.5, 20.5, 0.0}}});
  EXPECT_THAT(map.draw({{scan, {0.7, 0.5, 0.0}}, {far_scan, {20.5, 20.5, 0.0}}}),
              ElementsAre(TileIndex{0, 0}));
  EXPECT_THAT(map.draw({{far_scan, {20.5, 20.5, 0.0}}}), ElementsAre(TileIndex{0, 0}));
  EXPECT_EQ(percent_at(map, 0.72, 0.5), GlobalMap::kUnknownPercent);
}

TEST(GlobalMap, AfterAnyHistoryEqualsTheMapDrawnAfresh) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    std::vector<PosedScan> scans = random_scans(seed, 12);
    GlobalMap map;
    map.draw({scans.begin(), scans.begin() + 6});
    map.draw(scans);
    for (PosedScan& scan : scans) {
      if (random() % 2 == 0) {
        scan.T_global_robot = scan.T_global_robot * Pose2(0.3, -0.2, 0.1);
      }
    }
    scans.erase(scans.begin() + 3);
    scans.push_back(scans.front());  // One scan twice.
    map.draw(scans);
    GlobalMap afresh;
    afresh.draw(scans);
    expect_same(map, afresh);
  }
}

TEST(GlobalMap, EqualsTheMapDrawnAfreshAfterEveryOfManyChanges) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const std::vector<PosedScan> more = random_scans(seed, 20);
    std::vector<PosedScan> scans(more.begin(), more.begin() + 8);
    GlobalMap map;
    map.draw(scans);
    for (std::size_t step = 8; step < more.size(); ++step) {
      const std::size_t at = random() % scans.size();
      switch (random() % 4) {
        case 0:
          scans.erase(scans.begin() + static_cast<std::ptrdiff_t>(at));
          break;
        case 1:
          std::swap(scans[at], scans.back());
          break;
        case 2:
          scans[at].T_global_robot = scans[at].T_global_robot * Pose2(0.1, 0.2, -0.1);
          break;
        default:
          break;
      }
      scans.push_back(more[step]);
      map.draw(scans);
      GlobalMap afresh;
      afresh.draw(scans);
      expect_same(map, afresh);
    }
  }
}

TEST(GlobalMap, OneMoreScanChangesTheTilesUnderItOnly) {
  std::vector<PosedScan> scans = random_scans(6, 12);
  GlobalMap map;
  map.draw(scans);
  scans.push_back({scan_of({0.0F, 1.0F}, {0.5F, kNoStatement}), {40.5, -20.5, 0.0}});
  EXPECT_THAT(map.draw(scans), ElementsAre(TileIndex{12, -7}));
}

TEST(GlobalMap, EvidenceOfManyScansIsAsSureAsThatOfSome) {
  GlobalMap map;
  std::vector<PosedScan> scans;
  for (const int count : {20, 63, 64, 200}) {
    while (static_cast<int>(scans.size()) < count) {
      scans.push_back({scan_of({0.0F, 1.0F}, {0.5F, kNoStatement}), {0.52, 0.52, 0.0}});
    }
    map.draw(scans);
    EXPECT_EQ(percent_at(map, 0.62, 0.52), 1) << count;
    EXPECT_EQ(percent_at(map, 1.02, 0.52), 99) << count;
  }
}

TEST(GlobalMap, DoesNotDependOnTheOrderOfScans) {
  std::vector<PosedScan> scans = random_scans(3, 12);
  GlobalMap map;
  map.draw(scans);
  GlobalMap backwards;
  backwards.draw({scans.rbegin(), scans.rend()});
  expect_same(map, backwards);
}

TEST(GlobalMap, AsOneGridShowsTheSameCells) {
  GlobalMap map;
  map.draw(random_scans(4, 12));
  const Result<OccupancyGrid> grid = map.to_grid();
  ASSERT_TRUE(grid);
  int known = 0;
  for (int y = 0; y < grid->geometry().height; ++y) {
    for (int x = 0; x < grid->geometry().width; ++x) {
      const Vector2d center = grid->geometry().center_of({x, y});
      const CellState state = grid->state({x, y});
      if (x % 7 == 0 && y % 7 == 0 && state != CellState::kUnknown) {
        ++known;
        EXPECT_EQ(percent_at(map, center.x(), center.y()) > 50, state == CellState::kOccupied);
      }
    }
  }
  EXPECT_GT(known, 500);
}

TEST(GlobalMap, WithoutScansIsEmpty) {
  GlobalMap map;
  EXPECT_THAT(map.draw({}), IsEmpty());
  EXPECT_THAT(map.tiles(), IsEmpty());
  ASSERT_TRUE(map.to_grid());
  EXPECT_EQ(map.to_grid()->geometry().cell_count(), 0U);
}

TEST(GlobalMap, PosesOutOfThisWorldAreNotDrawn) {
  const auto scan = scan_of({0.0F, 1.0F}, {0.5F, 0.5F});
  GlobalMap map;
  EXPECT_THAT(
      map.draw({{scan, {NAN, 0.0, 0.0}}, {scan, {0.0, 1e9, 0.0}}, {scan, {0.0, 0.0, INFINITY}}}),
      IsEmpty());
}

TEST(GlobalMap, KeepsItsBudgetOfTilesAndSaysSo) {
  GlobalMapOptions options;
  options.max_tiles = 2;
  GlobalMap map(options);
  map.draw(random_scans(5, 12));
  EXPECT_EQ(map.tiles().size(), 2U);
  EXPECT_GT(map.cells_beyond_budget(), 0);
  map.draw({});
  for (const TileIndex tile : map.tiles()) {
    for (const std::uint8_t percent : map.percent_of(tile)) {
      ASSERT_EQ(percent, GlobalMap::kUnknownPercent);
    }
  }
}

TEST(GlobalMap, IsNoGridWhereItWouldBeTooLarge) {
  GlobalMap map;
  const auto scan = scan_of({0.0F, 1.0F}, {0.5F, 0.5F});
  map.draw({{scan, {0.0, 0.0, 0.0}}, {scan, {9e5, 9e5, 0.0}}});
  const Result<OccupancyGrid> grid = map.to_grid();
  ASSERT_FALSE(grid);
  EXPECT_EQ(grid.error().code, ErrorCode::kUnavailable);
}

}  // namespace
}  // namespace cairn
