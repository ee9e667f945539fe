#include "service/experience.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "base/check.hpp"
#include "layout/displacement.hpp"

namespace cairn {
namespace {

/// L of Modayil et al.: the robot at a scan, in the place frame of the visit. The place frame has
/// the orientation of the lpm frame, so the covariance stays as it is.
GaussianPose robot_in_place(const Visit& visit, const LocalFix& fix) {
  return {visit.perceived.T_lpm_place.inverse() * fix.T_lpm_robot, fix.covariance};
}

constexpr double kUnknown_m = 4.0;  // sigma of a step

}  // namespace

bool is_way_unknown(const GaussianPose& motion) {
  return motion.covariance(0, 0) + motion.covariance(1, 1) >= 2.0 * kUnknown_m * kUnknown_m;
}

void Experience::add(PerceivedScan scan) {
  key_scans_.add(scan.scan, scan.fix.motion, scan.is_trusted);
  scans_.push_back(std::move(scan));
}

Visit Experience::anchored(PlaceVisit visit) const {
  CAIRN_CHECK(!scans_.empty());
  const std::size_t first = visits_.empty() ? 0 : visits_.back().anchor_scan;
  std::size_t anchor = scans_.size() - 1;
  double least_m = std::numeric_limits<double>::infinity();
  for (std::size_t i = first; i < scans_.size(); ++i) {
    if (i > first && is_way_unknown(scans_[i].fix.motion)) {
      least_m = std::numeric_limits<double>::infinity();
    }
    const double distance_m =
        (scans_[i].fix.T_lpm_robot.translation() - visit.T_lpm_place.translation()).norm();
    if (distance_m < least_m) {
      least_m = distance_m;
      anchor = i;
    }
  }
  return {std::move(visit), anchor};
}

void Experience::continue_last_visit(TimePoint left, int departure_gateway) {
  CAIRN_CHECK(!visits_.empty());
  visits_.back().perceived.left = left;
  visits_.back().perceived.departure_gateway = departure_gateway;
}

bool Experience::is_way_unknown_since_last_visit() const {
  const auto first = visits_.empty() ? std::ptrdiff_t{0}
                                     : static_cast<std::ptrdiff_t>(visits_.back().anchor_scan) + 1;
  return std::any_of(scans_.begin() + first, scans_.end(),
                     [](const PerceivedScan& scan) { return is_way_unknown(scan.fix.motion); });
}

void Experience::add(Visit visit) {
  CAIRN_CHECK(visit.anchor_scan < scans_.size());
  if (!visits_.empty()) {
    CAIRN_CHECK(visit.anchor_scan >= visits_.back().anchor_scan);
    travels_.push_back(travel_between(visits_.back(), visit));
  }
  visits_.push_back(std::move(visit));
}

Travel Experience::travel_between(const Visit& from, const Visit& to) const {
  GaussianPose T_departure_arrival;
  double length_m = 0.0;
  for (std::size_t i = from.anchor_scan + 1; i <= to.anchor_scan; ++i) {
    const GaussianPose& motion = scans_[i].fix.motion;
    T_departure_arrival = compounded(T_departure_arrival, motion);
    length_m += motion.mean.translation().norm();
  }
  return {displacement(robot_in_place(from, scans_[from.anchor_scan].fix), T_departure_arrival,
                       robot_in_place(to, scans_[to.anchor_scan].fix)),
          length_m};
}

}  // namespace cairn
