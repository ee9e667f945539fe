#include "planning/route.hpp"

#include <cmath>
#include <limits>
#include <random>

#include <gmock/gmock.h>

#include "geometry/angle.hpp"

namespace cairn {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// Four gateways a place: east, south, west, north, clockwise.
const std::vector<double> kCrossing = {0.0, -kPi / 2.0, kPi, kPi / 2.0};
constexpr int kEast = 0;
constexpr int kSouth = 1;
constexpr int kWest = 2;
constexpr int kNorth = 3;

/// Places in a grid, joined to their neighbours; segments of random lengths.
RouteMap city(int columns, int rows, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> length_m(1.0, 9.0);
  RouteMap map;
  map.gateway_bearings_rad.assign(static_cast<std::size_t>(columns * rows), kCrossing);
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < columns; ++x) {
      const int place = y * columns + x;
      if (x + 1 < columns) {
        map.segments.push_back({{place, kEast}, {place + 1, kWest}, length_m(random)});
      }
      if (y + 1 < rows) {
        map.segments.push_back({{place, kNorth}, {place + columns, kSouth}, length_m(random)});
      }
    }
  }
  return map;
}

RoutePlanner planner_of(const RouteMap& map) {
  Result<RoutePlanner> planner = RoutePlanner::of(map);
  EXPECT_TRUE(planner);
  return *std::move(planner);
}

/// All shortest lengths by Floyd and Warshall's algorithm: the oracle.
std::vector<std::vector<double>> all_lengths(const RouteMap& map) {
  const std::size_t count = map.gateway_bearings_rad.size();
  std::vector<std::vector<double>> length_m(
      count, std::vector<double>(count, std::numeric_limits<double>::infinity()));
  for (std::size_t i = 0; i < count; ++i) {
    length_m[i][i] = 0.0;
  }
  for (const RouteSegment& segment : map.segments) {
    const auto a = static_cast<std::size_t>(segment.a.place);
    const auto b = static_cast<std::size_t>(segment.b.place);
    length_m[a][b] = length_m[b][a] = std::min(length_m[a][b], segment.length_m);
  }
  for (std::size_t k = 0; k < count; ++k) {
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t j = 0; j < count; ++j) {
        length_m[i][j] = std::min(length_m[i][j], length_m[i][k] + length_m[k][j]);
      }
    }
  }
  return length_m;
}

TEST(Route, IsTheShortestOfAll) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    SCOPED_TRACE(seed);
    const RouteMap map = city(5, 4, seed);
    const RoutePlanner planner = planner_of(map);
    const std::vector<std::vector<double>> lengths = all_lengths(map);
    for (int from = 0; from < 20; ++from) {
      for (int to = 0; to < 20; ++to) {
        const Result<Route> route = planner.find_route({{from}}, {{to}});
        ASSERT_TRUE(route);
        EXPECT_NEAR(route->length_m,
                    lengths[static_cast<std::size_t>(from)][static_cast<std::size_t>(to)], 1e-9);
      }
    }
  }
}

TEST(Route, LegsJoinItsPlaces) {
  const RoutePlanner planner = planner_of(city(6, 5, 1));
  const Result<Route> route = planner.find_route({{0}}, {{29}});
  ASSERT_TRUE(route);
  ASSERT_EQ(route->legs.size() + 1, route->places.size());
  double length_m = 0.0;
  for (std::size_t i = 0; i < route->legs.size(); ++i) {
    EXPECT_EQ(route->legs[i].departure.place, route->places[i]);
    EXPECT_EQ(route->legs[i].arrival.place, route->places[i + 1]);
    length_m += route->legs[i].length_m;
  }
  EXPECT_NEAR(route->length_m, length_m, 1e-9);
}

TEST(Route, FromAPlaceToItselfStays) {
  const Result<Route> route = planner_of(city(2, 2, 1)).find_route({{3}}, {{3}});
  ASSERT_TRUE(route);
  EXPECT_THAT(route->places, ElementsAre(3));
  EXPECT_EQ(route->length_m, 0.0);
}

TEST(Route, ARobotBetweenPlacesTakesTheBetterWayOut) {
  RouteMap map = city(4, 1, 1);
  for (RouteSegment& segment : map.segments) {
    segment.length_m = 10.0;
  }
  const RoutePlanner planner = planner_of(map);
  const Result<Route> route = planner.find_route({{1, 3.0}, {2, 7.0}}, {{0, 1.0}, {3, 0.5}});
  ASSERT_TRUE(route);
  EXPECT_THAT(route->places, ElementsAre(1, 0));
  EXPECT_NEAR(route->length_m, 14.0, 1e-9);
}

TEST(Route, GoesAroundClosedGatewaysOfEitherEnd) {
  RouteMap map = city(2, 2, 1);
  for (RouteSegment& segment : map.segments) {
    segment.length_m = 1.0;
  }
  const RoutePlanner planner = planner_of(map);
  EXPECT_EQ(planner.find_route({{0}}, {{1}})->places.size(), 2U);
  EXPECT_EQ(planner.find_route({{0}}, {{1}}, {{0, kEast}})->places.size(), 4U);
  EXPECT_EQ(planner.find_route({{0}}, {{1}}, {{1, kWest}})->places.size(), 4U);
}

TEST(Route, SaysWhetherClosedGatewaysAreTheReason) {
  RouteMap map = city(2, 1, 1);
  map.gateway_bearings_rad.push_back(kCrossing);
  const RoutePlanner planner = planner_of(map);
  const Result<Route> closed = planner.find_route({{0}}, {{1}}, {{0, kEast}});
  ASSERT_FALSE(closed);
  EXPECT_EQ(closed.error().code, ErrorCode::kNotFound);
  EXPECT_THAT(closed.error().message, HasSubstr("closed"));
  const Result<Route> apart = planner.find_route({{0}}, {{2}}, {{0, kEast}});
  ASSERT_FALSE(apart);
  EXPECT_THAT(apart.error().message, ::testing::Not(HasSubstr("closed")));
}

TEST(Route, ToldAsTurnsAndTravels) {
  RouteMap map = city(2, 2, 1);
  for (RouteSegment& segment : map.segments) {
    segment.length_m = 4.0;
  }
  const RoutePlanner planner = planner_of(map);
  const Result<Route> route = planner.find_route({{0}}, {{3}}, {{0, kNorth}});
  ASSERT_TRUE(route);
  EXPECT_THAT(planner.instructions(*route),
              ElementsAre("at place 0: leave by gateway 0 and travel 4.0 m to place 1",
                          "at place 1: turn left, leave by gateway 3 and travel 4.0 m to place 3",
                          "arrive at place 3"));
}

TEST(Route, RefusesUnknownPlacesAndBadMaps) {
  const RoutePlanner planner = planner_of(city(2, 2, 1));
  EXPECT_FALSE(planner.find_route({}, {{1}}));
  EXPECT_FALSE(planner.find_route({{0}}, {{4}}));
  EXPECT_FALSE(planner.find_route({{-1}}, {{1}}));
  EXPECT_FALSE(planner.find_route({{0, NAN}}, {{1}}));
  RouteMap map = city(2, 1, 1);
  map.segments[0].length_m = -1.0;
  EXPECT_FALSE(RoutePlanner::of(map));
  map = city(2, 1, 1);
  map.segments[0].b.gateway = 4;
  EXPECT_FALSE(RoutePlanner::of(map));
}

}  // namespace
}  // namespace cairn
