// Paths, faces and regions of maps built by hand.

#include <cstdlib>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "map_builder.hpp"
#include "support/stars.hpp"
#include "topology/paths.hpp"
#include "topology/planarity.hpp"
#include "topology/regions.hpp"

namespace cairn::test {
namespace {

using ::testing::ElementsAre;
using ::testing::SizeIs;
using ::testing::UnorderedElementsAre;

/// A straight street of three crossings between two dead ends, walked to its end.
MapBuilder street() {
  return MapBuilder(dead_end(), 0)
      .add_place(0, crossing(), 0)
      .add_place(2, crossing(), 0)
      .add_place(2, crossing(), 0)
      .add_place(2, dead_end(), 0);
}

TEST(Paths, AStreetIsOnePathAndEachSideStreetAnother) {
  const std::vector<Path> paths = trace_paths(street().map());
  ASSERT_THAT(paths, SizeIs(4));
  ASSERT_THAT(paths.front().stops, SizeIs(5));
  EXPECT_EQ(street().map().path_count(), 4);
  for (std::size_t stop = 1; stop < 5; ++stop) {
    const int step = paths.front().stops[stop].place.value - paths.front().stops[0].place.value;
    EXPECT_EQ(std::abs(step), static_cast<int>(stop));
  }
}

TEST(Paths, EachStopHasASlotForwardAndItsPartnerBackward) {
  const MapBuilder map = street();
  for (const Path& path : trace_paths(map.map())) {
    for (const PathStop& stop : path.stops) {
      EXPECT_EQ(map.map().star(stop.place).slots[stop.forward_slot].partner, stop.backward_slot);
    }
  }
}

TEST(Paths, PlacesBehindAPendingGatewayReachToTheOtherEnd) {
  const MapBuilder walked =
      MapBuilder(dead_end(), 0).add_place(0, crossing(), 0).add_place(2, crossing(), 0);
  EXPECT_THAT(places_behind(walked.map(), {PlaceId{2}, 2}),
              ElementsAre(PlaceId{2}, PlaceId{1}, PlaceId{0}));
  EXPECT_THAT(places_behind(walked.map(), {PlaceId{1}, 1}), ElementsAre(PlaceId{1}));
}

TEST(Paths, NoPlaceMayBeTwiceOnAPath) {
  const MapBuilder map = street();
  // A side street back to the same crossing would be a circular path.
  EXPECT_TRUE(would_repeat_a_place(map.map(), {PlaceId{1}, 1}, {PlaceId{1}, 3}));
  EXPECT_FALSE(would_repeat_a_place(map.map(), {PlaceId{1}, 1}, {PlaceId{2}, 3}));
}

TEST(Planarity, ALonePlaceIsOneFaceHoldingAllItsGateways) {
  const MapBuilder alone(crossing(), 0);
  EXPECT_THAT(pending_on_face(alone.map(), {PlaceId{0}, 0}), SizeIs(3));
  EXPECT_EQ(genus(alone.map()), 0);
}

TEST(Planarity, BothSidesOfAnOpenStreetAreOneFace) {
  EXPECT_THAT(pending_on_face(street().map(), {PlaceId{1}, 1}), SizeIs(5));
}

/// Three crossings around a roundabout: gateways 1 inside, 3 outside.
MapBuilder roundabout() {
  return MapBuilder(crossing(), 0)
      .add_place(2, crossing(), 0)
      .add_place(2, crossing(), 0)
      .close(2, {PlaceId{0}, 0});
}

TEST(Planarity, AClosedLoopPartsInsideFromOutside) {
  const MapBuilder map = roundabout();
  EXPECT_THAT(pending_on_face(map.map(), {PlaceId{0}, 1}),
              UnorderedElementsAre(GatewayRef{PlaceId{1}, 1}, GatewayRef{PlaceId{2}, 1}));
  EXPECT_TRUE(can_link_in_plane(map.map(), {PlaceId{0}, 1}, {PlaceId{2}, 1}));
  EXPECT_FALSE(can_link_in_plane(map.map(), {PlaceId{0}, 1}, {PlaceId{2}, 3}));
}

TEST(Planarity, ALinkFromInsideToOutsideNeedsABridge) {
  MapBuilder crossed = roundabout();
  EXPECT_EQ(crossed.map().position().gateway, 0);
  crossed.close(1, {PlaceId{2}, 3});
  EXPECT_EQ(genus(crossed.map()), 1);
  MapBuilder flat = roundabout();
  flat.close(1, {PlaceId{2}, 1});
  EXPECT_EQ(genus(flat.map()), 0);
}

TEST(Planarity, PartsWithoutALinkBetweenThemMayBeLinkedAnywhere) {
  MapBuilder broken = roundabout();
  broken.contradict(0, crossing(), 0);
  for (const int gateway : {1, 3}) {
    EXPECT_TRUE(can_link_in_plane(broken.map(), {PlaceId{0}, gateway}, {PlaceId{3}, 2}));
    MapBuilder linked = broken;
    linked.close(2, {PlaceId{0}, gateway});
    EXPECT_EQ(genus(linked.map()), 0);
  }
}

TEST(Planarity, AnUnexplainedGatewayIsPassedBy) {
  const MapBuilder broken =
      MapBuilder(dead_end(), 0).add_place(0, dead_end(), 0).contradict(0, crossing(), 0);
  EXPECT_THAT(pending_on_face(broken.map(), {PlaceId{2}, 1}),
              ElementsAre(GatewayRef{PlaceId{2}, 2}, GatewayRef{PlaceId{2}, 3}));
}

/// A ring of corners, the robot always turning right.
MapBuilder ring(int corners) {
  MapBuilder map(corner(), 0);
  map.add_place(0, corner(), 1);
  for (int place = 2; place < corners; ++place) {
    map.add_place(1, corner(), 1);
  }
  map.close(1, {PlaceId{0}, 1});
  return map;
}

TEST(Regions, ASquareIsPerpendicular) {
  EXPECT_TRUE(is_region_consistent(ring(4).map()));
  EXPECT_TRUE(is_perpendicular(ring(4).map()));
}

TEST(Regions, ThreePathsThatMeetPairwiseAreATriangle) {
  EXPECT_TRUE(has_triangle(ring(3).map()));
  EXPECT_FALSE(has_double_meeting(ring(3).map()));
  EXPECT_TRUE(is_region_consistent(ring(3).map()));
  EXPECT_FALSE(has_triangle(ring(5).map()));
}

TEST(Regions, ThreePathsThroughOnePlaceAreNoTriangle) {
  const Star six_ways = star_of({0, 1, 2, 3, 4, 5}, {3, 4, 5, 0, 1, 2});
  EXPECT_FALSE(has_triangle(MapBuilder(six_ways, 0).map()));
}

TEST(Regions, TwoPathsThatMeetTwiceHaveNoSides) {
  EXPECT_TRUE(has_double_meeting(ring(2).map()));
  EXPECT_FALSE(is_region_consistent(ring(2).map()));
}

TEST(Regions, OpenStreetsAreConsistent) {
  EXPECT_TRUE(is_region_consistent(street().map()));
  EXPECT_TRUE(is_region_consistent(MapBuilder(dead_end(), 0).map()));
}

}  // namespace
}  // namespace cairn::test
