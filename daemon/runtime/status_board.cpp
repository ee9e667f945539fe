#include "runtime/status_board.hpp"

#include <algorithm>
#include <array>
#include <fstream>

#include <spdlog/spdlog.h>
#include <unistd.h>

#include "runtime/health_status.hpp"
#include "runtime/publisher.hpp"
#include "runtime/version.hpp"
#include "wire/udp_drops.hpp"

namespace cairn {
namespace {

constexpr int kProtocolVersion = 1;
constexpr std::int64_t kSensorOld_us = 1'000'000;

float resident_mb() {
  long pages = 0;
  long resident = 0;
  std::ifstream("/proc/self/statm") >> pages >> resident;
  return static_cast<float>(resident) * static_cast<float>(sysconf(_SC_PAGESIZE)) / 1048576.0F;
}

std::int32_t age_ms(std::int64_t since_us) {
  return since_us == 0 ? -1 : static_cast<std::int32_t>((steady_us() - since_us) / 1000);
}

}  // namespace

void StatusBoard::took(const SensorReading& reading) {
  const bool is_scan = std::holds_alternative<LaserScan>(reading);
  (is_scan ? last_scan_us_ : last_odometry_us_) = steady_us();
  ++(is_scan ? scans_received_ : odometry_received_);
}

void StatusBoard::took(const MappingReport& report) {
  scans_mapped_ += static_cast<std::int64_t>(report.fixes.size());
  if (!report.fixes.empty()) {
    latency_.add(report.update_ms);
  }
  joiner_ = report.joiner;
  log_health(health_, report.health, options_.service.localisation);
  health_ = report.health;
  local_map_restarts_ = report.local_map_restarts;
  distinctiveness_ = report.distinctiveness;
  if (report.relocalised) {
    relocalised_ = report.relocalised;
    spdlog::info("{}", to_text(*relocalised_));
  }
}

bool StatusBoard::note_journal(const std::string& trouble) {
  if (trouble == journal_trouble_) {
    return false;
  }
  if (trouble.empty()) {
    spdlog::info("the map file can be written again");
  } else {
    spdlog::error("the map file cannot be written: {}", trouble);
  }
  journal_trouble_ = trouble;
  return true;
}

std::pair<int, std::string> StatusBoard::state(bool hears_another_daemon) const {
  using State = cairn_lcm::status_t;
  const std::int64_t now = steady_us();
  if (is_stopping_) {
    return {State::STOPPING, "asked to stop"};
  }
  if (scans_received_ == 0) {
    return {State::WAITING_FOR_SENSORS, "no scan has come yet"};
  }
  if (!journal_trouble_.empty()) {
    return {State::DEGRADED, "the map file cannot be written: " + journal_trouble_};
  }
  if (hears_another_daemon) {
    return {State::DEGRADED, "another cairnd is on this bus"};
  }
  if (now - last_scan_us_ > kSensorOld_us) {
    return {State::DEGRADED, "no scan for more than a second"};
  }
  if (health_.state == LocalisationState::kLost || health_.state == LocalisationState::kDegraded) {
    return {State::DEGRADED, "localisation " + health_text(health_, options_.service.localisation)};
  }
  return {State::MAPPING, ""};
}

cairn_lcm::status_t StatusBoard::status(bool hears_another_daemon,
                                        const Inlets& inlets,
                                        std::int64_t dropped) const {
  constexpr std::array<const char*, 5> kNames = {"STARTING", "WAITING_FOR_SENSORS", "MAPPING",
                                                 "DEGRADED", "STOPPING"};
  cairn_lcm::status_t status{};
  const auto [number, reason] = state(hears_another_daemon);
  status.protocol_version = kProtocolVersion;
  status.version = kVersion;
  status.state = number;
  status.state_name = kNames[static_cast<std::size_t>(number)];
  status.reason = reason;
  status.scans_received = scans_received_;
  status.scans_mapped = scans_mapped_;
  status.scans_dropped = dropped;
  status.scans_out_of_order = static_cast<std::int64_t>(joiner_.out_of_order + joiner_.repeated);
  status.clock_steps = static_cast<std::int64_t>(joiner_.clock_steps);
  status.scans_refused = static_cast<std::int64_t>(joiner_.duplicates + joiner_.strays);
  status.odometry_received = odometry_received_;
  add_inlet_counters(inlets, &status);
  add_health(health_, options_.service.localisation, &status);
  status.local_map_restarts = local_map_restarts_;
  status.distinctiveness_share = distinctiveness_;
  status.relocalisations = relocalised_ ? relocalised_->number : 0;
  status.relocalised = relocalised_ ? to_text(*relocalised_) : "";
  status.udp_drops = wire::own_udp_drops().value_or(-1);
  status.scan_age_ms = age_ms(last_scan_us_);
  status.odometry_age_ms = age_ms(last_odometry_us_);
  status.update_ms_p50 = latency_.median_ms();
  status.update_ms_max = latency_.max_ms();
  status.rss_mb = resident_mb();
  return status;
}

void StatusBoard::add_inlet_counters(const Inlets& inlets, cairn_lcm::status_t* status) const {
  for (const auto& [channel, counters] : inlets.counters()) {
    const bool is_odometry =
        std::find(options_.odometry_channels.begin(), options_.odometry_channels.end(), channel) !=
        options_.odometry_channels.end();
    (is_odometry ? status->odometry_refused : status->scans_refused) +=
        counters.refused + counters.in_future;
    status->laser_changes += counters.laser_changes;
    status->decode_errors += counters.malformed;
    status->unknown_types += counters.unknown_type;
  }
}

}  // namespace cairn
