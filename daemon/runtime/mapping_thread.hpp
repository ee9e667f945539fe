#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <variant>
#include <vector>

#include <cairn_lcm/assert_request_t.hpp>
#include <cairn_lcm/assertion_report_t.hpp>
#include <cairn_lcm/explain_request_t.hpp>
#include <cairn_lcm/explanation_t.hpp>
#include <cairn_lcm/name_request_t.hpp>
#include <cairn_lcm/perception_request_t.hpp>
#include <cairn_lcm/perception_t.hpp>
#include <cairn_lcm/result_t.hpp>
#include <cairn_lcm/snapshot_request_t.hpp>

#include "runtime/bounded_queue.hpp"
#include "runtime/engine.hpp"
#include "runtime/wakeup.hpp"

namespace cairn {

/// Where the robot was at one scan.
struct MappedFix {
  LocalFix fix;
  GaussianPose T_global_robot;
};

/// What clients ask of whoever owns the map, and what they are answered.
using MapRequest = std::variant<cairn_lcm::name_request_t,
                                cairn_lcm::assert_request_t,
                                cairn_lcm::explain_request_t,
                                cairn_lcm::perception_request_t>;
using MapAnswer = std::variant<cairn_lcm::result_t,
                               cairn_lcm::assertion_report_t,
                               cairn_lcm::explanation_t,
                               cairn_lcm::perception_t>;

/// The map of a hypothesis, laid out on request and not drawn yet.
struct AskedHypothesis {
  cairn_lcm::snapshot_request_t request;
  Result<std::shared_ptr<const MapState>> state;
};

/// What the mapping thread makes known to the event loop; journalled before it is handed out.
struct MappingReport {
  std::vector<MappedFix> fixes;
  std::vector<PlaceEvent> events;
  std::vector<ExtendReport> extensions;
  std::shared_ptr<const MapState> state;                  ///< Null where none was made.
  std::shared_ptr<const wire::ReplicatedGrid> local_map;  ///< Comes with a state.
  std::int64_t map_id = 0;
  JoinerCounters joiner;
  LocalisationHealth health;
  std::int64_t local_map_restarts = 0;
  double distinctiveness = 0.0;  ///< Of where the robot is.
  std::optional<Relocalisation> relocalised;
  std::optional<MapAnswer> answer;
  std::optional<AskedHypothesis> hypothesis;
  double update_ms = 0.0;  ///< To take the reading in.
  std::string journal_trouble;
};

/// The thread that owns the engine: takes readings in their order, journals, reports.
class MappingThread {
 public:
  struct Options {
    std::size_t queued_readings = 2000;
    double commit_every_s = 1.0;
    double state_every_s = 1.0;  ///< Besides one for every change of the map.
    int tile_cells = 64;         ///< Of the local map's tiles.
    double pause_after_s = 5.0;  ///< Without readings for so long, the input has paused.
  };

  /// @param wakeup is signalled for every report; must outlive this object
  MappingThread(std::unique_ptr<Engine> engine, const Options& options, const Wakeup& wakeup);
  /// Stops as `stop` does.
  ~MappingThread();
  MappingThread(const MappingThread&) = delete;
  MappingThread& operator=(const MappingThread&) = delete;
  MappingThread(MappingThread&&) = delete;
  MappingThread& operator=(MappingThread&&) = delete;

  void take(SensorReading reading) { orders_.push(std::move(reading)); }
  void ask(MapRequest request) { orders_.push(std::move(request)); }
  /// For the map of a hypothesis.
  void ask(cairn_lcm::snapshot_request_t request) { orders_.push(std::move(request)); }
  void store(Documents documents) { orders_.push(std::move(documents)); }
  [[nodiscard]] std::optional<MappingReport> next_report() { return reports_.try_pop(); }

  /// Readings that were dropped because mapping did not keep up.
  [[nodiscard]] std::int64_t dropped() const { return orders_.dropped(); }
  [[nodiscard]] std::size_t waiting() const { return orders_.size(); }
  /// Counts up with every order that was carried out.
  [[nodiscard]] std::int64_t progress() const { return progress_; }

  /// Carries out what waits, then ends the thread and hands the engine back.
  std::unique_ptr<Engine> stop();

 private:
  using Order = std::variant<SensorReading, Documents, MapRequest, cairn_lcm::snapshot_request_t>;
  void run();
  void carry_out(SensorReading reading);
  void carry_out(const MapRequest& request);
  void carry_out(cairn_lcm::snapshot_request_t request);
  void carry_out(const Documents& documents) { engine_->store(documents); }
  MapAnswer answered(const cairn_lcm::name_request_t& request);
  MapAnswer answered(const cairn_lcm::assert_request_t& request);
  MapAnswer answered(const cairn_lcm::explain_request_t& request);
  MapAnswer answered(const cairn_lcm::perception_request_t& request);
  void finish_pause();
  void commit_when_due();
  void report(const Updates& updates, double update_ms);
  /// A report of what the engine knows of itself.
  [[nodiscard]] MappingReport own_report() const;

  std::unique_ptr<Engine> engine_;
  Options options_;
  const Wakeup& wakeup_;
  BoundedQueue<Order> orders_;
  BoundedQueue<MappingReport> reports_;
  std::atomic<std::int64_t> progress_{0};
  std::chrono::steady_clock::time_point last_commit_;
  std::chrono::steady_clock::time_point last_state_;
  std::chrono::steady_clock::time_point last_reading_;
  bool has_paused_ = true;  ///< Nothing has come since the last pause was seen to.
  std::thread thread_;
};

}  // namespace cairn
