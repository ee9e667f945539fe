#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "geometry/pose2.hpp"
#include "sensing/time.hpp"

namespace cairn {

/// By how much scans are stamped later than odometry: some drivers stamp a scan when it has come in
/// over a slow line, a sweep or more after it was taken. Whenever the robot turns, odometry of the
/// stamp then contradicts the scan.
///
/// Turns by scan matching are compared with those of odometry some time before, for several such
/// times. Where one of them explains clearly more than none does, it is the lag, and odometry of
/// that earlier time is the scan's. Where odometry and scans go together the lag stays 0, and
/// nothing is changed.
///
/// Memory is constant, nothing is allocated.
class ScanLag {
 public:
  /// The odometry of the next scan. Where stamps step back, or do not grow, the past is forgotten.
  void add(TimePoint time, const Pose2& T_odom_robot);
  /// The past is forgotten, the lag is not.
  void interrupt() { size_ = 0; }

  /// The motion from the last scan but one to the last, by odometry, with the lag taken off; none
  /// before so many scans have come.
  [[nodiscard]] std::optional<Pose2> step() const;
  /// The robot turned so between these two scans, by scan matching.
  void learn(double turn_rad);

  /// >= 0
  [[nodiscard]] double lag_s() const { return kSpacing_s * static_cast<double>(lag_); }

 private:
  static constexpr double kSpacing_s = 0.02;
  static constexpr std::size_t kLags = 16;  // 0 to 0.3 s
  static constexpr std::size_t kHistory = 32;

  struct Sample {
    TimePoint time;
    Pose2 T_odom_robot;
  };

  /// @param back 0 for the last one
  [[nodiscard]] const Sample& sample(std::size_t back) const {
    return samples_[(last_ + kHistory - back) % kHistory];
  }
  [[nodiscard]] bool has_past() const;
  [[nodiscard]] Pose2 odometry_before(double lag_s, std::size_t back) const;

  std::array<Sample, kHistory> samples_{};  // a ring
  std::size_t last_ = 0;
  std::size_t size_ = 0;
  std::array<double, kLags> unexplained_rad2_{};  // by lag: squares of turns, fading
  std::size_t lag_ = 0;
};

}  // namespace cairn
