#include "service/between_scans.hpp"

namespace cairn {

void BetweenScans::add(const OdometrySample& sample) {
  samples_.push_back(sample);
  if (samples_.size() > kMost) {
    samples_.pop_front();
  }
}

std::vector<OdometrySample> BetweenScans::take(TimePoint scan_time,
                                               const std::optional<Pose2>& T_odom_robot) {
  std::vector<OdometrySample> between;
  if (!T_odom_robot) {
    samples_.clear();
    T_odom_previous_.reset();
    return between;
  }
  const std::size_t count = count_before(scan_time, *T_odom_robot);
  if (T_odom_previous_) {
    const Pose2 T_previous_odom = T_odom_previous_->inverse();
    for (std::size_t i = 0; i < count; ++i) {
      if (samples_[i].time != scan_time) {
        between.push_back({samples_[i].time, T_previous_odom * samples_[i].T_odom_robot});
      }
    }
    between.push_back({scan_time, T_previous_odom * *T_odom_robot});
  }
  samples_.erase(samples_.begin(), samples_.begin() + static_cast<std::ptrdiff_t>(count));
  T_odom_previous_ = T_odom_robot;
  return between;
}

/// Stamps of recorded logs may step back: the scan's own sample tells best how far they go.
std::size_t BetweenScans::count_before(TimePoint scan_time, const Pose2& T_odom_robot) const {
  for (std::size_t i = samples_.size(); i > 0; --i) {
    if (samples_[i - 1].time == scan_time && samples_[i - 1].T_odom_robot == T_odom_robot) {
      return i;
    }
  }
  std::size_t count = 0;
  while (count < samples_.size() && samples_[count].time <= scan_time) {
    ++count;
  }
  return count;
}

}  // namespace cairn
