#include "service/visit_matcher.hpp"

#include <cmath>
#include <limits>
#include <memory>

#include <gmock/gmock.h>

#include "support/experience.hpp"

namespace cairn {
namespace {

using test::corner_at;
using test::scan_at;
using ::testing::SizeIs;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// A map of a corner: walls of 4 m along two sides, and a box that tells one corner from another.
OccupancyGrid corner_map(double box_x_m) {
  GridGeometry geometry;
  geometry.width = 100;
  geometry.height = 100;
  geometry.origin_m = Vector2d(-2.5, -2.5);
  OccupancyGrid map(geometry);
  for (int y = 0; y < 100; ++y) {
    for (int x = 0; x < 100; ++x) {
      const Vector2d p = geometry.center_of({x, y});
      const bool is_wall = std::abs(p.x() + 1.0) < 0.05 || std::abs(p.y() - 1.0) < 0.05 ||
                           (p - Vector2d(box_x_m, -1.0)).cwiseAbs().maxCoeff() < 0.2;
      const bool is_seen = p.x() > -1.1 && p.y() < 1.1;
      map.log_odds({x, y}) =
          static_cast<OccupancyGrid::LogOdds>(!is_seen ? 0 : (is_wall ? 300 : -300));
    }
  }
  return map;
}

/// Visits to corners, seen one scan each, whose places lie where dead reckoning says.
class VisitMatcherTest : public ::testing::Test {
 protected:
  void visit(const Vector2d& p_lpm, double box_x_m = 1.0, double variance_m2 = 1e-4) {
    const int number = static_cast<int>(experience_.visits().size());
    const Vector2d moved = number == 0 ? p_lpm : Vector2d(p_lpm - last_);
    PerceivedScan scan = scan_at(number, Pose2(p_lpm, 0.0), Pose2(moved, 0.0));
    scan.fix.motion.covariance = variance_m2 * Matrix3d::Identity();
    experience_.add(std::move(scan));
    PlaceVisit perceived = corner_at(p_lpm);
    perceived.lpm = corner_map(box_x_m);
    experience_.add(Visit{std::move(perceived), static_cast<std::size_t>(number)});
    last_ = p_lpm;
  }

