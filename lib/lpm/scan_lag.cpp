#include "lpm/scan_lag.hpp"

#include <algorithm>
#include <cmath>

namespace cairn {
namespace {

constexpr double kKeep = 0.995;           // of what was seen, from scan to scan
constexpr double kMostError_rad = 0.1;    // a single slip proves no lag
constexpr double kLeastGain_rad2 = 0.03;  // less may be chance
constexpr double kClearly = 0.5;          // of what no lag leaves unexplained
constexpr double kBetter = 0.8;           // another lag must be so much better than the one held

}  // namespace

void ScanLag::add(TimePoint time, const Pose2& T_odom_robot) {
  if (size_ > 0 && time <= sample(0).time) {
    interrupt();
  }
  last_ = (last_ + 1) % kHistory;
  samples_[last_] = {time, T_odom_robot};
  size_ = std::min(size_ + 1, kHistory);
}

/// Whether the longest lag can be looked up for both of the last two scans.
bool ScanLag::has_past() const {
  return size_ > 2 && seconds_between(sample(size_ - 1).time, sample(1).time) >=
                          kSpacing_s * static_cast<double>(kLags - 1);
}

Pose2 ScanLag::odometry_before(double lag_s, std::size_t back) const {
  const TimePoint of_scan = sample(back).time;
  std::size_t earlier = back;
  while (earlier + 1 < size_ && seconds_between(sample(earlier).time, of_scan) < lag_s) {
    ++earlier;
  }
  const Sample& from = sample(earlier);
  if (earlier == back) {
    return from.T_odom_robot;
  }
  const Sample& to = sample(earlier - 1);
  const double span_s = seconds_between(from.time, to.time);
  const double since_s = seconds_between(from.time, of_scan) - lag_s;
  const double share = std::clamp(since_s / span_s, 0.0, 1.0);
  const Vector2d way = to.T_odom_robot.translation() - from.T_odom_robot.translation();
  const double turn_rad = turn_between(from.T_odom_robot.theta(), to.T_odom_robot.theta());
  return {from.T_odom_robot.translation() + share * way,
          from.T_odom_robot.theta() + share * turn_rad};
}

std::optional<Pose2> ScanLag::step() const {
  if (size_ < 2) {
    return std::nullopt;
  }
  return odometry_before(lag_s(), 1).inverse() * odometry_before(lag_s(), 0);
}

void ScanLag::learn(double turn_rad) {
  if (!has_past()) {
    return;
  }
  for (std::size_t i = 0; i < kLags; ++i) {
    const double lag_s = kSpacing_s * static_cast<double>(i);
    const double odometry_rad =
        turn_between(odometry_before(lag_s, 1).theta(), odometry_before(lag_s, 0).theta());
    const double error_rad =
        std::min(std::abs(turn_between(odometry_rad, turn_rad)), kMostError_rad);
    unexplained_rad2_[i] = kKeep * unexplained_rad2_[i] + error_rad * error_rad;
  }
  const auto best = static_cast<std::size_t>(
      std::min_element(unexplained_rad2_.begin(), unexplained_rad2_.end()) -
      unexplained_rad2_.begin());
  const double none = unexplained_rad2_.front();
  const double least = unexplained_rad2_[best];
  if (least > kClearly * none || none - least < kLeastGain_rad2) {
    lag_ = unexplained_rad2_[lag_] < none ? lag_ : 0;
  } else if (least < kBetter * unexplained_rad2_[lag_]) {
    lag_ = best;
  }
}

}  // namespace cairn
