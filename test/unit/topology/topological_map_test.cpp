#include "topology/topological_map.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "map_builder.hpp"
#include "support/stars.hpp"

namespace cairn::test {
namespace {

using ::testing::ElementsAre;

TEST(TopologicalMap, BeginsWithOnePlaceWhoseGatewaysAreAllPending) {
  const MapBuilder begun(tee(), 1);
  EXPECT_EQ(begun.map().place_count(), 1);
  EXPECT_EQ(begun.map().path_count(), 2);
  EXPECT_THAT(
      begun.map().pending_gateways(),
      ElementsAre(GatewayRef{PlaceId{0}, 0}, GatewayRef{PlaceId{0}, 1}, GatewayRef{PlaceId{0}, 2}));
  EXPECT_EQ(begun.map().position(), (GatewayRef{PlaceId{0}, 1}));
  EXPECT_FALSE(begun.map().is_closed());
}

TEST(TopologicalMap, ANewPlaceIsLinkedBothWays) {
  const MapBuilder grown = MapBuilder(corner(), 0).add_place(0, tee(), 2);
  const GatewayRef left{PlaceId{0}, 0};
  const GatewayRef entered{PlaceId{1}, 2};
  EXPECT_EQ(grown.map().linked_to(left), entered);
  EXPECT_EQ(grown.map().linked_to(entered), left);
  EXPECT_EQ(grown.map().position(), entered);
  EXPECT_EQ(grown.map().pending_count(), 3);
  EXPECT_EQ(grown.map().path_count(), 3);  // The corner's two, one of them the tee's bar; the stem.
  EXPECT_EQ(grown.map().first_visit(PlaceId{1}), VisitId{1});
}

TEST(TopologicalMap, ASquareOfCornersIsClosedByFourPaths) {
  const MapBuilder closed = square(corner());
  EXPECT_TRUE(closed.map().is_closed());
  EXPECT_TRUE(closed.map().has_no_lone_path());
  EXPECT_EQ(closed.map().place_count(), 4);
  EXPECT_EQ(closed.map().path_count(), 4);
  EXPECT_EQ(closed.map().closure_count(), 1);
  EXPECT_EQ(closed.map().at_visit(VisitId{4}), (VisitedPlace{PlaceId{0}, 0}));
}

TEST(TopologicalMap, APathSeenFromOnePlaceOnlyIsLone) {
  const MapBuilder grown = MapBuilder(tee(), 0).add_place(0, corner(), 1);
  EXPECT_FALSE(grown.map().has_no_lone_path());
  // A corridor through which one came is no lone path although its other end is pending.
  const MapBuilder passing = MapBuilder(dead_end(), 0).add_place(0, corridor(), 0);
  EXPECT_TRUE(passing.map().has_no_lone_path());
  EXPECT_FALSE(passing.map().is_closed());
}

TEST(TopologicalMap, TurnsCountClockwiseFromTheGatewayOfArrival) {
  const MapBuilder at(crossing(), 3);
  EXPECT_EQ(at.map().departure({0}), (GatewayRef{PlaceId{0}, 3}));
  EXPECT_EQ(at.map().departure({1}), (GatewayRef{PlaceId{0}, 0}));
}

TEST(TopologicalMap, AVisitsGatewaysAreShiftedAgainstThePlaces) {
  // The crossing is met first by gateway 0; coming back, the star begins elsewhere.
  MapBuilder there = MapBuilder(dead_end(), 0).add_place(0, crossing(), 0);
  there.add_place(1, dead_end(), 0).follow(0, crossing(), 3);
  const VisitedPlace back = there.map().at_visit(VisitId{3});
  EXPECT_EQ(back, (VisitedPlace{PlaceId{1}, 2}));
  EXPECT_EQ((3 + back.shift) % 4, 1);  // Gateway 3 of the visit is gateway 1 of the place.
}

TEST(TopologicalMap, AContradictionLeavesAGatewayUnexplained) {
  const MapBuilder broken = MapBuilder(corner(), 0)
                                .add_place(0, tee(), 2)
                                .follow(0, corner(), 0)
                                .contradict(0, dead_end(), 0);
  const GatewayRef departed{PlaceId{0}, 0};
  const GatewayRef entered{PlaceId{2}, 0};
  EXPECT_TRUE(broken.map().is_unexplained(entered));
  EXPECT_FALSE(broken.map().is_pending(entered));
  EXPECT_EQ(broken.map().leads_to(entered), departed);
  EXPECT_EQ(broken.map().linked_to(entered), std::nullopt);
  EXPECT_EQ(broken.map().linked_to(departed), (GatewayRef{PlaceId{1}, 2}));  // As before.
  EXPECT_EQ(broken.map().component_count(), 2);
}

TEST(TopologicalMap, ALinkJoinsPartsThatAContradictionLeftApart) {
  MapBuilder broken = MapBuilder(corner(), 0).add_place(0, tee(), 2).follow(0, corner(), 0);
  broken.contradict(0, corner(), 0).close(1, {PlaceId{1}, 1});
  EXPECT_EQ(broken.map().component_count(), 1);
  EXPECT_EQ(broken.map().component(PlaceId{0}), broken.map().component(PlaceId{2}));
}

TEST(TopologicalMap, RejoiningLeavesTheOtherLinkAlone) {
  MapBuilder there = MapBuilder(corner(), 0).add_place(0, corner(), 1);
  there.rejoin(1, {PlaceId{0}, 0});
  EXPECT_TRUE(there.map().is_unexplained({PlaceId{1}, 0}));
  EXPECT_EQ(there.map().linked_to({PlaceId{0}, 0}), (GatewayRef{PlaceId{1}, 1}));
  EXPECT_EQ(there.map().position(), (GatewayRef{PlaceId{0}, 0}));
}

TEST(TopologicalMapDeathTest, RefusesATurnBeyondThePlacesGateways) {
  const MapBuilder at(corner(), 0);
  EXPECT_DEATH(static_cast<void>(at.map().departure({2})), "turn");
  EXPECT_DEATH(static_cast<void>(at.map().departure({-1})), "turn");
}

TEST(TopologicalMapDeathTest, RefusesToCloseALinkedGateway) {
  MapBuilder there = MapBuilder(corner(), 0).add_place(0, corner(), 1);
  EXPECT_DEATH(there.close(1, {PlaceId{0}, 0}), "is_pending");
}

TEST(Experience, AViewNeedsAValidStarItsGatewayAndAVisit) {
  EXPECT_TRUE(validate(View{tee(), 2, VisitId{0}}).ok());
  EXPECT_FALSE(validate(View{tee(), 3, VisitId{0}}).ok());
  EXPECT_FALSE(validate(View{tee(), -1, VisitId{0}}).ok());
  EXPECT_FALSE(validate(View{Star{}, 0, VisitId{0}}).ok());
  EXPECT_FALSE(validate(View{tee(), 0, VisitId{}}).ok());
}

}  // namespace
}  // namespace cairn::test
