#pragma once

#include <memory>
#include <utility>

#include "service/experience.hpp"

namespace cairn::test {

/// A scan of four walls, taken at a pose, one metre of driving after the one before.
inline PerceivedScan scan_at(int number, const Pose2& T_lpm_robot, const Pose2& T_previous_robot) {
  auto scan = std::make_shared<LaserScan>();
  scan->time = time_of_utime(1'000'000 + 100'000LL * number);
  for (int i = 0; i < 8; ++i) {
    scan->bearings_rad.push_back(static_cast<float>(-1.5 + 0.4 * i));
    scan->ranges_m.push_back(2.0F);
  }
  scan->max_range_m = 10.0;
  LocalFix fix;
  fix.time = scan->time;
  fix.T_lpm_robot = T_lpm_robot;
  fix.covariance = 1e-4 * Matrix3d::Identity();
  fix.motion = {T_previous_robot, 1e-4 * Matrix3d::Identity()};
  fix.is_matched = true;
  fix.note = FixNote::kMatched;
  return {std::move(scan), fix, T_lpm_robot, {}};
}

/// A corner: two gateways, seen from the middle.
inline PlaceVisit corner_at(const Vector2d& p_lpm) {
  PlaceVisit visit;
  visit.T_lpm_place = Pose2(p_lpm, 0.0);
  visit.arrival_gateway = 0;
  visit.departure_gateway = 1;
  for (const double bearing_rad : {0.0, -kPi / 2.0}) {
    Gateway gateway;
    gateway.middle = Vector2d(std::cos(bearing_rad), std::sin(bearing_rad));
    const Vector2d across(-gateway.middle.y(), gateway.middle.x());
    gateway.basis_points = {Vector2d(gateway.middle - across), Vector2d(gateway.middle + across)};
    gateway.width_m = 2.0;
    gateway.outward_bearing_rad = bearing_rad;
    gateway.seen_beyond_m = 1.5;
    visit.neighbourhood.gateways.push_back(gateway);
  }
  visit.neighbourhood.fragments = {{0, -1, true}, {1, -1, true}};
  visit.neighbourhood.star.slots = {{0, 2, ControlLaw::kMidline},
                                    {1, 3, ControlLaw::kMidline},
                                    {-1, 0, ControlLaw::kDeadEnd},
                                    {-1, 1, ControlLaw::kDeadEnd}};
  // That one of the fragments ends here is not sure.
  visit.neighbourhood.unsure = {{visit.neighbourhood.gateways[1], -1.5, false}};
  visit.neighbourhood.others = {
      {{{{0, 1, ControlLaw::kMidline}, {-1, 0, ControlLaw::kDeadEnd}}}, {0}, -1.5}};
  visit.neighbourhood.is_complete = true;
  GridGeometry geometry;
  geometry.width = 12;
  geometry.height = 10;
  geometry.origin_m = Vector2d(-0.3, -0.25);
  visit.lpm = OccupancyGrid(geometry);
  visit.lpm.log_odds({3, 4}) = 300;
  return visit;
}

}  // namespace cairn::test
