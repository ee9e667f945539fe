#include "service/recalled_readings.hpp"

#include <cmath>

#include <gmock/gmock.h>

#include "support/experience.hpp"

namespace cairn {
namespace {

using test::scan_at;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr double kEast_rad = 0.0;
constexpr double kSouth_rad = -kPi / 2.0;
constexpr double kWest_rad = kPi;
constexpr double kNorth_rad = kPi / 2.0;

/// Walls around a crossing of corridors 2 m wide, and a box that tells it from others.
OccupancyGrid crossing_map(double box_x_m) {
  GridGeometry geometry;
  geometry.width = 120;
  geometry.height = 120;
  geometry.origin_m = Vector2d(-3.0, -3.0);
  OccupancyGrid map(geometry);
  for (int y = 0; y < 120; ++y) {
    for (int x = 0; x < 120; ++x) {
      const Vector2d p = geometry.center_of({x, y});
      const double inner = p.cwiseAbs().minCoeff();
      const bool is_box = (p - Vector2d(box_x_m, 0.6)).cwiseAbs().maxCoeff() < 0.25;
      const bool is_wall = is_box || (inner > 1.0 && inner < 1.1);
      map.log_odds({x, y}) =
          static_cast<OccupancyGrid::LogOdds>(inner > 1.1 ? 0 : (is_wall ? 300 : -300));
    }
  }
  return map;
}

/// A star whose fragments all end at the place.
Star star_of_ends(int gateways) {
  Star star;
  const auto count = static_cast<std::size_t>(gateways);
  for (std::size_t g = 0; g < count; ++g) {
    star.slots.push_back({static_cast<int>(g), g + count, ControlLaw::kMidline});
  }
  for (std::size_t g = 0; g < count; ++g) {
    star.slots.push_back({-1, g, ControlLaw::kDeadEnd});
  }
  return star;
}

PlaceVisit crossing_seen(const std::vector<double>& bearings_rad,
                         int arrival,
                         int departure,
                         double box_x_m) {
  PlaceVisit visit = test::corner_at({0, 0});
  visit.neighbourhood.gateways.clear();
  for (const double bearing_rad : bearings_rad) {
    Gateway gateway;
    const Vector2d outward(std::cos(bearing_rad), std::sin(bearing_rad));
    const Vector2d across(-outward.y(), outward.x());
    gateway.middle = 1.2 * outward;
    gateway.basis_points = {Vector2d(gateway.middle - across), Vector2d(gateway.middle + across)};
    gateway.width_m = 2.0;
    gateway.outward_bearing_rad = bearing_rad;
    visit.neighbourhood.gateways.push_back(gateway);
  }
  visit.neighbourhood.star = star_of_ends(static_cast<int>(bearings_rad.size()));
  visit.neighbourhood.others.clear();
  visit.neighbourhood.unsure.clear();
  visit.arrival_gateway = arrival;
  visit.departure_gateway = departure;
  visit.lpm = crossing_map(box_x_m);
  return visit;
}

/// Visits to one spot, each a drive away from the one before.
class RecalledReadings : public ::testing::Test {
 protected:
  void visit(PlaceVisit perceived, const Vector2d& moved = Vector2d::Zero()) {
    const int number = static_cast<int>(experience_.visits().size());
    p_ += moved;
    experience_.add(scan_at(number, Pose2(p_, 0.0), Pose2(moved, 0.0)));
    perceived.T_lpm_place = Pose2(p_, 0.0);
    experience_.add(Visit{std::move(perceived), static_cast<std::size_t>(number)});
  }
  [[nodiscard]] std::vector<Reading> recalled(const RecallOptions& options = {}) const {
    const VisitId last{static_cast<int>(experience_.visits().size()) - 1};
    const PlaceVisit& now = experience_.visits()[last.index()].perceived;
    return recalled_readings(experience_, matcher_,
                             {now.neighbourhood.star, now.arrival_gateway, last}, options);
  }

