#include <cmath>

#include <bot_core/pose_t.hpp>
#include <cairn_lcm/odometry_t.hpp>
#include <cairn_lcm/sonar_ring_t.hpp>
#include <mbot_lcm_msgs/pose2D_t.hpp>
#include <vulcan_lcm/odometry_t.hpp>

#include "transport/adapters.hpp"
#include "transport/by_fingerprint.hpp"

namespace cairn {
namespace {

constexpr std::size_t kMaxOdometryBytes = 1024;
constexpr std::size_t kMaxSonarBytes = 16 * 1024;
constexpr std::size_t kMaxSonars = 256;
constexpr double kMaxOffset_m = 100.0;

Error invalid(const std::string& message) {
  return {ErrorCode::kInvalidValue, message};
}

Result<OdometrySample> sample(std::int64_t utime, double x_m, double y_m, double theta_rad) {
  if (utime <= 0) {
    return invalid("odometry: stamp must be after the epoch, is " + std::to_string(utime));
  }
  const OdometrySample sample{time_of_utime(utime), {x_m, y_m, theta_rad}};
  if (Status status = validate(sample); !status) {
    return status.error();
  }
  return sample;
}

Result<OdometrySample> to_domain(const cairn_lcm::odometry_t& message) {
  return sample(message.utime, message.x_m, message.y_m, message.theta_rad);
}

Result<OdometrySample> to_domain(const bot_core::pose_t& message) {
  constexpr double kTolerance = 1e-3;
  const double w = message.orientation[0];
  const double x = message.orientation[1];
  const double y = message.orientation[2];
  const double z = message.orientation[3];
  const double length = std::sqrt(w * w + x * x + y * y + z * z);
  if (!(std::abs(length - 1.0) <= kTolerance)) {
    return invalid("odometry: orientation must be a unit quaternion, its length is " +
                   std::to_string(length));
  }
  const double yaw_rad = std::atan2(2.0 * (w * z + x * y), 1.0 - 2.0 * (y * y + z * z));
  return sample(message.utime, message.pos[0], message.pos[1], yaw_rad);
}

Result<OdometrySample> to_domain(const mbot_lcm_msgs::pose2D_t& message) {
  return sample(message.utime, static_cast<double>(message.x), static_cast<double>(message.y),
                static_cast<double>(message.theta));
}

Result<OdometrySample> to_domain(const vulcan_lcm::odometry_t& message) {
  return sample(message.timestamp, message.x, message.y, message.theta);
}

Result<SonarRing> to_domain(const cairn_lcm::sonar_ring_t& message) {
  const std::size_t sensors = message.ranges_m.size();
  if (message.utime <= 0) {
    return invalid("sonar ring: stamp must be after the epoch, is " +
                   std::to_string(message.utime));
  }
  if (sensors < 1 || sensors > kMaxSonars) {
    return invalid("sonar ring: expected 1 to 256 sensors, got " + std::to_string(sensors));
  }
  SonarRing ring{time_of_utime(message.utime), {}, message.ranges_m};
  for (std::size_t i = 0; i < sensors; ++i) {
    const double x_m = static_cast<double>(message.x_m[i]);
    const double y_m = static_cast<double>(message.y_m[i]);
    const double bearing_rad = static_cast<double>(message.bearing_rad[i]);
    if (!(std::abs(x_m) <= kMaxOffset_m && std::abs(y_m) <= kMaxOffset_m &&
          std::isfinite(bearing_rad))) {
      return invalid("sonar ring: sensor " + std::to_string(i) + " has no sound mounting pose");
    }
    ring.T_robot_sensor.emplace_back(x_m, y_m, bearing_rad);
    if (!(ring.ranges_m[i] > 0.0F)) {
      ring.ranges_m[i] = std::nanf("");
    }
  }
  return ring;
}

}  // namespace

Result<OdometrySample> odometry_of(const std::uint8_t* bytes, std::size_t size) {
  return ByFingerprint<OdometrySample>{bytes, size, kMaxOdometryBytes}
      .as<cairn_lcm::odometry_t, bot_core::pose_t, mbot_lcm_msgs::pose2D_t, vulcan_lcm::odometry_t>(
          [](const auto& message) { return to_domain(message); });
}

Result<SonarRing> sonar_of(const std::uint8_t* bytes, std::size_t size) {
  return ByFingerprint<SonarRing>{bytes, size, kMaxSonarBytes}.as<cairn_lcm::sonar_ring_t>(
      [](const auto& message) { return to_domain(message); });
}

}  // namespace cairn
