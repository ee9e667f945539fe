#include "runtime/planner.hpp"

#include <limits>

#include <gmock/gmock.h>

#include "support/experience.hpp"

namespace cairn {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using Code = cairn_lcm::result_t;

/// A corridor along x, 20 m long and 3 m wide, with a place at either end, driven through.
struct Corridor {
  MapState state;
  GlobalMap map{GlobalMapOptions{}};

  Corridor() {
    for (int i = 0; i <= 20; ++i) {
      state.trajectory.push_back({seen_from(i), Pose2(i, 0.0, 0.0)});
    }
    map.draw(state.trajectory);
    for (const double x : {1.0, 19.0}) {
      MappedPlace place;
      place.id = x < 5.0 ? 0 : 1;
      place.T_global_place.mean = Pose2(x, 0.0, 0.0);
      MappedGateway gateway;
      gateway.perceived.outward_bearing_rad = x < 5.0 ? 0.0 : kPi;
      gateway.is_pending = false;
      place.gateways = {gateway};
      state.places.push_back(place);
    }
    MappedSegment segment;
    segment.from_place = 0;
    segment.from_gateway = 0;
    segment.to_place = 1;
    segment.to_gateway = 0;
    segment.length_m = 18.0;
    segment.first_scan = 1;
    segment.last_scan = 19;
    state.segments = {segment};
  }

  static std::shared_ptr<const LaserScan> seen_from(double x_m) {
    auto scan = std::make_shared<LaserScan>();
    scan->max_range_m = 30.0;
    for (int i = 0; i < 360; ++i) {
      const double bearing_rad = -kPi + i * kPi / 180.0;
      const double dx = std::cos(bearing_rad);
      const double dy = std::sin(bearing_rad);
      const double to_side_m = 1.5 / std::max(std::abs(dy), 1e-6);
      const double to_end_m = (dx > 0 ? 20.5 - x_m : x_m + 0.5) / std::max(std::abs(dx), 1e-6);
      scan->bearings_rad.push_back(static_cast<float>(bearing_rad));
      scan->ranges_m.push_back(static_cast<float>(std::min(to_side_m, to_end_m)));
    }
    return scan;
  }

  [[nodiscard]] cairn_lcm::plan_t plan(const cairn_lcm::plan_request_t& request) const {
    return answer(request, state, map, {}, {5, 6});
  }
};

cairn_lcm::plan_request_t between(std::int64_t from, std::int64_t to) {
  cairn_lcm::plan_request_t request{};
  request.header.client_id = 3;
  request.header.request_id = 9;
  request.from_place = from;
  request.goal_place = to;
  request.goal_theta_rad = std::numeric_limits<double>::quiet_NaN();
  return request;
}

TEST(Planner, LeadsFromPlaceToPlaceAlongTheRoute) {
  const cairn_lcm::plan_t plan = Corridor().plan(between(0, 1));
  EXPECT_EQ(plan.result.code, Code::OK) << plan.result.reason;
  EXPECT_THAT(plan.places, ElementsAre(0, 1));
  EXPECT_NEAR(plan.length_m, 18.0, 0.5);
  EXPECT_EQ(plan.result.header.client_id, 3);
  EXPECT_EQ(plan.result.header.request_id, 9);
  EXPECT_EQ(plan.result.header.boot_id, 5);
}

TEST(Planner, LeadsFromTheRobotToAPoseWithItsHeading) {
  cairn_lcm::plan_request_t request = between(-1, -1);
  request.goal_x_m = 2.0;
  request.goal_y_m = 0.5;
  request.goal_theta_rad = 1.0;
  const cairn_lcm::plan_t plan = Corridor().plan(request);
  ASSERT_EQ(plan.result.code, Code::OK) << plan.result.reason;
  EXPECT_NEAR(plan.x_m.back(), 2.0, 0.1);
  EXPECT_NEAR(plan.theta_rad.back(), 1.0, 1e-9);
}

TEST(Planner, SaysWhichPlaceIsMissing) {
  const cairn_lcm::plan_t plan = Corridor().plan(between(0, 7));
  EXPECT_EQ(plan.result.code, Code::NOT_FOUND);
  EXPECT_THAT(plan.result.reason, HasSubstr("no place 7; the map has places 0 to 1"));
}

TEST(Planner, SaysThatAGoalLiesInAWallOrIsNoNumber) {
  cairn_lcm::plan_request_t request = between(0, -1);
  request.goal_x_m = 5.0;
  request.goal_y_m = 1.5;
  EXPECT_EQ(Corridor().plan(request).result.code, Code::BAD_REQUEST);
  request.goal_y_m = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(Corridor().plan(request).result.reason, HasSubstr("must be finite"));
}

TEST(Planner, SaysThatNothingIsKnownYet) {
  const MapState empty;
  const cairn_lcm::plan_t plan = answer(between(-1, 0), empty, GlobalMap{{}}, {}, {});
  EXPECT_EQ(plan.result.code, Code::NOT_FOUND);
}

}  // namespace
}  // namespace cairn