  Experience experience_;
  VisitMatcher matcher_{experience_, {}};
  Vector2d p_ = Vector2d::Zero();
};

TEST_F(RecalledReadings, NameTheGatewaysThatWereSeenAgain) {
  visit(crossing_seen({kEast_rad, kSouth_rad, kWest_rad, kNorth_rad}, 0, 1, 0.6));
  visit(crossing_seen({kSouth_rad, kNorth_rad}, 0, 1, 0.6));
  const std::vector<Reading> readings = recalled();
  ASSERT_THAT(readings, SizeIs(1));
  EXPECT_TRUE(readings[0].is_recalled);
  EXPECT_EQ(readings[0].star, star_of_ends(4));
  EXPECT_THAT(readings[0].gateways, ElementsAre(-1, 0, -1, 1));
  EXPECT_DOUBLE_EQ(readings[0].log_likelihood, -2.0 * RecallOptions{}.log_penalty_difference);
}

TEST_F(RecalledReadings, HaveTheGatewaysByWhichTheRobotCameAndWent) {
  visit(crossing_seen({kEast_rad, kWest_rad}, 0, 1, 0.6));
  visit(crossing_seen({kSouth_rad, kWest_rad, kNorth_rad}, 0, 2, 0.6));
  const std::vector<Reading> readings = recalled();
  ASSERT_THAT(readings, SizeIs(1));
  EXPECT_EQ(gateway_count(readings[0].star), 4);
  EXPECT_THAT(readings[0].gateways, ElementsAre(-1, 0, 1, 2)) << "east, south, west, north";
  EXPECT_DOUBLE_EQ(readings[0].log_likelihood, -3.0 * RecallOptions{}.log_penalty_difference);
}

TEST_F(RecalledReadings, AreOnlyOfPlacesWhoseMapsLieOnEachOther) {
  visit(crossing_seen({kEast_rad, kSouth_rad, kWest_rad, kNorth_rad}, 0, 1, 0.6));
  PlaceVisit elsewhere = crossing_seen({kSouth_rad, kNorth_rad}, 0, 1, 0.6);
  for (int y = 0; y < 120; ++y) {
    for (int x = 50; x < 70; ++x) {
      elsewhere.lpm.log_odds({x, y}) = 300;  // Solid where the other is free.
    }
  }
  visit(std::move(elsewhere));
  EXPECT_THAT(recalled(), IsEmpty());
}

TEST_F(RecalledReadings, AreOnlyOfPlacesThatDeadReckoningReaches) {
  visit(crossing_seen({kEast_rad, kSouth_rad, kWest_rad, kNorth_rad}, 0, 1, 0.6));
  visit(crossing_seen({kSouth_rad, kNorth_rad}, 0, 1, 0.6), {12.0, 0.0});
  EXPECT_THAT(recalled(), IsEmpty());
}

TEST_F(RecalledReadings, AreNotNeededWhereTheStarLooksTheSame) {
  visit(crossing_seen({kSouth_rad, kNorth_rad}, 0, 1, 0.6));
  visit(crossing_seen({kSouth_rad, kNorth_rad}, 0, 1, 0.6));
  EXPECT_THAT(recalled(), IsEmpty());
}

TEST_F(RecalledReadings, AreAsManyAsAViewHasRoomForAndTheSameEveryTime) {
  for (int i = 0; i < 12; ++i) {
    std::vector<double> bearings = {kEast_rad, kSouth_rad, kWest_rad, kNorth_rad};
    bearings.resize(static_cast<std::size_t>(2 + i % 3));
    visit(crossing_seen(bearings, i % 2, (i + 1) % 2, 0.6));
  }
  const std::vector<Reading> readings = recalled();
  EXPECT_LT(readings.size(), kMostReadings);
  const std::vector<Reading> again = recalled();
  ASSERT_EQ(again.size(), readings.size());
  for (std::size_t i = 0; i < readings.size(); ++i) {
    EXPECT_EQ(again[i].star, readings[i].star);
    EXPECT_EQ(again[i].gateways, readings[i].gateways);
    EXPECT_TRUE(validate(readings[i], 4, 1).ok());
  }
}

TEST_F(RecalledReadings, AreOfNoVisitWhereNoneIsToBeCompared) {
  visit(crossing_seen({kEast_rad, kSouth_rad, kWest_rad, kNorth_rad}, 0, 1, 0.6));
  visit(crossing_seen({kSouth_rad, kNorth_rad}, 0, 1, 0.6));
  RecallOptions options;
  options.max_visits = 0;
  EXPECT_THAT(recalled(options), IsEmpty());
}

TEST(RecallOptions, AreRefusedOutOfRange) {
  RecallOptions options;
  options.max_visits = -1;
  options.log_penalty_difference = -0.5;
  const Status status = validate(options);
  ASSERT_FALSE(status.ok());
  EXPECT_THAT(status.error().message, ::testing::HasSubstr("max_visits"));
  EXPECT_THAT(status.error().message, ::testing::HasSubstr("log_penalty_difference"));
}

}  // namespace
}  // namespace cairn
