#include "runtime/publisher.hpp"

#include <chrono>
#include <utility>

#include "runtime/planner.hpp"
#include "transport/frame_change.hpp"
#include "wire/document.hpp"
#include "wire/signatures.hpp"

namespace cairn {
namespace {

using What = cairn_lcm::snapshot_request_t;

constexpr std::size_t kMaxTopologyBytes = 60'000;  ///< Larger messages may not arrive in one piece.

struct Addressed {
  const char* channel;
  cairn_lcm::result_t* result;
};
Addressed addressed(cairn_lcm::result_t& answer) {
  return {"CAIRN_RESULT", &answer};
}
Addressed addressed(cairn_lcm::assertion_report_t& answer) {
  return {"CAIRN_ASSERTION", &answer.result};
}
Addressed addressed(cairn_lcm::explanation_t& answer) {
  return {"CAIRN_EXPLANATION", &answer.result};
}
Addressed addressed(cairn_lcm::perception_t& answer) {
  return {"CAIRN_PERCEPTION", &answer.result};
}

}  // namespace

std::int64_t wall_utime() {
  return std::chrono::duration_cast<std::chrono::microseconds>(
             std::chrono::system_clock::now().time_since_epoch())
      .count();
}

std::int64_t steady_us() {
  return std::chrono::duration_cast<std::chrono::microseconds>(
             std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

Publisher::Publisher(wire::Bus& bus,
                     std::int64_t boot_id,
                     const LocalisationOptions& localisation,
                     Orders orders)
    : bus_(bus),
      boot_id_(boot_id),
      orders_(std::move(orders)),
      replication_(
          boot_id,
          [this](const cairn_lcm::snapshot_chunk_t& chunk) {
            bus_.publish("CAIRN_SNAPSHOT", chunk);
          },
          [this](const cairn_lcm::map_delta_t& delta) {
            bus_.publish(delta.what == What::LPM ? "CAIRN_LPM" : "CAIRN_MAP_DELTA", delta);
          }),
      events_(boot_id),
      localisation_(localisation) {
  const auto serve = [this](std::int32_t what, auto to_message) {
    replication_.serve(what, [this, to_message]() -> std::optional<wire::Document> {
      if (state_ == nullptr) {
        return std::nullopt;
      }
      return wire::Document{map_id_, state_->topology_revision,
                            wire::to_document(to_message(*state_, sender()))};
    });
  };
  serve(What::TOPOLOGY, to_topology);
  serve(What::HYPOTHESES, to_hypotheses);
  serve(What::TRAJECTORY, to_trajectory);
  serve(What::ASSERTIONS, to_assertions);
  serve(What::VISITS, to_visit_places);
}

void Publisher::publish(const MappingReport& report) {
  map_id_ = report.map_id;
  for (const MappedFix& fix : report.fixes) {
    const bool is_known = state_ != nullptr && state_->hypothesis >= 0;
    // In the map that clients have: a newer one is still being refined.
    const GaussianPose T_global_robot{
        is_known ? state_->T_global_lpm * fix.fix.T_lpm_robot : Pose2(),
        fix.T_global_robot.covariance};
    bus_.publish("CAIRN_POSE",
                 to_pose(fix.fix, is_known ? &T_global_robot : nullptr, state_.get(), sender()));
  }
  if (report.state != nullptr) {
    newest_revision_ = report.state->topology_revision;
  }
  if (report.answer) {
    publish(*report.answer);
  }
  if (report.hypothesis) {
    note_laid_out(*report.hypothesis);
  }
  publish_health(report);
  publish_relocalisation(report);
  for (const PlaceEvent& event : report.events) {
    for (const cairn_lcm::place_event_t& message : events_.note(event, state_.get())) {
      bus_.publish("CAIRN_PLACE_EVENT", message);
    }
  }
  if (report.local_map != nullptr) {
    publish_local_map(*report.local_map);
  }
}

void Publisher::publish_health(const MappingReport& report) {
  const LocalisationHealth before = std::exchange(health_, report.health);
  const TimePoint time =
      report.fixes.empty() ? time_of_utime(wall_utime()) : report.fixes.back().fix.time;
  for (const cairn_lcm::place_event_t& message :
       events_.note(before, health_, {time, reason_of(health_, localisation_)})) {
    bus_.publish("CAIRN_PLACE_EVENT", message);
  }
}

void Publisher::publish_relocalisation(const MappingReport& report) {
  if (report.relocalised) {
    for (const cairn_lcm::place_event_t& message : events_.note(*report.relocalised)) {
      bus_.publish("CAIRN_PLACE_EVENT", message);
    }
  }
}

void Publisher::publish(const MapAnswer& answer) {
  std::visit(
      [this](auto message) {
        const auto [channel, result] = addressed(message);
        cairn_lcm::rpc_header_t& header = result->header;
        header.utime = wall_utime();
        header.boot_id = boot_id_;
        under_way_us_.erase({header.client_id, header.request_id});
        const wire::Bytes bytes = wire::encode(message);
        results_.store(header.client_id, header.request_id, {channel, bytes});
        bus_.publish(channel, bytes);
      },
      answer);
}

void Publisher::publish_state(const std::shared_ptr<const MapState>& state) {
  state_ = state;
  const std::shared_ptr<const MapState> before = told_;
  std::optional<cairn_lcm::frame_change_t> change;
  if (before != nullptr) {
    change = to_frame_change(*before, *state, sender());
    if (!change && before->topology_revision == state->topology_revision) {
      return;
    }
  }
  told_ = state;
  if (change) {
    bus_.publish("CAIRN_FRAME_CHANGE", *change);
  }
  replication_.documents_changed();
  if (before != nullptr) {
    for (const cairn_lcm::place_event_t& event : events_.note(*before, *state)) {
      bus_.publish("CAIRN_PLACE_EVENT", event);
    }
  }
  const wire::Bytes topology = wire::encode(to_topology(*state, sender()));
  if (topology.size() <= kMaxTopologyBytes) {
    bus_.publish("CAIRN_TOPOLOGY", topology);
  }
  bus_.publish("CAIRN_HYPOTHESES", to_hypotheses(*state, sender()));
}

void Publisher::publish_local_map(const wire::ReplicatedGrid& local_map) {
  const wire::ReplicatedGrid* const held = replication_.grid(What::LPM);
  wire::GridChange change{map_id_, local_map.cell_m, local_map.tile_cells, {}};
  for (const auto& [index, cells] : local_map.tiles) {
    const auto same = held == nullptr ? decltype(held->tiles.end()){} : held->tiles.find(index);
    if (held == nullptr || same == held->tiles.end() || *same->second != *cells) {
      change.tiles[index] = cells;
    }
  }
  if (held != nullptr) {
    // What the window has scrolled away from is not known any more.
    const auto size = static_cast<std::size_t>(local_map.tile_cells) *
                      static_cast<std::size_t>(local_map.tile_cells);
    const auto unknown = std::make_shared<const wire::Bytes>(size, GlobalMap::kUnknownPercent);
    for (const auto& [index, cells] : held->tiles) {
      if (local_map.tiles.count(index) == 0 && *cells != *unknown) {
        change.tiles[index] = unknown;
      }
    }
  }
  if (!change.tiles.empty()) {
    replication_.change(steady_us(), wall_utime(), What::LPM, change);
  }
}

void Publisher::publish(const Drawing& drawing, const GlobalMapOptions& options) {
  publish_state(drawing.state);
  answer_held();
  if (!drawing.changed.empty()) {
    replication_.change(steady_us(), wall_utime(), What::GLOBAL_MAP,
                        {map_id_, options.cell_m, options.tile_cells, drawing.changed});
  }
}

void Publisher::publish(const cairn_lcm::plan_t& plan) {
  under_way_us_.erase({plan.result.header.client_id, plan.result.header.request_id});
  const wire::Bytes bytes = wire::encode(plan);
  results_.store(plan.result.header.client_id, plan.result.header.request_id,
                 {"CAIRN_PLAN", bytes});
  bus_.publish("CAIRN_PLAN", bytes);
}

void Publisher::publish(HypothesisDrawing drawing) {
  hypothesis_under_way_.reset();
  replication_.offer_hypothesis_map(steady_us(), drawing.hypothesis_id,
                                    std::move(drawing.document));
}

void Publisher::publish(cairn_lcm::status_t status) {
  status.utime = wall_utime();
  status.boot_id = boot_id_;
  status.map_id = map_id_;
  status.map_revision = replication_.revision(What::GLOBAL_MAP);
  status.event_number = events_.newest();
  status.foreign_daemons = foreign_daemons_;
  status.decode_errors += malformed_requests_;
  status.guarantee_given_up_at = -1;
  status.is_guarantee_kept = 1;
  if (state_ != nullptr) {
    status.topology_revision = state_->topology_revision;
    status.num_places = static_cast<int>(state_->places.size());
    status.num_visits = static_cast<int>(state_->visit_count);
    status.num_hypotheses = static_cast<int>(state_->live_count);
    status.num_waiting = state_->waiting_count;
    status.best_probability = state_->probability;
    status.is_localized = state_->hypothesis >= 0 ? 1 : 0;
    status.guarantee_given_up_at = state_->guarantee_given_up_at;
    status.is_guarantee_kept = state_->guarantee_given_up_at < 0 ? 1 : 0;
    status.blamed = state_->blamed;
  }
  bus_.publish("CAIRN_STATUS", status);
}

void Publisher::pump() {
  replication_.pump(steady_us(), wall_utime());
}

}  // namespace cairn
