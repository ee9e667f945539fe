// Maps that a robot gets when something is wrong, or in the way: no place, or one that says that it
// is not complete; never another star.

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "place/neighbourhood.hpp"
#include "star/large_scale_star.hpp"
#include "support/drawn_world.hpp"

namespace cairn {
namespace {

using ::testing::Each;
using ::testing::Field;
using ::testing::IsEmpty;

constexpr OccupancyGrid::LogOdds kFree = -300;
constexpr OccupancyGrid::LogOdds kWall = 300;

/// Corridors of 2.5 m, half a metre to a character, that end 10 m from where they meet.
std::vector<std::string> junction(bool has_side_corridor) {
  std::vector<std::string> lines;
  for (int row = 0; row < 25; ++row) {
    std::string line(47, '#');
    if (row >= 10 && row < 15) {
      line.replace(1, 45, std::string(45, '.'));
    } else if (row > 0 && row < 10 && has_side_corridor) {
      line.replace(21, 5, std::string(5, '.'));
    }
    lines.push_back(line);
  }
  lines[12][23] = 'R';
  return lines;
}

OccupancyGrid uniform(OccupancyGrid::LogOdds odds) {
  GridGeometry geometry;
  geometry.cell_m = 0.05;
  geometry.width = 400;
  geometry.height = 400;
  OccupancyGrid grid(geometry);
  for (int y = 0; y < geometry.height; ++y) {
    for (int x = 0; x < geometry.width; ++x) {
      grid.log_odds({x, y}) = odds;
    }
  }
  return grid;
}

/// Sets the cells for which it holds.
void set_where(const std::function<bool(const Vector2d&)>& holds,
               OccupancyGrid::LogOdds odds,
               OccupancyGrid* grid) {
  const GridGeometry geometry = grid->geometry();
  for (int y = 0; y < geometry.height; ++y) {
    for (int x = 0; x < geometry.width; ++x) {
      if (holds(geometry.center_of({x, y}))) {
        grid->log_odds({x, y}) = odds;
      }
    }
  }
}

/// The complete place around a point; none where there is none.
std::vector<PlaceNeighbourhood> complete_at(const OccupancyGrid& map, const Vector2d& p) {
  std::vector<PlaceNeighbourhood> complete;
  for (PlaceNeighbourhood& place : find_places(map, p, PlaceOptions())) {
    if (place.is_complete && place.contains_robot) {
      complete.push_back(std::move(place));
    }
  }
  return complete;
}

class BadMaps : public ::testing::TestWithParam<unsigned> {
 protected:
  [[nodiscard]] static std::string star(const OccupancyGrid& map, const Vector2d& p) {
    const std::vector<PlaceNeighbourhood> places = complete_at(map, p);
    return places.size() == 1 ? large_scale_text(places.front().star, 0) : "none";
  }

  test::DrawnWorld world_{junction(true), 0.5, GetParam()};
  Vector2d robot_ = world_.position_of('R');
};

TEST(UniformMaps, HoldNoPlace) {
  for (const OccupancyGrid::LogOdds odds : {OccupancyGrid::LogOdds{0}, kFree, kWall}) {
    EXPECT_THAT(find_places(uniform(odds), {10.0, 10.0}, PlaceOptions()),
                Each(Field(&PlaceNeighbourhood::is_complete, false)))
        << odds;
  }
}

TEST(UniformMaps, AMapWithoutCellsHoldsNoPlace) {
  EXPECT_THAT(find_places(OccupancyGrid(), {0.0, 0.0}, PlaceOptions()), IsEmpty());
}

TEST(UniformMaps, CorridorsOfOneCellHoldNoPlace) {
  OccupancyGrid grid = uniform(kWall);
  set_where(
      [](const Vector2d& p) {
        return std::fmod(p.x(), 2.0) < 0.05 || std::fmod(p.y(), 2.0) < 0.05;
      },
      kFree, &grid);
  EXPECT_THAT(find_places(grid, {10.02, 10.02}, PlaceOptions()), IsEmpty());
}

TEST(UniformMaps, AStraightCorridorCutByTheEdgeOfTheMapHoldsNoPlace) {
  OccupancyGrid grid = uniform(kWall);
  set_where([](const Vector2d& p) { return std::abs(p.y() - 10.0) < 1.0; }, kFree, &grid);
  EXPECT_THAT(complete_at(grid, {10.0, 10.0}), IsEmpty());
  EXPECT_THAT(complete_at(grid, {0.5, 10.0}), IsEmpty());
}

TEST_P(BadMaps, OfAJunctionSeenOnOneSideOnlyNoStarIsComplete) {
  OccupancyGrid map = world_.full_map();
  // A sensor that is blind to the left of its way east: nothing north of the way is known.
  set_where([&](const Vector2d& p) { return p.y() > robot_.y() + 0.3; }, 0, &map);
  EXPECT_THAT(complete_at(map, robot_), IsEmpty());
}

TEST_P(BadMaps, OfAJunctionThatTheEdgeOfTheMapCutsNoOtherStarIsRead) {
  const OccupancyGrid whole = world_.full_map();
  const std::string true_star = star(whole, robot_);
  ASSERT_NE(true_star, "none");
  for (const double beyond_m : {0.6, 1.0, 1.4, 2.5, 4.0}) {
    GridGeometry cut = whole.geometry();
    cut.height = std::min(cut.height, cut.cell_at(robot_ + Vector2d(0.0, beyond_m)).y);
    OccupancyGrid map(cut);
    for (int y = 0; y < cut.height; ++y) {
      for (int x = 0; x < cut.width; ++x) {
        map.log_odds({x, y}) = whole.log_odds({x, y});
      }
    }
    const std::string cut_star = star(map, robot_);
    EXPECT_TRUE(cut_star == "none" || cut_star == true_star) << beyond_m << " m:\n" << cut_star;
  }
}

TEST_P(BadMaps, APersonInAGatewayChangesNoStar) {
  const std::string true_star = star(world_.full_map(), robot_);
  ASSERT_NE(true_star, "none");
  for (const Vector2d& at : {Vector2d(0.0, 1.6), Vector2d(-1.7, 0.4), Vector2d(1.7, -0.2)}) {
    OccupancyGrid map = world_.full_map();
    set_where([&](const Vector2d& p) { return (p - robot_ - at).norm() < 0.25; }, kWall, &map);
    EXPECT_EQ(star(map, robot_), true_star) << at.transpose();
  }
}

TEST_P(BadMaps, ADoorBesideTheJunctionMayOpenAndCloseWithoutChangingTheStar) {
  const std::string true_star = star(world_.full_map(), robot_);
  ASSERT_NE(true_star, "none");
  for (const double open_m : {0.3, 0.6, 0.9}) {
    OccupancyGrid map = world_.full_map();
    // A door in the wall south of the junction, and what is seen of the room behind it.
    const Vector2d door = robot_ + Vector2d(0.3, -1.25);
    set_where(
        [&](const Vector2d& p) {
          return std::abs(p.x() - door.x()) < 0.5 * open_m && p.y() < door.y() + 0.2 &&
                 p.y() > door.y() - 2.0;
        },
        kFree, &map);
    EXPECT_EQ(star(map, robot_), true_star) << open_m;
  }
}

INSTANTIATE_TEST_SUITE_P(RoughWalls, BadMaps, ::testing::Range(0U, 4U));

}  // namespace
}  // namespace cairn
