#include "sensing/scan_joiner.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>
#include <utility>

#include "base/check.hpp"
#include "base/validator.hpp"

namespace cairn {
namespace {

// Against floods of equal stamps, which history and patience in seconds do not bound.
constexpr std::size_t kMaxWaitingScans = 1'000;
constexpr std::size_t kMaxSamples = 20'000;

constexpr double kLongestStep_m = 2.0;  // from sample to sample

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
    count_clock_step(sample.time);
    release_all();
    forget_odometry();
  }
  if (!odometry_.empty()) {
    const Pose2& before = odometry_.back().T_odom_robot;
    way_m_ +=
        std::min((sample.T_odom_robot.translation() - before.translation()).norm(), kLongestStep_m);
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
  Stream& stream = streams_[scan.laser];
  if (is_duplicate(scan, stream)) {
    ++counters_.duplicates;
    return;
  }
  if (is_stray(stream.newest, scan.time, &stream.suspects)) {
    return;
  }
  if (is_clock_step(stream.newest, scan.time)) {
    count_clock_step(scan.time);
    release_all();
    if (newest_odometry_ && is_clock_step(newest_odometry_, scan.time)) {
      forget_odometry();
    }
    stream.newest.reset();
  }
  const bool steps_back = stream.newest && scan.time <= *stream.newest;
  const bool repeats = steps_back && stream.last && scan.time == stream.last->time;
  counters_.repeated += repeats ? 1 : 0;
  counters_.out_of_order += steps_back && !repeats ? 1 : 0;
  stream.newest = std::max(stream.newest.value_or(scan.time), scan.time);
  stream.last = scan;
  queue({std::move(scan), steps_back, end_arrival()});
  release_ready();
}

void ScanJoiner::queue(Waiting scan) {
  const auto is_before = [&scan](const Waiting& other) {
    return other.scan.laser != scan.scan.laser && !other.steps_back && !scan.steps_back &&
           scan.scan.time < other.scan.time;
  };
  auto place = waiting_.end();
  while (place != waiting_.begin() && is_before(*std::prev(place))) {
    --place;
  }
  waiting_.insert(place, std::move(scan));
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
    if (const auto own = take_own_sample(front.scan)) {
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
  ready_.push_back({std::move(waiting_.front().scan), T_odom_robot, std::exchange(way_m_, 0.0)});
  waiting_.pop_front();
}

void ScanJoiner::release_all() {
  release_ready();
  while (!waiting_.empty()) {
    const LaserScan& scan = waiting_.front().scan;
    const auto own = take_own_sample(scan);
    release_front(own ? own : extrapolated(scan.time));
  }
}

void ScanJoiner::forget_odometry() {
  first_arrival_ = end_arrival();
  cursor_ = first_arrival_;
  odometry_.clear();
  newest_odometry_.reset();
  own_.reset();
}

bool ScanJoiner::is_duplicate(const LaserScan& scan, const Stream& stream) {
  return stream.last && stream.last->time == scan.time && have_same_ranges(*stream.last, scan);
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

void ScanJoiner::count_clock_step(TimePoint time) {
  // All streams see the same step: it counts with the first of them.
  const auto is_near = [&](std::optional<TimePoint> newest) {
    return newest && std::abs(seconds_between(*newest, time)) <= options_.clock_step_back_s;
  };
  const bool is_known = is_near(newest_odometry_) ||
                        std::any_of(streams_.begin(), streams_.end(), [&](const auto& stream) {
                          return is_near(stream.second.newest);
                        });
  counters_.clock_steps += is_known ? 0 : 1;
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

std::optional<Pose2> ScanJoiner::take_own_sample(const LaserScan& scan) {
  if (own_ && own_->time == scan.time && own_->laser != scan.laser) {
    return own_->T_odom_robot;
  }
  for (std::uint64_t i = std::max(cursor_, first_arrival_); i < end_arrival(); ++i) {
    if (sample(i).time == scan.time) {
      cursor_ = i + 1;  // the next scan of the same laser and stamp has a sample of its own
      own_ = OwnSample{scan.time, scan.laser, sample(i).T_odom_robot};
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