  Experience experience_;
  VisitMatcher matcher_{experience_, {}};
  Vector2d last_ = Vector2d::Zero();
};

TEST_F(VisitMatcherTest, TellsTheSamePlaceFromAnotherByWhatStandsThere) {
  visit({0, 0});
  visit({9, 0});
  visit({0, 0});
  visit({0, 0}, 0.0);
  const double same = matcher_.log_likelihood_ratio(VisitId{0}, VisitId{2}, {0, 0});
  EXPECT_GT(same, 1.0);
  EXPECT_LT(matcher_.log_likelihood_ratio(VisitId{0}, VisitId{3}, {0, 0}), same);
}

TEST_F(VisitMatcherTest, ComparesEachPairOnceUnderEachAlignment) {
  visit({0, 0});
  visit({9, 0});
  visit({0, 0});
  const Recognition& once = matcher_.compare(VisitId{0}, VisitId{2}, {0, 0});
  // The same alignment told by the other gateway.
  EXPECT_EQ(&once, &matcher_.compare(VisitId{0}, VisitId{2}, {1, 1}));
  EXPECT_NE(&once, &matcher_.compare(VisitId{0}, VisitId{2}, {0, 1}));
}

TEST_F(VisitMatcherTest, AnswersDoNotDependOnWhatWasAskedBefore) {
  for (int i = 0; i < 3; ++i) {
    visit({0, 0}, 0.5 * i);
  }
  const VisitMatcher fresh(experience_, {});
  (void)matcher_.compare(VisitId{0}, VisitId{1}, {0, 0});
  (void)matcher_.compare(VisitId{1}, VisitId{2}, {0, 1});
  EXPECT_EQ(matcher_.compare(VisitId{0}, VisitId{2}, {0, 0}).log_likelihood_ratio,
            fresh.compare(VisitId{0}, VisitId{2}, {0, 0}).log_likelihood_ratio);
}

TEST_F(VisitMatcherTest, DeadReckoningIsTheTravelsOneAfterTheOther) {
  for (int number = 0; number < 80; ++number) {
    visit({0.5 * number, 0.1 * number * number});
  }
  const auto forward = [&](int from, int to) {
    GaussianPose T_from_to;
    for (int travel = from; travel < to; ++travel) {
      T_from_to =
          compounded(T_from_to, experience_.travels()[static_cast<std::size_t>(travel)].T_from_to);
    }
    return T_from_to;
  };
  for (const int to : {79, 3, 40, 79}) {
    const GaussianPose found = matcher_.dead_reckoned(VisitId{2}, VisitId{to});
    const GaussianPose expected = forward(2, to);
    EXPECT_LT((found.mean.translation() - expected.mean.translation()).norm(), 1e-9);
    EXPECT_LT((found.covariance - expected.covariance).norm(), 1e-9);
  }
}

TEST_F(VisitMatcherTest, AWayThatIsKnownMakesItsEndLikely) {
  visit({0, 0});
  visit({9, 0});
  visit({0.5, 0});
  EXPECT_TRUE(matcher_.is_within_reach(VisitId{0}, VisitId{2}));
  EXPECT_FALSE(matcher_.is_within_reach(VisitId{0}, VisitId{1}));
  EXPECT_GT(matcher_.log_density(VisitId{0}, VisitId{2}),
            matcher_.log_density(VisitId{0}, VisitId{1}));
  EXPECT_EQ(matcher_.log_prior_same(VisitId{0}, VisitId{2}), 0.0);
  visit({0, 0}, 1.0, 100.0);
  EXPECT_LT(matcher_.log_prior_same(VisitId{0}, VisitId{3}), -2.0) << "sigma of 10 m";
  EXPECT_TRUE(matcher_.is_within_reach(VisitId{1}, VisitId{3}));
}

TEST_F(VisitMatcherTest, RefutesWhatDeadReckoningCannotReach) {
  visit({0, 0});
  visit({40, 0});
  EXPECT_EQ(matcher_.log_likelihood_ratio(VisitId{0}, VisitId{1}, {0, 0}), -kInfinity);
}

TEST_F(VisitMatcherTest, SaysNothingOfTheMapsWhereTheyWereTakenWithOtherCells) {
  visit({0, 0});
  visit({0, 0});
  PlaceVisit coarse = corner_at({0, 0});
  GridGeometry geometry;
  geometry.cell_m = 0.1;
  coarse.lpm = OccupancyGrid(geometry);
  experience_.add(scan_at(2, Pose2(), Pose2()));
  experience_.add(Visit{coarse, 2});
  EXPECT_EQ(matcher_.log_likelihood_ratio(VisitId{0}, VisitId{2}, {0, 0}), 0.0);
}

/// Five visits: to three corners in a row, to the second one again, and to a fourth. What the
/// fourth visit saw of the second corner is told as TopologicalMap::PlacedVisit has it.
TopologicalMap map_with_return(const std::vector<int>& gateways_of_fourth) {
  const auto stars = std::make_shared<StarCatalogue>();
  const StarId corner = stars->add(corner_at({0, 0}).neighbourhood.star);
  WorkingMap map(*stars, WorkingMap::Rings::kOne);
  map.start(corner, VisitId{0});
  using Kind = MapChange::Kind;
  map.apply({Kind::kPlace, corner, VisitId{1}, map.gateway({PlaceId{0}, 1}), 0});
  map.apply({Kind::kPlace, corner, VisitId{2}, map.gateway({PlaceId{1}, 1}), 0});
  map.apply({Kind::kStrayPlace, corner, VisitId{4}, map.gateway({PlaceId{2}, 1}), 0});
  const auto at = [](int place) { return GatewayRef{PlaceId{place}, 0}; };
  return {stars,
          map,
          {{at(0), 0, {}, false},
           {at(1), 0, {}, false},
           {at(2), 0, {}, false},
           {at(1), 0, gateways_of_fourth, false},
           {at(3), 0, {}, false}}};
}

class ReturnTest : public VisitMatcherTest {
 protected:
  void SetUp() override {
    for (const Vector2d& at :
         {Vector2d(0, 0), Vector2d(9, 0), Vector2d(9, -9), Vector2d(9.1, 0), Vector2d(20, 0)}) {
      visit(at);
    }
  }
};

TEST_F(ReturnTest, AVisitThatSharesAGatewayWithItsPlaceIsHeldByTheMaps) {
  const TopologicalMap map = map_with_return({0, 1});
  const GaussianPose held = matcher_.T_place_visit(map, VisitId{3});
  EXPECT_NEAR(held.mean.x(), 0.0, 0.05);  // The maps are alike; dead reckoning said 0.1.
  EXPECT_THAT(matcher_.constraints(map), SizeIs(4));
}

TEST_F(ReturnTest, AVisitThatSharesNoGatewayWithItsPlaceIsHeldByDeadReckoning) {
  const TopologicalMap map = map_with_return({-1, -1});
  const GaussianPose held = matcher_.T_place_visit(map, VisitId{3});
  EXPECT_NEAR(held.mean.x(), 0.1, 1e-6);
  EXPECT_NEAR(held.mean.y(), 0.0, 1e-6);
}

TEST_F(ReturnTest, DeadReckoningSpeaksAgainstAVisitWithoutCommonGatewayFarFromItsPlace) {
  EXPECT_EQ(matcher_.chi2_of_unmatched(map_with_return({0, 1})), 0.0);
  EXPECT_LT(matcher_.chi2_of_unmatched(map_with_return({-1, -1})), 0.1) << "0.1 m away";
}

TEST_F(VisitMatcherTest, DeadReckoningSpeaksAgainstAPlaceOutOfReach) {
  for (const Vector2d& at :
       {Vector2d(0, 0), Vector2d(9, 0), Vector2d(9, -9), Vector2d(29, 0), Vector2d(40, 0)}) {
    visit(at);
  }
  EXPECT_GT(matcher_.chi2_of_unmatched(map_with_return({-1, -1})), 9.0) << "20 m away";
}

TEST_F(ReturnTest, TheWayPastAVisitThatSharesNoGatewayHoldsItsNeighboursTogether) {
  const TopologicalMap map = map_with_return({-1, -1});
  const std::vector<TravelConstraint> constraints = matcher_.constraints(map);
  ASSERT_THAT(constraints, SizeIs(5));
  const TravelConstraint& past = constraints.back();
  EXPECT_EQ(past.from, 2);
  EXPECT_EQ(past.to, 3);
  EXPECT_NEAR(past.T_from_to.mean.x(), 11.0, 0.05);
  EXPECT_NEAR(past.T_from_to.mean.y(), 9.0, 0.05);
  EXPECT_TRUE(is_positive_definite(past.T_from_to.covariance));
}

}  // namespace
}  // namespace cairn
