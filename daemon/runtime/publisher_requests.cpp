// The daemon's ear: requests of clients, and other daemons.

#include <utility>

#include "runtime/planner.hpp"
#include "runtime/publisher.hpp"
#include "wire/signatures.hpp"

namespace cairn {
namespace {

using Code = cairn_lcm::result_t;

constexpr std::size_t kMaxRequestBytes = 16 * 1024;
constexpr std::size_t kMostUnderWay = 256;
constexpr std::size_t kMostHeld = 64;
constexpr std::int64_t kLost_us = 60'000'000;  ///< What is under way for longer is asked for anew.

}  // namespace

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
         listen("CAIRN_REQUEST_PERCEPTION",
                &Publisher::on_map_request<cairn_lcm::perception_request_t>) &&
         listen("CAIRN_REQUEST_SNAPSHOT", &Publisher::on_snapshot) &&
         listen("CAIRN_REQUEST_DELTA", &Publisher::on_delta) &&
         listen("CAIRN_REQUEST_EVENTS", &Publisher::on_events) &&
         listen("CAIRN_STATUS", &Publisher::on_status);
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
  if (orders_.plan(request)) {
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
  orders_.mapping(request);
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

/// Whether the map that clients have is older than what they may have been told, a name given or a
/// visit made: the newest is being refined.
bool Publisher::is_behind() const {
  return newest_revision_ >= 0 &&
         (state_ == nullptr || state_->topology_revision < newest_revision_);
}

void Publisher::answer_held() {
  if (!is_behind()) {
    for (const cairn_lcm::snapshot_request_t& request : std::exchange(held_, {})) {
      on_snapshot(request);
    }
  }
}

void Publisher::on_snapshot(const cairn_lcm::snapshot_request_t& request) {
  if (request.what == cairn_lcm::snapshot_request_t::HYPOTHESIS_MAP) {
    on_hypothesis_map(request);
    return;
  }
  const bool is_of_a_map = request.what != cairn_lcm::snapshot_request_t::LPM;
  if (is_of_a_map && is_behind()) {
    held_.push_back(request);
    if (held_.size() > kMostHeld) {
      held_.pop_front();  // The client will ask again.
    }
    return;
  }
  if (!replication_.on_request(steady_us(), request)) {
    answer(request.header, Code::NOT_FOUND, "NOT_FOUND",
           "there is nothing of kind " + std::to_string(request.what) + " yet");
  }
}

/// One at a time: refining and drawing a large map takes a core for a while, and memory.
void Publisher::on_hypothesis_map(const cairn_lcm::snapshot_request_t& request) {
  const std::int64_t now_us = steady_us();
  if (replication_.on_request(now_us, request)) {
    return;
  }
  const std::optional<HypothesisUnderWay> under_way = hypothesis_under_way_;
  // The mapping thread drops what it cannot hold.
  const bool is_lost =
      under_way && !under_way->is_drawing && now_us - under_way->since_us > kLost_us;
  if (!under_way || is_lost) {
    hypothesis_under_way_ = {request.hypothesis_id, now_us, false};
    orders_.hypothesis(request);
  } else if (under_way->hypothesis_id != request.hypothesis_id) {
    answer(request.header, Code::BUSY, "BUSY",
           "the map of hypothesis " + std::to_string(under_way->hypothesis_id) +
               " is being drawn, and no more than one at a time");
    return;
  }
  answer(request.header, Code::ACCEPTED, "ACCEPTED", "");
}

void Publisher::note_laid_out(const AskedHypothesis& hypothesis) {
  if (hypothesis.state) {
    hypothesis_under_way_ = {hypothesis.request.hypothesis_id, steady_us(), true};
    return;
  }
  hypothesis_under_way_.reset();
  const cairn_lcm::result_t refusal =
      to_result(hypothesis.request.header, hypothesis.state.error());
  answer(refusal.header, refusal.code, refusal.code_name, refusal.reason);
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
