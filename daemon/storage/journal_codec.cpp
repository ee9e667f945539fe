#include "storage/journal_codec.hpp"

#include <cmath>
#include <limits>
#include <utility>

#include <cairn_journal/scan_record_t.hpp>

#include "storage/journal_parts.hpp"
#include "wire/document.hpp"

namespace cairn::wire {

template <>
inline constexpr std::string_view kSignatureText<cairn_journal::scan_record_t> =
    "q d[=3] d[=9] d[=3] d[=9] i i i d d i d[=3] d d i f[14] i f[16] i d[=3] i q[20] d[20][=3]";

}  // namespace cairn::wire

namespace cairn {
namespace {

using journal::kMaxRowBytes;
using journal::malformed;
using journal::matrix_of;
using journal::pose_of;
using journal::put;

float evenly_spaced(float first, float second, std::size_t i) {
  return static_cast<float>(static_cast<double>(first) +
                            (static_cast<double>(second) - static_cast<double>(first)) *
                                static_cast<double>(i));
}

/// Most scanners have evenly spaced beams: two bearings then stand for all, exactly.
std::vector<float> packed_bearings(const std::vector<float>& bearings) {
  for (std::size_t i = 0; i < bearings.size(); ++i) {
    if (bearings.size() < 3 || bearings[i] != evenly_spaced(bearings[0], bearings[1], i)) {
      return bearings;
    }
  }
  return {bearings.begin(), bearings.begin() + 2};
}

std::vector<float> unpacked_bearings(const std::vector<float>& packed, std::size_t count) {
  if (packed.size() == count || packed.size() != 2) {
    return packed;
  }
  std::vector<float> bearings(count);
  for (std::size_t i = 0; i < count; ++i) {
    bearings[i] = evenly_spaced(packed[0], packed[1], i);
  }
  return bearings;
}
}  // namespace

std::vector<std::uint8_t> to_row(const PerceivedScan& perceived) {
  const LaserScan& scan = *perceived.scan;
  const LocalFix& fix = perceived.fix;
  cairn_journal::scan_record_t record{};
  record.utime = utime_of(scan.time);
  put(fix.T_lpm_robot, record.T_lpm_robot_m_rad);
  put(fix.covariance, record.covariance_m2_rad2);
  put(fix.motion.mean, record.T_previous_robot_m_rad);
  put(fix.motion.covariance, record.motion_covariance_m2_rad2);
  record.is_matched = fix.is_matched ? 1 : 0;
  record.is_degenerate = fix.is_degenerate ? 1 : 0;
  record.note = static_cast<int>(fix.note);
  record.score_share = fix.score;
  record.through_walls_share = fix.through_walls.value_or(std::numeric_limits<double>::quiet_NaN());
  record.is_trusted = perceived.is_trusted ? 1 : 0;
  put(scan.T_robot_laser, record.T_robot_laser_m_rad);
  record.max_range_m = scan.max_range_m;
  record.sweep_duration_s = scan.sweep_duration_s;
  record.bearings_rad = packed_bearings(scan.bearings_rad);
  record.num_bearings = static_cast<int>(record.bearings_rad.size());
  record.ranges_m = scan.ranges_m;
  record.num_ranges = static_cast<int>(record.ranges_m.size());
  record.has_odometry = perceived.T_odom_robot ? 1 : 0;
  put(perceived.T_odom_robot.value_or(Pose2()), record.T_odom_robot_m_rad);
  for (const OdometrySample& between : perceived.between) {
    record.between_utime.push_back(utime_of(between.time));
    const Pose2& pose = between.T_odom_robot;
    record.T_previous_between_m_rad.push_back({pose.x(), pose.y(), pose.theta()});
  }
  record.num_between = static_cast<int>(record.between_utime.size());
  return wire::to_document(record);
}

Result<PerceivedScan> scan_of_row(const std::vector<std::uint8_t>& row) {
  const auto record = wire::from_document<cairn_journal::scan_record_t>(row, kMaxRowBytes);
  if (!record) {
    return malformed(record.error());
  }
  auto scan = std::make_shared<LaserScan>();
  scan->time = time_of_utime(record->utime);
  scan->T_robot_laser = pose_of(record->T_robot_laser_m_rad);
  scan->max_range_m = record->max_range_m;
  scan->sweep_duration_s = record->sweep_duration_s;
  scan->ranges_m = record->ranges_m;
  scan->bearings_rad = unpacked_bearings(record->bearings_rad, record->ranges_m.size());
  if (const Status status = validate(*scan); !status) {
    return malformed(status.error().message);
  }
  LocalFix fix;
  fix.time = scan->time;
  fix.T_lpm_robot = pose_of(record->T_lpm_robot_m_rad);
  fix.covariance = matrix_of(record->covariance_m2_rad2);
  fix.motion = {pose_of(record->T_previous_robot_m_rad),
                matrix_of(record->motion_covariance_m2_rad2)};
  fix.is_matched = record->is_matched != 0;
  fix.is_degenerate = record->is_degenerate != 0;
  fix.score = record->score_share;
  if (!std::isnan(record->through_walls_share)) {
    fix.through_walls = record->through_walls_share;
  }
  if (record->note < 0 || record->note > static_cast<int>(FixNote::kContradiction) ||
      !std::isfinite(fix.T_lpm_robot.x() + fix.T_lpm_robot.y() + fix.T_lpm_robot.theta())) {
    return malformed("a pose or a note out of range");
  }
  fix.note = static_cast<FixNote>(record->note);
  PerceivedScan perceived{std::move(scan), fix, std::nullopt, {}, record->is_trusted != 0};
  if (record->has_odometry != 0) {
    perceived.T_odom_robot = pose_of(record->T_odom_robot_m_rad);
    if (const Status status = validate(OdometrySample{fix.time, *perceived.T_odom_robot});
        !status) {
      return malformed(status.error().message);
    }
  }
  for (std::size_t i = 0; i < record->between_utime.size(); ++i) {
    const std::vector<double>& pose = record->T_previous_between_m_rad[i];
    const OdometrySample between{time_of_utime(record->between_utime[i]),
                                 Pose2(pose[0], pose[1], pose[2])};
    if (const Status status = validate(between); !status) {
      return malformed(status.error().message);
    }
    perceived.between.push_back(between);
  }
  return perceived;
}
}  // namespace cairn
