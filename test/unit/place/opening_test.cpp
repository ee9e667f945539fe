#include "place/opening.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "place/neighbourhood.hpp"
#include "place/perception.hpp"
#include "support/drawn_world.hpp"

namespace cairn {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// A crossing of corridors: a long one to the west, a short blind one to the north, one with an end
/// to the east, and a narrow doorway to the south.
const std::vector<std::string> kCrossing{
    "##################################################",  //
    "##############################....################",  //
    "##############################....################",  //
    "##############################....################",  //
    "##############################....################",  //
    "##############################....################",  //
    "#................................................#",  //
    "#................................................#",  //
    "#...............................R................#",  //
    "#................................................#",  //
    "#................................................#",  //
    "###############################..#################",  //
    "###############################..#################",  //
    "###############################..#################",  //
    "##########################...............#########",  //
    "##########################...............#########",  //
    "##########################...............#########",  //
    "##################################################",
};

/// The opening considered at the crossing that leads about this way.
ConsideredOpening toward(const PlaceNeighbourhood& place, const Vector2d& p) {
  const Vector2d way = (p - place.center).normalized();
  return *std::max_element(place.considered.begin(), place.considered.end(),
                           [&](const ConsideredOpening& a, const ConsideredOpening& b) {
                             return (a.line.middle - place.center).normalized().dot(way) <
                                    (b.line.middle - place.center).normalized().dot(way);
                           });
}

class Crossing : public ::testing::Test {
 protected:
  PlaceNeighbourhood place_at_robot(PlaceMemory memory = {}) const {
    PlaceOptions options;
    options.window_m = 30.0;
    const Vector2d robot = world_.position_of('R');
    for (PlaceNeighbourhood& place :
         find_places(world_.full_map(), robot, options, std::move(memory))) {
      if (place.contains_robot) {
        return place;
      }
    }
    return {};
  }

  test::DrawnWorld world_{kCrossing, 0.5, 1};
};

TEST_F(Crossing, EveryWayOutHasAReason) {
  const PlaceNeighbourhood place = place_at_robot();
  ASSERT_FALSE(place.considered.empty());
  std::size_t gateways = 0;
  for (const ConsideredOpening& opening : place.considered) {
    EXPECT_THAT(why(opening), Not(IsEmpty()));
    EXPECT_GE(wall_share(opening), 0.0);
    EXPECT_LE(wall_share(opening), 1.0);
    gateways += opening.state == OpeningState::kGateway ? 1 : 0;
  }
  EXPECT_EQ(gateways, sure_gateways(place).size());
}

TEST_F(Crossing, ALongCorridorIsAGatewayAsItsWallsAreSeen) {
  const PlaceNeighbourhood place = place_at_robot();
  const ConsideredOpening west = toward(place, place.center - Vector2d(5.0, 0.0));
  EXPECT_EQ(west.state, OpeningState::kGateway);
  EXPECT_EQ(west.reason, OpeningReason::kWalledFar);
  EXPECT_GE(west.behind.along_wall_m, west.needed_m);
  EXPECT_THAT(why(west), HasSubstr(" needed"));
}

TEST_F(Crossing, ADoorwayIsAGatewayOnceItWasDrivenThrough) {
  const PlaceNeighbourhood before = place_at_robot();
  const Vector2d south = before.center - Vector2d(0.0, 5.0);
  const ConsideredOpening door = toward(before, south);
  EXPECT_NE(door.state, OpeningState::kGateway);
  EXPECT_EQ(door.reason, OpeningReason::kDoorway);
  EXPECT_THAT(why(door), HasSubstr("doorway"));

  PlaceMemory memory;
  memory.robot_way = {door.line.middle - Vector2d(0.0, 1.0), door.line.middle + Vector2d(0.0, 1.0)};
  const ConsideredOpening driven = toward(place_at_robot(memory), south);
  EXPECT_EQ(driven.state, OpeningState::kGateway);
  EXPECT_EQ(driven.reason, OpeningReason::kDrivenThrough);
}

TEST(Opening, TheReasonTellsTheFiguresThatDecided) {
  ConsideredOpening opening;
  opening.line.width_m = 5.0;
  opening.needed_m = 7.5;
  opening.behind.along_wall_m = 6.25;
  opening.behind.between_walls_m = 2.5;
  opening.reason = OpeningReason::kTooShallow;
  EXPECT_EQ(why(opening), "walls seen only 6.2 m behind it, 7.5 needed");
  opening.reason = OpeningReason::kTooWide;
  EXPECT_EQ(why(opening), "too wide: 5.0 m across need 7.5 m behind it, seen 6.2");
  opening.reason = OpeningReason::kFan;
  EXPECT_EQ(why(opening), "glass or fan: walls on both sides for only 2.5 of 6.2 m");
  EXPECT_DOUBLE_EQ(wall_share(opening), 0.4);
}

TEST_F(Crossing, APerceptionHasTheAxisOfTheStoredMapAndAllOpenings) {
  PlaceVisit visit;
  visit.neighbourhood = place_at_robot();
  visit.lpm = world_.full_map();
  const PlacePerception perception = perceive(visit, PlaceOptions{});

  ASSERT_FALSE(perception.axis.empty());
  ASSERT_EQ(perception.openings.size(), visit.neighbourhood.considered.size());
  for (std::size_t i = 0; i < visit.neighbourhood.gateways.size(); ++i) {
    EXPECT_EQ(perception.openings[i].gateway, static_cast<int>(i));
  }
  for (const std::vector<Vector2d>& line : perception.axis) {
    for (const Vector2d& p : line) {
      const Cell cell = perception.looked_at.geometry().cell_at(p);
      EXPECT_EQ(perception.looked_at.state(cell), CellState::kFree);
    }
  }
}

TEST(Perception, OfARecalledVisitHasItsGatewaysOnly) {
  PlaceVisit visit;
  Gateway gateway;
  gateway.width_m = 2.0;
  visit.neighbourhood.gateways = {gateway};
  const PlacePerception perception = perceive(visit, PlaceOptions{});

  ASSERT_EQ(perception.openings.size(), 1U);
  EXPECT_EQ(perception.openings[0].opening.reason, OpeningReason::kNotKept);
  EXPECT_THAT(perception.axis, IsEmpty());
}

}  // namespace
}  // namespace cairn
