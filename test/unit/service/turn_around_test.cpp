#include "service/turn_around.hpp"

#include <numbers>

#include <gtest/gtest.h>

namespace cairn {
namespace {

constexpr double kWithin_m = 0.7;

Gateway gateway(double x_m, double y_m, double bearing_rad) {
  Gateway gateway;
  gateway.middle = {x_m, y_m};
  gateway.outward_bearing_rad = bearing_rad;
  gateway.width_m = 2.0;
  return gateway;
}

/// At a crossing of corridors: gateways east, south, west and north of it, in clockwise order.
PlaceVisit visit_at(const Vector2d& p_lpm, int arrival, int departure) {
  PlaceVisit visit;
  visit.T_lpm_place = Pose2(p_lpm, 0.0);
  visit.neighbourhood.gateways = {gateway(1.5, 0.0, 0.0), gateway(0.0, -1.5, -std::numbers::pi / 2),
                                  gateway(-1.5, 0.0, std::numbers::pi),
                                  gateway(0.0, 1.5, std::numbers::pi / 2)};
  visit.arrival_gateway = arrival;
  visit.departure_gateway = departure;
  return visit;
}

std::optional<int> departure(const PlaceVisit& before, const PlaceVisit& visit) {
  return departure_after_turning_around(before, visit, kWithin_m);
}

TEST(TurnAround, ComingBackByTheGatewayOfDepartureContinuesTheVisit) {
  EXPECT_EQ(departure(visit_at({5.0, 5.0}, 2, 0), visit_at({5.1, 5.0}, 0, 3)), 3);
  EXPECT_EQ(departure(visit_at({5.0, 5.0}, 2, 0), visit_at({5.1, 5.0}, 0, 2)), 2);
}

TEST(TurnAround, ARobotThatStaysAfterComingBackHasNotLeftYet) {
  EXPECT_EQ(departure(visit_at({5.0, 5.0}, 2, 0), visit_at({5.1, 5.0}, 0, -1)), -1);
}

TEST(TurnAround, ComingBackByAnotherGatewayIsALoop) {
  EXPECT_EQ(departure(visit_at({5.0, 5.0}, 2, 0), visit_at({5.1, 5.0}, 1, 3)), std::nullopt);
}

TEST(TurnAround, AnotherSpotIsAnotherPlace) {
  EXPECT_EQ(departure(visit_at({5.0, 5.0}, 2, 0), visit_at({6.0, 5.0}, 0, 3)), std::nullopt);
}

TEST(TurnAround, AVisitThatDidNotEndOrDidNotBeginIsNone) {
  EXPECT_EQ(departure(visit_at({5.0, 5.0}, 2, -1), visit_at({5.1, 5.0}, 0, 3)), std::nullopt);
  EXPECT_EQ(departure(visit_at({5.0, 5.0}, 2, 0), visit_at({5.1, 5.0}, -1, 3)), std::nullopt);
}

TEST(TurnAround, GatewaysReadFartherOutAreTheSameInTheirOrder) {
  PlaceVisit again = visit_at({5.1, 5.0}, 0, 2);
  again.neighbourhood.gateways[2] = gateway(-3.9, 0.0, std::numbers::pi);
  EXPECT_EQ(departure(visit_at({5.0, 5.0}, 2, 0), again), 2);
}

TEST(TurnAround, WhereOneGatewayWasMissedTheOthersAreKnownByTheirSpot) {
  PlaceVisit again = visit_at({5.1, 5.0}, 0, 2);
  again.neighbourhood.gateways.erase(again.neighbourhood.gateways.begin() + 1);
  EXPECT_EQ(departure(visit_at({5.0, 5.0}, 2, 0), again), 3) << "the third one is north";
  again.departure_gateway = 1;
  EXPECT_EQ(departure(visit_at({5.0, 5.0}, 2, 0), again), 2);
}

TEST(TurnAround, AGatewayThatTheVisitBeforeDidNotSeeBeginsAnotherVisit) {
  PlaceVisit before = visit_at({5.0, 5.0}, 2, 0);
  before.neighbourhood.gateways.pop_back();
  EXPECT_EQ(departure(before, visit_at({5.1, 5.0}, 0, 3)), std::nullopt);
}

}  // namespace
}  // namespace cairn
