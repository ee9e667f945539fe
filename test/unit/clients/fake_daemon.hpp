#pragma once

#include <algorithm>
#include <functional>
#include <limits>

#include <cairn_lcm/assert_request_t.hpp>
#include <cairn_lcm/assertion_report_t.hpp>
#include <cairn_lcm/event_request_t.hpp>
#include <cairn_lcm/explain_request_t.hpp>
#include <cairn_lcm/explanation_t.hpp>
#include <cairn_lcm/frame_change_t.hpp>
#include <cairn_lcm/map_delta_t.hpp>
#include <cairn_lcm/perception_request_t.hpp>
#include <cairn_lcm/perception_t.hpp>
#include <cairn_lcm/place_event_t.hpp>
#include <cairn_lcm/plan_request_t.hpp>
#include <cairn_lcm/plan_t.hpp>
#include <cairn_lcm/pose_t.hpp>
#include <cairn_lcm/result_t.hpp>
#include <cairn_lcm/snapshot_chunk_t.hpp>
#include <cairn_lcm/snapshot_request_t.hpp>

#include "clients/common/daemon_link.hpp"
#include "clients/common/subscribe.hpp"
#include "unit/clients/sample_map.hpp"
#include "wire/document.hpp"
#include "wire/replication_server.hpp"

namespace cairn::clients {

/// The daemon's side of the bus, serving the sample map except for its trajectory. Works on the
/// thread that serves the bus.
class FakeDaemon {
 public:
  explicit FakeDaemon(wire::Bus& bus)
      : bus_(bus),
        server_(
            99,
            [this](const cairn_lcm::snapshot_chunk_t& chunk) {
              if (++chunks_sent_ % lose_every_ != 0) {
                bus_.publish("CAIRN_SNAPSHOT", chunk);
              }
            },
            [](const cairn_lcm::map_delta_t&) {},
            small_chunks()) {
    serve(cairn_lcm::snapshot_request_t::TOPOLOGY, sample_topology());
    serve(cairn_lcm::snapshot_request_t::HYPOTHESES, sample_hypotheses());
    serve(cairn_lcm::snapshot_request_t::VISITS, sample_visits());
    subscribe<cairn_lcm::perception_request_t>(
        bus, "CAIRN_REQUEST_PERCEPTION",
        [this](const cairn_lcm::perception_request_t& request) { show(request); });
    serve(cairn_lcm::snapshot_request_t::GLOBAL_MAP, sample_grid());
    serve(cairn_lcm::snapshot_request_t::ASSERTIONS, sample_assertions());
    subscribe<cairn_lcm::assert_request_t>(
        bus, "CAIRN_REQUEST_ASSERT",
        [this](const cairn_lcm::assert_request_t& request) { hear(request); });
    subscribe<cairn_lcm::explain_request_t>(
        bus, "CAIRN_REQUEST_EXPLAIN",
        [this](const cairn_lcm::explain_request_t& request) { explain(request); });
    subscribe<cairn_lcm::snapshot_request_t>(
        bus, "CAIRN_REQUEST_SNAPSHOT", [this](const cairn_lcm::snapshot_request_t& request) {
          if (server_.on_request(steady_us(), request)) {
            return;
          }
          if (request.what == cairn_lcm::snapshot_request_t::HYPOTHESIS_MAP) {
            draw(request);
          } else {
            refuse(request.header, cairn_lcm::result_t::NOT_FOUND, "nothing mapped yet");
          }
        });
    subscribe<cairn_lcm::event_request_t>(
        bus, "CAIRN_REQUEST_EVENTS", [this](const cairn_lcm::event_request_t& request) {
          for (std::int64_t number = request.have_event_number + 1; number <= newest_event_;
               ++number) {
            send_event(number);
          }
        });
    subscribe<cairn_lcm::plan_request_t>(bus, "CAIRN_REQUEST_PLAN",
                                         [this](const cairn_lcm::plan_request_t& request) {
                                           ++plan_requests_;
                                           if (answer_plan) {
                                             answer_plan(request);
                                           }
                                         });
  }

  void work() {
    cairn_lcm::status_t status = sample_status();
    status.event_number = newest_event_;
    bus_.publish("CAIRN_STATUS", status);
    server_.pump(steady_us(), now_utime());
  }

  /// Entering the place of that number; sent so that every other one is lost.
  void happen() {
    if (++newest_event_ % 2 == 1) {
      send_event(newest_event_);
      send_frame_change();
    }
  }

  void refuse(const cairn_lcm::rpc_header_t& header, std::int32_t code, const char* reason) {
    cairn_lcm::result_t result{};
    result.header = header;
    result.code = code;
    result.reason = reason;
    bus_.publish("CAIRN_RESULT", result);
  }

  void send_plan(const cairn_lcm::plan_request_t& request, std::int32_t code) {
    cairn_lcm::plan_t plan{};
    plan.result.header = request.header;
    plan.result.code = code;
    plan.result.retry_after_ms = 10;
    plan.places = {1, 2, request.goal_place};
    plan.num_places = 3;
    bus_.publish("CAIRN_PLAN", plan);
  }

