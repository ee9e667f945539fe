#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "clients/sim/simulation.hpp"
#include "wire/bus.hpp"
#include "wire/log_writer.hpp"

namespace cairn::sim {

/// A file cannot be written.
class CannotWrite : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The bus cannot be used.
class NoBus : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What every recorder of messages must know.
struct MessageOptions {
  std::string laser_channel;
  std::string odometry_channel;
  std::int64_t start_utime = 0;  ///< Microseconds since the epoch at the start of the simulation.
};

/// Writes messages into an LCM event log.
class LogRecorder final : public Recorder {
 public:
  /// @throws CannotWrite
  LogRecorder(const std::string& file, MessageOptions options);

  void record_odometry(std::int64_t time_us, const Pose& T_odom_robot) override;
  void record_sweep(std::int64_t time_us, const Sweep& sweep) override;
  void record_passage(const Passage& /*passage*/) override {}

  /// @throws CannotWrite where anything was not written
  void close();

 private:
  std::string file_;
  wire::LogWriter writer_;
  MessageOptions options_;
};

/// Publishes messages, each when its time has come.
class LiveRecorder final : public Recorder {
 public:
  /// @param speed simulated seconds per second
  /// @throws NoBus
  LiveRecorder(const std::string& lcm_url,
               MessageOptions options,
               double speed,
               const std::atomic<bool>& stop);

  void record_odometry(std::int64_t time_us, const Pose& T_odom_robot) override;
  void record_sweep(std::int64_t time_us, const Sweep& sweep) override;
  void record_passage(const Passage& /*passage*/) override {}

 private:
  void wait_until(std::int64_t time_us) const;
  void note_sent(bool was_sent);

  std::unique_ptr<wire::Bus> bus_;
  MessageOptions options_;
  double speed_;
  const std::atomic<bool>& stop_;
  std::chrono::steady_clock::time_point start_;
  int failures_in_a_row_ = 0;
};

/// Writes the true poses at the sweeps (`t x y theta`) and the passages of named points
/// (`t name x y`) as text; t in seconds since the epoch, metres, radians, world frame.
class TruthRecorder final : public Recorder {
 public:
  /// @throws CannotWrite
  TruthRecorder(const std::string& prefix, std::int64_t start_utime);

  void record_odometry(std::int64_t /*time_us*/, const Pose& /*T_odom_robot*/) override {}
  void record_sweep(std::int64_t time_us, const Sweep& sweep) override;
  void record_passage(const Passage& passage) override;

  /// @throws CannotWrite where anything was not written
  void close();

 private:
  struct Closer {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  using File = std::unique_ptr<std::FILE, Closer>;
  static File open(const std::string& file);

  std::string prefix_;
  std::int64_t start_utime_;
  File poses_;
  File passages_;
};

/// Keeps a line on a terminal up to date.
class ProgressRecorder final : public Recorder {
 public:
  explicit ProgressRecorder(std::int64_t duration_us) : duration_us_(duration_us) {}

  void record_odometry(std::int64_t time_us, const Pose& T_odom_robot) override;
  void record_sweep(std::int64_t /*time_us*/, const Sweep& /*sweep*/) override {}
  void record_passage(const Passage& /*passage*/) override {}

  /// Removes the line.
  void close() const;

 private:
  std::int64_t duration_us_;
  std::chrono::steady_clock::time_point next_{};
};

/// Hands everything to all of them, in their order.
class RecorderGroup final : public Recorder {
 public:
  void add(Recorder& recorder) { recorders_.push_back(&recorder); }

  void record_odometry(std::int64_t time_us, const Pose& T_odom_robot) override;
  void record_sweep(std::int64_t time_us, const Sweep& sweep) override;
  void record_passage(const Passage& passage) override;

 private:
  std::vector<Recorder*> recorders_;
};

}  // namespace cairn::sim
