#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <bot_core/planar_lidar_t.hpp>
#include <cairn_lcm/laser_scan_t.hpp>
#include <mbot_lcm_msgs/lidar_t.hpp>
#include <vulcan_lcm/laser_3dof_t.hpp>
#include <vulcan_lcm/laser_t.hpp>

#include "base/validator.hpp"
#include "geometry/angle.hpp"
#include "transport/adapters.hpp"
#include "transport/by_fingerprint.hpp"

namespace cairn {
namespace {

/// 10,000 beams of the most talkative type.
constexpr std::size_t kMaxLaserBytes = 256 * 1024;
constexpr double kLongestSweep_s = 10.0;

Error invalid(const std::string& message) {
  return {ErrorCode::kInvalidValue, message};
}

/// A scan whose readings are still as the sensor gave them.
struct RawScan {
  std::int64_t utime = 0;
  std::vector<float> bearings_rad;
  std::vector<float> ranges_m;
  double max_range_m = 0.0;  ///< 0: the message does not say.
  double sweep_duration_s = 0.0;
  Pose2 T_mount_laser;
};

std::vector<float> even_bearings(double first_rad, double step_rad, std::size_t beams) {
  std::vector<float> bearings_rad(beams);
  for (std::size_t i = 0; i < beams; ++i) {
    bearings_rad[i] = static_cast<float>(first_rad + static_cast<double>(i) * step_rad);
  }
  return bearings_rad;
}

/// No laser on a robot reaches farther: what says so is no reading.
constexpr float kLongestReading_m = 10'000.0F;

/// Where the scan has no reading at all, any limit will do.
double longest_reading_m(const std::vector<float>& ranges_m) {
  float longest_m = 0.0F;
  for (const float range_m : ranges_m) {
    longest_m = range_m <= kLongestReading_m ? std::max(longest_m, range_m) : longest_m;
  }
  return longest_m > 0.0F ? static_cast<double>(longest_m) : 1.0;
}

/// The one place where readings get their meaning.
Result<LaserScan> settle(RawScan raw, const LaserChannelOptions& options) {
  if (raw.utime <= 0) {
    return invalid("laser scan: stamp must be after the epoch, is " + std::to_string(raw.utime));
  }
  LaserScan scan;
  scan.time = time_of_utime(raw.utime);
  scan.bearings_rad = std::move(raw.bearings_rad);
  scan.ranges_m = std::move(raw.ranges_m);
  scan.max_range_m = options.max_range_m > 0.0 ? options.max_range_m : raw.max_range_m;
  if (scan.max_range_m == 0.0) {
    scan.max_range_m = longest_reading_m(scan.ranges_m);
  }
  for (float& range_m : scan.ranges_m) {
    const double reading_m = static_cast<double>(range_m);
    if (!(reading_m > 0.0) || reading_m < options.min_range_m) {
      range_m = std::numeric_limits<float>::quiet_NaN();
    } else if (reading_m > scan.max_range_m) {
      range_m = std::numeric_limits<float>::infinity();
    }
  }
  const bool is_sweep_known = raw.sweep_duration_s > 0.0 && raw.sweep_duration_s <= kLongestSweep_s;
  scan.sweep_duration_s = is_sweep_known ? raw.sweep_duration_s : 0.0;
  scan.T_robot_laser = options.T_robot_laser * raw.T_mount_laser;
  if (Status status = validate(scan); !status) {
    return status.error();
  }
  return scan;
}

Result<LaserScan> to_domain(const cairn_lcm::laser_scan_t& message,
                            const LaserChannelOptions& options) {
  RawScan raw;
  raw.utime = message.utime;
  raw.bearings_rad =
      even_bearings(message.first_bearing_rad, message.bearing_step_rad, message.ranges_m.size());
  raw.ranges_m = message.ranges_m;
  raw.max_range_m = message.max_range_m;
  raw.sweep_duration_s = message.sweep_duration_s;
  return settle(std::move(raw), options);
}

Result<LaserScan> to_domain(const bot_core::planar_lidar_t& message,
                            const LaserChannelOptions& options) {
  RawScan raw;
  raw.utime = message.utime;
  raw.bearings_rad = even_bearings(static_cast<double>(message.rad0),
                                   static_cast<double>(message.radstep), message.ranges.size());
  raw.ranges_m = message.ranges;
  return settle(std::move(raw), options);
}

/// Drivers of spinning lidars may go on a little beyond the full turn.
void keep_within_a_turn(std::vector<float>* bearings_rad) {
  if (bearings_rad->empty()) {
    return;
  }
  const auto [low, high] = std::minmax_element(bearings_rad->begin(), bearings_rad->end());
  if (static_cast<double>(*high) - static_cast<double>(*low) <= 2.0 * kPi) {
    return;
  }
  for (float& bearing_rad : *bearings_rad) {
    bearing_rad = static_cast<float>(wrap_angle(static_cast<double>(bearing_rad)));
  }
}

Result<LaserScan> to_domain(const mbot_lcm_msgs::lidar_t& message,
                            const LaserChannelOptions& options) {
  RawScan raw;
  raw.utime = message.utime;
  raw.ranges_m = message.ranges;
  raw.bearings_rad = message.thetas;
  for (float& bearing_rad : raw.bearings_rad) {
    bearing_rad *= static_cast<float>(options.theta_sign);
  }
  if (std::all_of(raw.bearings_rad.begin(), raw.bearings_rad.end(),
                  [](float bearing_rad) { return std::isfinite(bearing_rad); })) {
    keep_within_a_turn(&raw.bearings_rad);
  }
  if (!message.times.empty()) {
    // In floating point: hostile stamps may be far apart.
    raw.sweep_duration_s =
        (static_cast<double>(message.times.back()) - static_cast<double>(message.times.front())) *
        1e-6;
  }
  return settle(std::move(raw), options);
}

template <class Message>
RawScan raw_scan_of_vulcan(const Message& message, double sense) {
  RawScan raw;
  raw.utime = message.timestamp;
  raw.bearings_rad =
      even_bearings(sense * static_cast<double>(message.start_angle),
                    sense * static_cast<double>(message.angle_increment), message.ranges.size());
  raw.ranges_m = message.ranges;
  raw.max_range_m = static_cast<double>(message.max_range);
  return raw;
}

Result<LaserScan> to_domain(const vulcan_lcm::laser_3dof_t& message,
                            const LaserChannelOptions& options) {
  RawScan raw = raw_scan_of_vulcan(message, 1.0);
  raw.T_mount_laser = {static_cast<double>(message.offset_x), static_cast<double>(message.offset_y),
                       static_cast<double>(message.offset_theta)};
  return settle(std::move(raw), options);
}

Result<LaserScan> to_domain(const vulcan_lcm::laser_t& message,
                            const LaserChannelOptions& options) {
  constexpr double kMostTilt_rad = 0.1;
  const double roll_rad = static_cast<double>(message.offset_roll);
  const double pitch_rad = static_cast<double>(message.offset_pitch);
  const bool is_upside_down = std::abs(std::remainder(roll_rad, 2.0 * kPi)) > kPi / 2.0;
  const double tilt_rad = std::abs(std::remainder(roll_rad, kPi));
  if (!(tilt_rad <= kMostTilt_rad && std::abs(pitch_rad) <= kMostTilt_rad)) {
    return invalid("laser scan: laser is not mounted level, roll " + std::to_string(roll_rad) +
                   " rad, pitch " + std::to_string(pitch_rad) + " rad");
  }
  RawScan raw = raw_scan_of_vulcan(message, is_upside_down ? -1.0 : 1.0);
  raw.T_mount_laser = {static_cast<double>(message.offset_x), static_cast<double>(message.offset_y),
                       static_cast<double>(message.offset_yaw)};
  return settle(std::move(raw), options);
}

}  // namespace

Status validate(const LaserChannelOptions& options) {
  constexpr double kMaxRange_m = 1e6;
  const Pose2& mount = options.T_robot_laser;
  return Validator("lasers")
      .require("channel",
               !options.channel.empty() && options.channel.size() <= wire::kMaxChannelLength,
               "have 1 to 63 characters")
      .within("T_robot_laser.x", mount.x(), -100.0, 100.0)
      .within("T_robot_laser.y", mount.y(), -100.0, 100.0)
      .within("T_robot_laser.theta", mount.theta(), -kPi, kPi)
      .require("theta_sign", std::abs(options.theta_sign) == 1.0, "be 1 or -1")
      .within("min_range_m", options.min_range_m, 0.0, kMaxRange_m)
      .within("max_range_m", options.max_range_m, 0.0, kMaxRange_m)
      .require("max_range_m",
               options.max_range_m == 0.0 || options.max_range_m > options.min_range_m,
               "be 0 or greater than min_range_m")
      .status();
}

Result<LaserScan> scan_of(const std::uint8_t* bytes,
                          std::size_t size,
                          const LaserChannelOptions& options) {
  const auto to_scan = [&options](const auto& message) { return to_domain(message, options); };
  return ByFingerprint<LaserScan>{bytes, size, kMaxLaserBytes}
      .as<cairn_lcm::laser_scan_t, bot_core::planar_lidar_t, mbot_lcm_msgs::lidar_t,
          vulcan_lcm::laser_t, vulcan_lcm::laser_3dof_t>(to_scan);
}

}  // namespace cairn
