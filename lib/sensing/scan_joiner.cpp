#include "sensing/scan_joiner.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include "base/check.hpp"
#include "base/validator.hpp"

namespace cairn {
namespace {

// Against floods of equal stamps, which history and patience in seconds do not bound.
constexpr std::size_t kMaxWaitingScans = 1'000;
constexpr std::size_t kMaxSamples = 20'000;

/// On the line between two poses, or beyond it.
Pose2 pose_between(const OdometrySample& a, const OdometrySample& b, TimePoint time) {
  const double span_s = seconds_between(a.time, b.time);
  if (span_s == 0.0) {
    return b.T_odom_robot;
  }
  const double share = seconds_between(a.time, time) / span_s;
  const Pose2& from = a.T_odom_robot;
  const Pose2& to = b.T_odom_robot;
  return {from.x() + share * (to.x() - from.x()), from.y() + share * (to.y() - from.y()),
          from.theta() + share * turn_between(from.theta(), to.theta())};
}

/// Bit by bit, since NaN is a reading, too.
bool have_same_ranges(const LaserScan& a, const LaserScan& b) {
  return a.ranges_m.size() == b.ranges_m.size() &&
         std::memcmp(a.ranges_m.data(), b.ranges_m.data(), a.ranges_m.size() * sizeof(float)) == 0;
}

}  // namespace

Status validate(const JoinerOptions& options) {
  return Validator("joiner")
      .within("history_s", options.history_s, 0.1, 600.0)
      .within("patience_s", options.patience_s, 0.0, 60.0)
      .within("clock_step_back_s", options.clock_step_back_s, 0.1, 3600.0)
      .within("clock_step_ahead_s", options.clock_step_ahead_s, 1.0, 1e9)
      .status();
}

ScanJoiner::ScanJoiner(const JoinerOptions& options) : options_(options) {
  CAIRN_CHECK(validate(options).ok());
}

void ScanJoiner::add(const OdometrySample& sample) {
  if (is_stray(newest_odometry_, sample.time, &odometry_suspects_)) {
    return;
  }
  if (is_clock_step(newest_odometry_, sample.time)) {
    count_clock_step(newest_scan_, sample.time);
    release_all();
    forget_odometry();
  }
  odometry_.push_back(sample);
  newest_odometry_ = std::max(newest_odometry_.value_or(sample.time), sample.time);
  while (odometry_.size() > kMaxSamples ||
         seconds_between(odometry_.front().time, *newest_odometry_) > options_.history_s) {
    odometry_.pop_front();
    ++first_arrival_;
  }
  release_ready();
}

void ScanJoiner::add(LaserScan scan) {
  if (is_duplicate(scan)) {
    ++counters_.duplicates;
    return;
  }
  if (is_stray(newest_scan_, scan.time, &scan_suspects_)) {
    return;
  }
  if (is_clock_step(newest_scan_, scan.time)) {
    count_clock_step(newest_odometry_, scan.time);
    release_all();
    if (newest_odometry_ && is_clock_step(newest_odometry_, scan.time)) {
      forget_odometry();
    }
    newest_scan_.reset();
  }
  const bool steps_back = newest_scan_ && scan.time <= *newest_scan_;
  counters_.out_of_order += steps_back ? 1 : 0;
  newest_scan_ = std::max(newest_scan_.value_or(scan.time), scan.time);
  last_scan_ = scan;
  waiting_.push_back({std::move(scan), steps_back, end_arrival()});
  release_ready();
}

std::optional<JoinedScan> ScanJoiner::next() {
  if (ready_.empty()) {
    return std::nullopt;
  }
  JoinedScan scan = std::move(ready_.front());
  ready_.pop_front();
  return scan;
}

void ScanJoiner::flush() {
  release_all();
}

void ScanJoiner::release_ready() {
  while (!waiting_.empty()) {
    const Waiting& front = waiting_.front();
    const TimePoint time = front.scan.time;
    const auto later = front.steps_back ? std::nullopt : find_later_sample(time);
    if (const auto own = take_own_sample(time)) {
      release_front(own);
    } else if (later) {
      cursor_ = *later;
      release_front(joined(time, *later));
    } else if (has_waited_long()) {
      release_front(extrapolated(time));
    } else {
      return;
    }
  }
}

void ScanJoiner::release_front(std::optional<Pose2> T_odom_robot) {
  if (!T_odom_robot) {
    ++counters_.scans_without_odometry;
  }
  ready_.push_back({std::move(waiting_.front().scan), T_odom_robot});
  waiting_.pop_front();
}

void ScanJoiner::release_all() {
  release_ready();
  while (!waiting_.empty()) {
    const TimePoint time = waiting_.front().scan.time;
    const auto own = take_own_sample(time);
    release_front(own ? own : extrapolated(time));
  }
}

void ScanJoiner::forget_odometry() {
  first_arrival_ = end_arrival();
  cursor_ = first_arrival_;
  odometry_.clear();
  newest_odometry_.reset();
}

bool ScanJoiner::is_duplicate(const LaserScan& scan) const {
  return last_scan_ && last_scan_->time == scan.time && have_same_ranges(*last_scan_, scan);
}

bool ScanJoiner::is_clock_step(std::optional<TimePoint> newest, TimePoint time) const {
  if (!newest) {
    return false;
  }
  const double ahead_s = seconds_between(*newest, time);
  return ahead_s < -options_.clock_step_back_s || ahead_s > options_.clock_step_ahead_s;
}

/// One message from another clock is a fault of that message; several that agree are a new clock.
bool ScanJoiner::is_stray(std::optional<TimePoint> newest, TimePoint time, Suspects* suspects) {
  constexpr int kAgreeing = 3;
  if (!is_clock_step(newest, time)) {
    suspects->count = 0;
    return false;
  }
  const bool agrees = suspects->count > 0 && !is_clock_step(suspects->last, time);
  *suspects = {time, agrees ? suspects->count + 1 : 1};
  if (suspects->count < kAgreeing) {
    ++counters_.strays;
    return true;
  }
  suspects->count = 0;
  return false;
}

void ScanJoiner::count_clock_step(std::optional<TimePoint> newest_of_other, TimePoint time) {
  // Both streams see the same step: it counts with the first of them.
  const bool is_known = newest_of_other && std::abs(seconds_between(*newest_of_other, time)) <=
                                               options_.clock_step_back_s;
  if (!is_known) {
    ++counters_.clock_steps;
  }
}

bool ScanJoiner::has_waited_long() const {
  if (waiting_.size() > kMaxWaitingScans) {
    return true;
  }
  const Waiting& front = waiting_.front();
  const auto is_long_after = [&](TimePoint time) {
    return seconds_between(front.scan.time, time) >= options_.patience_s;
  };
  for (std::uint64_t i = std::max(front.came_before, first_arrival_); i < end_arrival(); ++i) {
    if (is_long_after(sample(i).time)) {
      return true;
    }
  }
  return std::any_of(waiting_.begin() + 1, waiting_.end(),
                     [&](const Waiting& other) { return is_long_after(other.scan.time); });
}

std::optional<Pose2> ScanJoiner::take_own_sample(TimePoint time) {
  for (std::uint64_t i = std::max(cursor_, first_arrival_); i < end_arrival(); ++i) {
    if (sample(i).time == time) {
      cursor_ = i + 1;  // the next scan of the same stamp has a sample of its own
      return sample(i).T_odom_robot;
    }
  }
  return std::nullopt;
}

std::optional<std::uint64_t> ScanJoiner::find_later_sample(TimePoint time) const {
  for (std::uint64_t i = std::max(cursor_, first_arrival_); i < end_arrival(); ++i) {
    if (sample(i).time > time) {
      return i;
    }
  }
  return std::nullopt;
}

std::optional<Pose2> ScanJoiner::joined(TimePoint time, std::uint64_t last_arrival) {
  for (std::uint64_t i = last_arrival + 1; i-- > first_arrival_;) {
    if (sample(i).time == time) {
      return sample(i).T_odom_robot;
    }
  }
  for (std::uint64_t i = last_arrival; i > first_arrival_; --i) {
    const OdometrySample& before = sample(i - 1);
    const OdometrySample& after = sample(i);
    if (before.time < time && time < after.time) {
      if (seconds_between(before.time, after.time) > options_.patience_s) {
        ++counters_.gaps;
      }
      return pose_between(before, after, time);
    }
  }
  return std::nullopt;
}

std::optional<Pose2> ScanJoiner::extrapolated(TimePoint time) {
  if (odometry_.size() < 2) {
    return std::nullopt;
  }
  if (const auto known = joined(time, end_arrival() - 1)) {
    return known;  // stamped before a step back
  }
  const OdometrySample& before = odometry_[odometry_.size() - 2];
  const OdometrySample& last = odometry_.back();
  const double age_s = seconds_between(last.time, time);
  if (!(age_s >= 0.0 && age_s < options_.patience_s)) {
    return std::nullopt;
  }
  if (last.time <= before.time) {  // a step back gives no speed
    return last.T_odom_robot;
  }
  return pose_between(before, last, time);
}

const OdometrySample& ScanJoiner::sample(std::uint64_t arrival) const {
  return odometry_[static_cast<std::size_t>(arrival - first_arrival_)];
}

}  // namespace cairn
