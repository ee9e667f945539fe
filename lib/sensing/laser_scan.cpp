#include "sensing/laser_scan.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "geometry/angle.hpp"

namespace cairn {
namespace {

constexpr std::size_t kMinBeams = 2;
constexpr std::size_t kMaxBeams = 10'000;
constexpr double kMaxExtent_m = 1e6;
constexpr double kMaxSweep_s = 60.0;

Error invalid(const std::string& message) {
  return {ErrorCode::kInvalidValue, "laser scan: " + message};
}

bool is_sound(const Pose2& pose) {
  return std::isfinite(pose.theta()) && std::abs(pose.x()) <= kMaxExtent_m &&
         std::abs(pose.y()) <= kMaxExtent_m;
}

}  // namespace

Status validate(const LaserScan& scan) {
  const std::size_t beams = scan.ranges_m.size();
  if (beams < kMinBeams || beams > kMaxBeams) {
    return invalid("expected 2 to 10000 beams, got " + std::to_string(beams));
  }
  if (scan.bearings_rad.size() != beams) {
    return invalid("expected " + std::to_string(beams) + " bearings, got " +
                   std::to_string(scan.bearings_rad.size()));
  }
  if (!std::all_of(scan.bearings_rad.begin(), scan.bearings_rad.end(),
                   [](float bearing) { return std::isfinite(bearing); })) {
    return invalid("a bearing is not finite");
  }
  const auto [low, high] = std::minmax_element(scan.bearings_rad.begin(), scan.bearings_rad.end());
  constexpr double kRounding_rad = 1e-3;  // bearings are single precision
  if (static_cast<double>(*high) - static_cast<double>(*low) > 2.0 * kPi + kRounding_rad) {
    return invalid("bearings span more than a full turn");
  }
  if (!(*high > *low)) {
    return invalid("all beams have the same bearing");
  }
  if (!(scan.max_range_m > 0.0 && scan.max_range_m <= kMaxExtent_m)) {
    return invalid("max range must be > 0 and at most " +
                   std::to_string(std::llround(kMaxExtent_m)) + " m, is " +
                   std::to_string(scan.max_range_m));
  }
  if (std::any_of(scan.ranges_m.begin(), scan.ranges_m.end(),
                  [](float range) { return range <= 0.0F; })) {
    return invalid("a range is not greater than 0 m");
  }
  if (std::all_of(scan.ranges_m.begin(), scan.ranges_m.end(),
                  [](float range) { return std::isnan(range); })) {
    return invalid("no range says anything: all are NaN, zero or negative");
  }
  if (!(scan.sweep_duration_s >= 0.0 && scan.sweep_duration_s <= kMaxSweep_s)) {
    return invalid("sweep duration must be in [0, 60] s, is " +
                   std::to_string(scan.sweep_duration_s));
  }
  if (!is_sound(scan.T_robot_laser)) {
    return invalid("mounting pose must be finite and within 1e6 m");
  }
  return {};
}

}  // namespace cairn
