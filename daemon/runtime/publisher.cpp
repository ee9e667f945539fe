#include "runtime/publisher.hpp"

#include <chrono>
#include <utility>

#include "runtime/planner.hpp"
#include "wire/document.hpp"
#include "wire/signatures.hpp"

namespace cairn {
namespace {

using What = cairn_lcm::snapshot_request_t;
using Code = cairn_lcm::result_t;

constexpr std::size_t kMaxRequestBytes = 16 * 1024;
constexpr std::size_t kMostUnderWay = 256;
constexpr std::int64_t kLost_us = 60'000'000;  ///< What is under way for longer is asked for anew.
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
                     OrderPlan order_plan,
                     OrderMapping order_mapping)
    : bus_(bus),
      boot_id_(boot_id),
      order_plan_(std::move(order_plan)),
      order_mapping_(std::move(order_mapping)),
      replication_(
          boot_id,
          [this](const cairn_lcm::snapshot_chunk_t& chunk) {
            bus_.publish("CAIRN_SNAPSHOT", chunk);
          },
          [this](const cairn_lcm::map_delta_t& delta) {
            bus_.publish(delta.what == What::LPM ? "CAIRN_LPM" : "CAIRN_MAP_DELTA", delta);
          }),
      events_(boot_id) {
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
}

template <class Request>
bool Publisher::listen(const std::string& channel, void (Publisher::*handle)(const Request&)) {
  return bus_.subscribe(channel, 64, [this, handle](const wire::Received& received) {
    const auto request = wire::decode<Request>(received.bytes, received.size, kMaxRequestBytes);
    if (!request) {
      ++malformed_requests_;
      return;
    }
    (this->*handle)(*request);
  });
}

bool Publisher::subscribe() {
  return listen("CAIRN_REQUEST_PLAN", &Publisher::on_plan) &&
         listen("CAIRN_REQUEST_NAME", &Publisher::on_map_request<cairn_lcm::name_request_t>) &&
         listen("CAIRN_REQUEST_ASSERT", &Publisher::on_map_request<cairn_lcm::assert_request_t>) &&
         listen("CAIRN_REQUEST_EXPLAIN",
                &Publisher::on_map_request<cairn_lcm::explain_request_t>) &&
         listen("CAIRN_REQUEST_SNAPSHOT", &Publisher::on_snapshot) &&
         listen("CAIRN_REQUEST_DELTA", &Publisher::on_delta) &&
         listen("CAIRN_REQUEST_EVENTS", &Publisher::on_events) &&
         listen("CAIRN_STATUS", &Publisher::on_status);
}

void Publisher::publish(const MappingReport& report) {
  map_id_ = report.map_id;
  for (const MappedFix& fix : report.fixes) {
    const bool is_known = state_ != nullptr && state_->hypothesis >= 0;
    bus_.publish("CAIRN_POSE", to_pose(fix.fix, is_known ? &fix.T_global_robot : nullptr,
                                       state_.get(), sender()));
  }
  if (report.state != nullptr) {
    publish_state(report.state);
  }
  if (report.answer) {
    publish(*report.answer);
  }
  for (const PlaceEvent& event : report.events) {
    for (const cairn_lcm::place_event_t& message : events_.note(event, state_.get())) {
      bus_.publish("CAIRN_PLACE_EVENT", message);
    }
  }
  if (report.local_map != nullptr) {
    publish_local_map(*report.local_map);
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
  const std::shared_ptr<const MapState> before = std::exchange(state_, state);
  if (before != nullptr && before->topology_revision == state->topology_revision) {
    return;
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

void Publisher::on_plan(const cairn_lcm::plan_request_t& request) {
  const cairn_lcm::rpc_header_t& header = request.header;
  if (const auto* const stored = results_.find(header.client_id, header.request_id)) {
    bus_.publish(stored->channel, stored->bytes);
    return;
  }
  const auto key = std::make_pair(header.client_id, header.request_id);
  if (under_way_us_.count(key) != 0) {
    return;  // Asked again: the answer is on its way.
  }
  if (order_plan_(request)) {
    under_way_us_[key] = steady_us();
  } else {
    // Not stored: the client is asked to come back.
    bus_.publish("CAIRN_PLAN", refusal(header, sender(), Code::BUSY, "too many plans are waiting"));
  }
}

/// Growing the tree anew may take longer than a client waits: asked again it hears that its request
/// was taken up.
template <class Request>
void Publisher::on_map_request(const Request& request) {
  const cairn_lcm::rpc_header_t& header = request.header;
  if (const auto* const stored = results_.find(header.client_id, header.request_id)) {
    bus_.publish(stored->channel, stored->bytes);
    return;
  }
  const auto key = std::make_pair(header.client_id, header.request_id);
  if (under_way_us_.size() >= kMostUnderWay && under_way_us_.count(key) == 0) {
    answer(header, Code::BUSY, "BUSY", "too many requests are waiting");
    return;
  }
  const auto [since, is_new] = under_way_us_.try_emplace(key, steady_us());
  if (!is_new && steady_us() - since->second < kLost_us) {
    answer(header, Code::ACCEPTED, "ACCEPTED", "");
    return;
  }
  since->second = steady_us();
  order_mapping_(request);
}

void Publisher::answer(const cairn_lcm::rpc_header_t& request,
                       std::int32_t code,
                       const std::string& name,
                       const std::string& reason) {
  cairn_lcm::result_t result{};
  result.header = request;
  result.header.utime = wall_utime();
  result.header.boot_id = boot_id_;
  result.code = code;
  result.code_name = name;
  result.reason = reason;
  bus_.publish("CAIRN_RESULT", result);
}

void Publisher::on_snapshot(const cairn_lcm::snapshot_request_t& request) {
  if (!replication_.on_request(steady_us(), request)) {
    answer(request.header, Code::NOT_FOUND, "NOT_FOUND",
           "there is nothing of kind " + std::to_string(request.what) + " yet");
  }
}

void Publisher::on_delta(const cairn_lcm::delta_request_t& request) {
  if (!replication_.on_request(steady_us(), request)) {
    answer(request.header, Code::NOT_FOUND, "NOT_FOUND",
           "there is no grid of kind " + std::to_string(request.what) + " yet");
  }
}

void Publisher::on_events(const cairn_lcm::event_request_t& request) {
  for (const cairn_lcm::place_event_t& event : events_.after(request.have_event_number)) {
    bus_.publish("CAIRN_PLACE_EVENT", event);
  }
}

bool Publisher::hears_another_daemon() const {
  constexpr std::int64_t kSilence_us = 5'000'000;  // Every daemon speaks once a second.
  return foreign_heard_us_ != 0 && steady_us() - foreign_heard_us_ < kSilence_us;
}

void Publisher::on_status(const cairn_lcm::status_t& status) {
  if (status.boot_id == boot_id_) {
    return;
  }
  ++foreign_daemons_;
  foreign_heard_us_ = steady_us();
  if (foreign_boot_id_ != status.boot_id) {
    foreign_boot_id_ = status.boot_id;
    remark_ = "another cairnd is on this bus (boot id " + std::to_string(status.boot_id) +
              "); clients will hear both: stop one, or give it another --lcm-url";
  }
}

}  // namespace cairn
