#include "place/place_detector.hpp"

#include <map>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "star/isomorphism.hpp"
#include "support/drive.hpp"

namespace cairn {
namespace {

using test::DrawnWorld;
using test::Drive;
using ::testing::ElementsAre;
using ::testing::SizeIs;

/// Corners A C G I, T junctions B D F H, a crossing E, and a blind corridor to X.
const std::vector<std::string> kLattice{
    "######################################",  //
    "######################################",  //
    "##                                  ##",  //
    "## A              B               C ##",  //
    "##                                  ##",  //
    "##    ############    ##########    ##",  //
    "##    ############    ##########    ##",  //
    "##    ############    ##########    ##",  //
    "##    ############    ##########    ##",  //
    "##    ############    ##########    ##",  //
    "##    ############    ##########    ##",  //
    "##                                  ##",  //
    "## D              E               F ##",  //
    "##                                  ##",  //
    "##    ############    ##########    ##",  //
    "##    ############    ##########    ##",  //
    "##    ############    ##########    ##",  //
    "##    ############    ##########    ##",  //
    "##    ############    ##########    ##",  //
    "##    ############    ##########    ##",  //
    "##                                  ##",  //
    "## G              H               I ##",  //
    "##                                  ##",  //
    "##################    ################",  //
    "##################    ################",  //
    "##################    ################",  //
    "##################    ################",  //
    "##################    ################",  //
    "##################    ################",  //
    "##################    ################",  //
    "##################    ################",  //
    "##################    ################",  //
    "##################    ################",  //
    "##################X   ################",  //
    "######################################",  //
    "######################################",
};

const std::map<char, std::string> kTypes{{'A', "L"}, {'B', "T"}, {'C', "L"}, {'D', "T"},
                                         {'E', "+"}, {'F', "T"}, {'G', "L"}, {'H', "+"},
                                         {'I', "L"}, {'X', "D"}};

/// The mark that a visited place lies at, or '?'.
char mark_at(const DrawnWorld& world, const PlaceVisit& visit) {
  for (const auto& [mark, type] : kTypes) {
    if ((world.position_of(mark) - visit.T_lpm_place.translation()).norm() < 2.0) {
      return mark;
    }
  }
  return '?';
}

std::string marks_of(const DrawnWorld& world, const std::vector<PlaceVisit>& visits) {
  std::string marks;
  for (const PlaceVisit& visit : visits) {
    marks += mark_at(world, visit);
  }
  return marks;
}

/// Whether a gateway of a visit leads toward a point.
bool leads_toward(const PlaceVisit& visit, int gateway, const Vector2d& p_lpm) {
  if (gateway < 0) {
    return false;
  }
  const Gateway& g = visit.neighbourhood.gateways[static_cast<std::size_t>(gateway)];
  return g.outward().dot((p_lpm - visit.T_lpm_place.translation()).normalized()) > 0.8;
}

class LatticeDrive : public ::testing::TestWithParam<unsigned> {};

TEST_P(LatticeDrive, TellsEveryJunctionOnceAndNothingInBetween) {
  const DrawnWorld world(kLattice, 0.5, GetParam());
  Drive drive(world, kPi);
  drive.along("DEFCBEHIFEDABE");
  drive.finish();
  // At the very start, what lies behind the laser is not known.
  EXPECT_EQ(marks_of(world, drive.visits()), "EFCBEHIFEDABE");
}

TEST_P(LatticeDrive, FindsTheSameStarFromEveryArrival) {
  const DrawnWorld world(kLattice, 0.5, GetParam());
  Drive drive(world, kPi);
  drive.along("DEBCFEHIFEDABEHGD");
  drive.finish();
  for (const PlaceVisit& visit : drive.visits()) {
    const char mark = mark_at(world, visit);
    SCOPED_TRACE(mark);
    ASSERT_TRUE(kTypes.count(mark) == 1);
    ASSERT_TRUE(validate(visit.neighbourhood.star).ok());
    EXPECT_EQ(type_name(visit.neighbourhood.star), kTypes.at(mark));
  }
}

TEST_P(LatticeDrive, NamesTheGatewaysOfArrivalAndDeparture) {
  const DrawnWorld world(kLattice, 0.5, GetParam());
  Drive drive(world, kPi);
  drive.along("DEBCFEHIFEDA");
  drive.finish();
  const std::vector<PlaceVisit>& visits = drive.visits();
  for (std::size_t i = 1; i < visits.size(); ++i) {
    SCOPED_TRACE(mark_at(world, visits[i]));
    EXPECT_TRUE(leads_toward(visits[i], visits[i].arrival_gateway,
                             visits[i - 1].T_lpm_place.translation()));
    EXPECT_TRUE(leads_toward(visits[i - 1], visits[i - 1].departure_gateway,
                             visits[i].T_lpm_place.translation()));
    EXPECT_LE(visits[i - 1].left, visits[i].entered);
  }
  EXPECT_EQ(visits.back().departure_gateway, -1);
}

TEST_P(LatticeDrive, AnEndOfACorridorIsAPlaceToTurnAround) {
  const DrawnWorld world(kLattice, 0.5, GetParam());
  Drive drive(world, kPi);
  drive.along("EHXHE");
  drive.finish();
  EXPECT_THAT(marks_of(world, drive.visits()), ::testing::EndsWith("HXHE"));
}

INSTANTIATE_TEST_SUITE_P(RoughWalls, LatticeDrive, ::testing::Range(0U, 3U));

/// A corridor with a T junction at T, and marks on the way.
const std::vector<std::string> kOneJunction{
    "##################################################",  //
    "##################################################",  //
    "                                                  ",  //
    " P          N       T                   M         ",  //
    "                                                  ",  //
    "##################    ############################",  //
    "##################    ############################",  //
    "##################    ############################",  //
    "##################    ############################",  //
    "##################    ############################",  //
    "##################    ############################",  //
    "##################    ############################",  //
    "##################    ############################",  //
    "##################    ############################",  //
    "##################    ############################",  //
    "##################    ############################",  //
    "##################    ############################",  //
    "##################    ############################",  //
    "##################    ############################",  //
    "##################    ############################",  //
    "##################    ############################",  //
};

TEST(PlaceDetector, ATurnAroundOnThePathIsNoNewVisit) {
  const DrawnWorld world(kOneJunction, 0.5, 1);
  Drive drive(world, kPi);
  drive.along("PMN");
  drive.finish();
  ASSERT_THAT(drive.visits(), SizeIs(1));
  EXPECT_EQ(drive.report().turn_arounds, 1);
  const PlaceVisit& visit = drive.visits().front();
  EXPECT_EQ(visit.arrival_gateway, visit.departure_gateway);
}

TEST(PlaceDetector, AStraightCorridorHoldsNoPlace) {
  const std::vector<std::string> corridor{
      "############################################################",  //
      "###################  #######################################",  //
      "                                                            ",  //
      " P                                                        M ",  //
      "                                                            ",  //
      "#############################   #############               ",  //
      "############################################################",  //
  };
  for (unsigned seed = 0; seed < 3; ++seed) {
    SCOPED_TRACE(seed);
    const DrawnWorld world(corridor, 0.5, seed);
    Drive drive(world, kPi);
    drive.along("PM");
    drive.finish();
    EXPECT_THAT(drive.visits(), SizeIs(0));
  }
}

TEST(PlaceDetector, ARobotThatStartsAtAPlaceHasNoArrivalGateway) {
  const DrawnWorld world(kOneJunction, 0.5, 2);
  Drive drive(world, 2.0 * kPi);
  drive.along("TM");
  drive.finish();
  ASSERT_THAT(drive.visits(), SizeIs(1));
  EXPECT_EQ(drive.visits().front().arrival_gateway, -1);
}

TEST(PlaceDetector, KeepsTheMapAroundThePlaceInThePlacesFrame) {
  const DrawnWorld world(kOneJunction, 0.5, 2);
  Drive drive(world, kPi);
  drive.along("PM");
  drive.finish();
  ASSERT_THAT(drive.visits(), SizeIs(1));
  const PlaceVisit& visit = drive.visits().front();
  EXPECT_EQ(visit.T_lpm_place.theta(), 0.0);
  const GridGeometry& geometry = visit.lpm.geometry();
  EXPECT_EQ(visit.lpm.state(geometry.cell_at({0.0, 0.0})), CellState::kFree);
  for (const Gateway& gateway : visit.neighbourhood.gateways) {
    EXPECT_TRUE(visit.lpm.contains(geometry.cell_at(gateway.middle + 1.5 * gateway.outward())));
  }
}

TEST(PlaceDetector, ConfirmsTheGatewaysOfThePlaceItIsAt) {
  const DrawnWorld world(kOneJunction, 0.5, 3);
  Drive drive(world, kPi);
  drive.along("PM");
  int confirmed = 0;
  int retracted = 0;
  for (const PlaceEvent& event : drive.events()) {
    confirmed += event.kind == PlaceEventKind::kGatewayConfirmed ? 1 : 0;
    retracted += event.kind == PlaceEventKind::kGatewayRetracted ? 1 : 0;
  }
  EXPECT_EQ(confirmed - retracted, 3);
}

TEST(PlaceDetector, TakesPosesInTheOrderInWhichTheyCome) {
  PlaceDetector detector{PlaceOptions{}};
  const OccupancyGrid empty;
  EXPECT_THAT(detector.observe(TimePoint(std::chrono::seconds(2)), Pose2(), empty), SizeIs(0));
  EXPECT_THAT(detector.observe(TimePoint(std::chrono::seconds(1)), Pose2(5, 5, 0), empty),
              SizeIs(0));
  EXPECT_EQ(detector.report().looks, 2);  // A stamp that steps back blinds nobody.
}

}  // namespace
}  // namespace cairn
