#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include <cairn_lcm/status_t.hpp>

#include "runtime/daemon_options.hpp"
#include "runtime/latency.hpp"
#include "runtime/mapping_thread.hpp"
#include "transport/inlets.hpp"

namespace cairn {

/// What the daemon's status is made of: what came in, what was mapped of it, what is wrong. Belongs
/// to the event loop.
class StatusBoard {
 public:
  /// @param options must outlive this object
  explicit StatusBoard(const DaemonOptions& options) : options_(options) {}

  void took(const SensorReading& reading);
  /// Logs a change of the localisation's health.
  void took(const MappingReport& report);
  /// Logs it where it is new. @return whether it is
  bool note_journal(const std::string& trouble);
  void note_stopping() { is_stopping_ = true; }

  /// State, as in status_t, and reason.
  [[nodiscard]] std::pair<int, std::string> state(bool hears_another_daemon) const;
  /// All that is known here.
  /// @param dropped readings for which the queue had no room
  [[nodiscard]] cairn_lcm::status_t status(bool hears_another_daemon,
                                           const Inlets& inlets,
                                           std::int64_t dropped) const;

 private:
  void add_inlet_counters(const Inlets& inlets, cairn_lcm::status_t* status) const;

  const DaemonOptions& options_;
  std::int64_t last_scan_us_ = 0;
  std::int64_t last_odometry_us_ = 0;
  std::int64_t scans_received_ = 0;
  std::int64_t scans_mapped_ = 0;
  std::int64_t odometry_received_ = 0;
  bool is_stopping_ = false;
  std::string journal_trouble_;
  JoinerCounters joiner_;
  LocalisationHealth health_;
  std::int64_t local_map_restarts_ = 0;
  double distinctiveness_ = 0.0;
  std::optional<Relocalisation> relocalised_;
  Latency latency_;
};

}  // namespace cairn