  /// Works for a while on the first request; refuses what contradicts.
  void hear(const cairn_lcm::assert_request_t& request) {
    heard_ = request;
    if (++asserts_heard_ == 1) {
      refuse(request.header, cairn_lcm::result_t::ACCEPTED, "");
      return;
    }
    if (request.kind == cairn_lcm::assert_request_t::SAME) {
      refuse(request.header, cairn_lcm::result_t::BAD_REQUEST, "it contradicts assertion 1");
      return;
    }
    cairn_lcm::assertion_report_t report{};
    report.result.header = request.header;
    report.assertion = 3;
    report.sentence = "visit 9 is at another place now";
    report.num_moved = report.num_listed = 1;
    report.visit = {9};
    report.known_since_before = {2};
    report.known_since_after = {9};
    report.place = {6};
    bus_.publish("CAIRN_ASSERTION", report);
  }

  /// Takes its time with the map of hypothesis 8; for others it has none.
  void draw(const cairn_lcm::snapshot_request_t& request) {
    if (request.hypothesis_id != 8) {
      refuse(request.header, answer_to_others, "hypothesis 99 is not live; expected one of 3, 8");
    } else if (++maps_asked_ < 3) {
      refuse(request.header, cairn_lcm::result_t::ACCEPTED, "");
    } else {
      const cairn_lcm::hypothesis_map_t map = sample_hypothesis_map();
      server_.offer_hypothesis_map(steady_us(), 8,
                                   {map.map_id, map.revision, wire::to_document(map)});
    }
  }

  void show(const cairn_lcm::perception_request_t& request) {
    if (request.visit < 0 || request.visit >= sample_visits().num_visits) {
      refuse(request.header, cairn_lcm::result_t::NOT_FOUND, "there is no such visit");
      return;
    }
    cairn_lcm::perception_t answer{};
    answer.result.header = request.header;
    answer.perceived = sample_perceived(request.visit);
    bus_.publish("CAIRN_PERCEPTION", answer);
  }

  /// Of five visits, two an answer; visit 3 was to place 2.
  void explain(const cairn_lcm::explain_request_t& request) {
    using Request = cairn_lcm::explain_request_t;
    cairn_lcm::explanation_t message{};
    message.result.header = request.header;
    message.hypothesis_id = 3;
    message.visit = request.visit;
    message.next_visit =
        request.kind == Request::OVERVIEW && request.visit < 4 ? request.visit + 2 : -1;
    message.sentence = "hypotheses 3 and 8 part at visit 4";
    const bool is_overview = request.kind == Request::OVERVIEW;
    for (std::int64_t visit = request.visit; visit < std::min<std::int64_t>(request.visit + 2, 5);
         ++visit) {
      cairn_lcm::explained_step_t step{};
      step.visit = is_overview ? visit : request.visit;
      step.at_place = step.visit == 3 ? 2 : 7;
      step.is_fate_known = 1;
      step.fate_log_odds = -std::numeric_limits<double>::infinity();
      step.sentence = "visit " + std::to_string(step.visit) + ": closure";
      message.steps.push_back(step);
    }
    message.num_steps = static_cast<std::int32_t>(message.steps.size());
    bus_.publish("CAIRN_EXPLANATION", message);
  }

  std::function<void(const cairn_lcm::plan_request_t&)> answer_plan;
  cairn_lcm::assert_request_t heard_{};
  int asserts_heard_ = 0;
  int maps_asked_ = 0;
  std::int32_t answer_to_others = cairn_lcm::result_t::NOT_FOUND;
  int plan_requests_ = 0;
  std::int64_t newest_event_ = 0;
  int lose_every_ = 1'000'000;

 private:
  void send_event(std::int64_t number) {
    cairn_lcm::place_event_t event{};
    event.boot_id = 99;
    event.event_number = number;
    event.kind_name = "ENTERED";
    event.place_id = 100 + number;
    bus_.publish("CAIRN_PLACE_EVENT", event);
  }

  void send_frame_change() {
    cairn_lcm::frame_change_t change{};
    change.boot_id = 99;
    change.older_revision = 6;
    change.newer_revision = 7;
    change.robot_dx_m = 0.25;
    change.largest_move_m = 0.5;
    change.num_places = 1;
    change.place_id = {3};
    change.dx_m = {0.5};
    change.dy_m = {0.0};
    change.dtheta_rad = {0.01};
    bus_.publish("CAIRN_FRAME_CHANGE", change);
  }

  static wire::ReplicationServerOptions small_chunks() {
    wire::ReplicationServerOptions options;
    options.chunk_bytes = 256;
    return options;
  }

  template <typename Message>
  void serve(std::int32_t what, const Message& message) {
    server_.serve(what, [message] {
      return wire::Document{message.map_id, message.revision, wire::to_document(message)};
    });
  }

  wire::Bus& bus_;
  int chunks_sent_ = 0;
  wire::ReplicationServer server_;
};

}  // namespace cairn::clients
