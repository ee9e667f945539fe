#include "bench/lab/building_score.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "place/path_fragments.hpp"
#include "place/small_scale_star.hpp"

namespace cairn::lab {
namespace {

/// Bearings of the corridors at a junction.
std::vector<double> ways_of(const Building& building, int junction) {
  std::vector<double> ways;
  for (const Corridor& corridor : building.corridors()) {
    if (corridor.from == junction || corridor.to == junction) {
      const Vector2d way = building.junctions()[static_cast<std::size_t>(
                               corridor.from == junction ? corridor.to : corridor.from)] -
                           building.junctions()[static_cast<std::size_t>(junction)];
      ways.push_back(std::atan2(way.y(), way.x()));
    }
  }
  return ways;
}

/// A visit that perceived gateways in these directions.
SimulatedVisit visit_seeing(const std::vector<double>& bearings_rad, int junction) {
  SimulatedVisit visit;
  visit.junction = junction;
  PlaceNeighbourhood& place = visit.perceived.neighbourhood;
  for (const double bearing_rad : bearings_rad) {
    Gateway gateway;
    gateway.middle = 1.5 * Vector2d(std::cos(bearing_rad), std::sin(bearing_rad));
    gateway.outward_bearing_rad = bearing_rad;
    gateway.width_m = 2.0;
    place.gateways.push_back(gateway);
  }
  sort_clockwise(Vector2d::Zero(), &place.gateways);
  place.fragments = mutual_straight_continuations(place.gateways, ContinuationOptions());
  place.star = small_scale_star(Vector2d::Zero(), place.gateways, place.fragments, 6.0);
  return visit;
}

int some_junction(const Building& building, std::size_t ways) {
  for (int j = 0; j < static_cast<int>(building.junctions().size()); ++j) {
    if (ways_of(building, j).size() == ways) {
      return j;
    }
  }
  return -1;
}

TEST(BuildingScore, WhatIsPerceivedAsItIsCountsFully) {
  const Building building(1);
  const int junction = some_junction(building, 3);
  const SimulatedVisit visit = visit_seeing(ways_of(building, junction), junction);
  const BuildingScore score = score_of(building, {junction, junction}, {visit, visit});
  EXPECT_EQ(score.passages, 2U);
  EXPECT_EQ(score.noticed, 2U);
  EXPECT_EQ(score.gateways, 6U);
  EXPECT_EQ(score.gateways_found, 6U);
  EXPECT_EQ(score.gateways_false, 0U);
  EXPECT_EQ(score.stars_true, 2U);
  EXPECT_EQ(score.revisits, 1U);
  EXPECT_EQ(score.same_star, 1U);
}

TEST(BuildingScore, AMissedGatewayIsMissedAndTheStarIsAnother) {
  const Building building(1);
  const int junction = some_junction(building, 3);
  std::vector<double> ways = ways_of(building, junction);
  const SimulatedVisit whole = visit_seeing(ways, junction);
  ways.pop_back();
  const BuildingScore score =
      score_of(building, {junction, junction}, {whole, visit_seeing(ways, junction)});
  EXPECT_EQ(score.gateways_found, 5U);
  EXPECT_EQ(score.stars_true, 1U);
  EXPECT_EQ(score.same_star, 0U);
}

TEST(BuildingScore, AGatewayWhereNoCorridorLeavesIsFalse) {
  const Building building(1);
  const int junction = some_junction(building, 3);
  std::vector<double> ways = ways_of(building, junction);
  ways.push_back(ways.front() + 0.25 * std::numbers::pi);
  const BuildingScore score = score_of(building, {junction}, {visit_seeing(ways, junction)});
  EXPECT_EQ(score.gateways_found, 3U);
  EXPECT_EQ(score.gateways_false, 1U);
  EXPECT_EQ(score.stars_true, 0U);
}

TEST(BuildingScore, APlaceInTheMiddleOfACorridorIsFalse) {
  const Building building(1);
  const int junction = some_junction(building, 3);
  SimulatedVisit nowhere = visit_seeing({0.0, std::numbers::pi}, junction);
  nowhere.junction.reset();
  const BuildingScore score = score_of(building, {junction}, {nowhere});
  EXPECT_EQ(score.false_places, 1U);
  EXPECT_EQ(score.noticed, 0U);
  EXPECT_EQ(score.passages, 1U);
}

TEST(BuildingScore, AVisitThatWasMissedLeavesTheOthersAtTheirJunctions) {
  const Building building(1);
  const int a = some_junction(building, 3);
  const int b =
      some_junction(building, 4) >= 0 ? some_junction(building, 4) : some_junction(building, 2);
  const SimulatedVisit at_a = visit_seeing(ways_of(building, a), a);
  const BuildingScore score = score_of(building, {a, b, a}, {at_a, at_a});
  EXPECT_EQ(score.noticed, 2U);
  EXPECT_EQ(score.stars_true, 2U);
}

}  // namespace
}  // namespace cairn::lab
