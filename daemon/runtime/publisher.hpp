#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include <cairn_lcm/delta_request_t.hpp>
#include <cairn_lcm/event_request_t.hpp>
#include <cairn_lcm/plan_request_t.hpp>
#include <cairn_lcm/plan_t.hpp>
#include <cairn_lcm/snapshot_request_t.hpp>
#include <cairn_lcm/status_t.hpp>

#include "runtime/event_book.hpp"
#include "runtime/hypothesis_drawer.hpp"
#include "runtime/mapping_thread.hpp"
#include "runtime/solver_thread.hpp"
#include "wire/bus.hpp"
#include "wire/replication_server.hpp"
#include "wire/request.hpp"

namespace cairn {

/// The daemon's voice on the bus, and its ear for requests. Belongs to the event loop.
class Publisher {
 public:
  /// Where requests are taken that are not answered here.
  struct Orders {
    /// To the solver. @return false where too many wait already
    std::function<bool(const cairn_lcm::plan_request_t&)> plan;
    /// To the mapping thread.
    std::function<void(MapRequest)> mapping;
    /// The map of a hypothesis, to the mapping thread, which answers in MappingReport::hypothesis;
    /// one at a time.
    std::function<void(const cairn_lcm::snapshot_request_t&)> hypothesis;
  };

  /// @param bus must outlive this object
  Publisher(wire::Bus& bus,
            std::int64_t boot_id,
            const LocalisationOptions& localisation,
            Orders orders);

  /// Listens to requests and to the status of other daemons.
  /// @return false where LCM refuses
  [[nodiscard]] bool subscribe();

  /// What mapping made known; its state is published when it has been refined and drawn.
  void publish(const MappingReport& report);
  void publish(const Drawing& drawing, const GlobalMapOptions& options);
  void publish(const cairn_lcm::plan_t& plan);
  /// The map of a hypothesis, to who asked for it; another one may be asked for then.
  void publish(HypothesisDrawing drawing);
  /// Fills in what is known here, and sends it.
  void publish(cairn_lcm::status_t status);
  /// Sends what the pace allows.
  void pump();

  [[nodiscard]] bool has_work() const { return replication_.has_work(); }
  [[nodiscard]] const std::shared_ptr<const MapState>& state() const { return state_; }
  [[nodiscard]] Sender sender() const { return {boot_id_, map_id_}; }
  /// Whether another daemon was heard in the last seconds.
  [[nodiscard]] bool hears_another_daemon() const;
  /// Something that belongs into the log: a second daemon, a broken request. Empties itself.
  [[nodiscard]] std::string take_remark() { return std::exchange(remark_, {}); }
  [[nodiscard]] std::int64_t malformed_requests() const { return malformed_requests_; }

 private:
  template <class Request>
  bool listen(const std::string& channel, void (Publisher::*handle)(const Request&));
  void on_plan(const cairn_lcm::plan_request_t& request);
  template <class Request>
  void on_map_request(const Request& request);
  void publish(const MapAnswer& answer);
  void on_snapshot(const cairn_lcm::snapshot_request_t& request);
  void on_hypothesis_map(const cairn_lcm::snapshot_request_t& request);
  void note_laid_out(const AskedHypothesis& hypothesis);
  [[nodiscard]] bool is_behind() const;
  void answer_held();
  void on_delta(const cairn_lcm::delta_request_t& request);
  void on_events(const cairn_lcm::event_request_t& request);
  void on_status(const cairn_lcm::status_t& status);
  void answer(const cairn_lcm::rpc_header_t& request,
              std::int32_t code,
              const std::string& name,
              const std::string& reason);
  void publish_state(const std::shared_ptr<const MapState>& state);
  void publish_health(const MappingReport& report);
  void publish_relocalisation(const MappingReport& report);
  void publish_local_map(const wire::ReplicatedGrid& local_map);

  wire::Bus& bus_;
  std::int64_t boot_id_;
  std::int64_t map_id_ = 0;
  Orders orders_;
  wire::ReplicationServer replication_;
  wire::ResultCache results_;
  /// By client and request: since when.
  std::map<std::pair<std::int64_t, std::int32_t>, std::int64_t> under_way_us_;
  EventBook events_;
  LocalisationOptions localisation_;
  LocalisationHealth health_;
  std::shared_ptr<const MapState> state_;  ///< As it was drawn last.
  std::shared_ptr<const MapState> told_;   ///< As clients have it; nearly the same.
  std::int64_t newest_revision_ = -1;      ///< Of the map; what clients have may be behind it.
  std::deque<cairn_lcm::snapshot_request_t> held_;  ///< Until clients can have the newest.
  /// The map of a hypothesis that is being made.
  struct HypothesisUnderWay {
    std::int64_t hypothesis_id = -1;
    std::int64_t since_us = 0;
    bool is_drawing = false;  ///< Laid out; else it waits for the mapping thread.
  };
  std::optional<HypothesisUnderWay> hypothesis_under_way_;
  std::int64_t foreign_daemons_ = 0;
  std::int64_t foreign_boot_id_ = 0;
  std::int64_t foreign_heard_us_ = 0;
  std::int64_t malformed_requests_ = 0;
  std::string remark_;
};

/// Microseconds since the epoch, and by a clock that never steps.
[[nodiscard]] std::int64_t wall_utime();
[[nodiscard]] std::int64_t steady_us();

}  // namespace cairn
