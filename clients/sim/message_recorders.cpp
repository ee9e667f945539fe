#include <algorithm>
#include <thread>
#include <utility>

#include "cairn_lcm/laser_scan_t.hpp"
#include "cairn_lcm/odometry_t.hpp"
#include "clients/sim/recorders.hpp"

namespace cairn::sim {
namespace {

using std::chrono::steady_clock;

/// One message may be lost to a full buffer; a row of them means that nobody will get any.
constexpr int kFailuresUntilLost = 50;
constexpr std::chrono::milliseconds kLongestNap{50};

cairn_lcm::odometry_t message_of(std::int64_t utime, const Pose& T_odom_robot) {
  cairn_lcm::odometry_t message{};
  message.utime = utime;
  message.x_m = T_odom_robot.at.x_m;
  message.y_m = T_odom_robot.at.y_m;
  message.theta_rad = T_odom_robot.theta_rad;
  return message;
}

cairn_lcm::laser_scan_t message_of(std::int64_t utime, const Sweep& sweep) {
  cairn_lcm::laser_scan_t message{};
  message.utime = utime;
  message.first_bearing_rad = sweep.first_bearing_rad;
  message.bearing_step_rad = sweep.bearing_step_rad;
  message.max_range_m = sweep.max_range_m;
  message.num_ranges = static_cast<std::int32_t>(sweep.ranges_m.size());
  message.ranges_m = sweep.ranges_m;
  return message;
}

wire::LogWriter opened_log(const std::string& file) {
  auto writer = wire::LogWriter::open(file);
  if (!writer) {
    throw CannotWrite(writer.error());
  }
  return *std::move(writer);
}

std::unique_ptr<wire::Bus> opened_bus(const std::string& lcm_url) {
  auto bus = wire::Bus::open(lcm_url);
  if (!bus) {
    throw NoBus(bus.error());
  }
  return *std::move(bus);
}

}  // namespace

LogRecorder::LogRecorder(const std::string& file, MessageOptions options)
    : file_(file), writer_(opened_log(file)), options_(std::move(options)) {}

void LogRecorder::record_odometry(std::int64_t time_us, const Pose& T_odom_robot) {
  const std::int64_t utime = options_.start_utime + time_us;
  if (!writer_.write(utime, options_.odometry_channel, message_of(utime, T_odom_robot))) {
    throw CannotWrite(file_ + ": cannot be written");
  }
}

void LogRecorder::record_sweep(std::int64_t time_us, const Sweep& sweep) {
  const std::int64_t utime = options_.start_utime + time_us;
  if (!writer_.write(utime, options_.laser_channel, message_of(utime, sweep))) {
    throw CannotWrite(file_ + ": cannot be written");
  }
}

void LogRecorder::close() {
  if (!writer_.close()) {
    throw CannotWrite(file_ + ": cannot be written");
  }
}

LiveRecorder::LiveRecorder(const std::string& lcm_url,
                           MessageOptions options,
                           double speed,
                           const std::atomic<bool>& stop)
    : bus_(opened_bus(lcm_url)),
      options_(std::move(options)),
      speed_(speed),
      stop_(stop),
      start_(steady_clock::now()) {}

void LiveRecorder::wait_until(std::int64_t time_us) const {
  const std::chrono::duration<double, std::micro> since_start(static_cast<double>(time_us) /
                                                              speed_);
  const auto due = start_ + std::chrono::duration_cast<steady_clock::duration>(since_start);
  while (!stop_) {
    const auto now = steady_clock::now();
    if (now >= due) {
      return;
    }
    // Naps, so that a signal is noticed soon.
    std::this_thread::sleep_until(std::min(due, now + kLongestNap));
  }
}

void LiveRecorder::note_sent(bool was_sent) {
  failures_in_a_row_ = was_sent ? 0 : failures_in_a_row_ + 1;
  if (failures_in_a_row_ >= kFailuresUntilLost) {
    throw NoBus("cannot publish on " + bus_->url() + " any more");
  }
}

void LiveRecorder::record_odometry(std::int64_t time_us, const Pose& T_odom_robot) {
  wait_until(time_us);
  const std::int64_t utime = options_.start_utime + time_us;
  note_sent(bus_->publish(options_.odometry_channel, message_of(utime, T_odom_robot)));
}

void LiveRecorder::record_sweep(std::int64_t time_us, const Sweep& sweep) {
  wait_until(time_us);
  const std::int64_t utime = options_.start_utime + time_us;
  note_sent(bus_->publish(options_.laser_channel, message_of(utime, sweep)));
}

}  // namespace cairn::sim
