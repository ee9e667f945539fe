#include "clients/common/daemon_link.hpp"

#include <limits>
#include <optional>
#include <random>
#include <tuple>
#include <utility>

#include <cairn_lcm/result_t.hpp>
#include <cairn_lcm/snapshot_chunk_t.hpp>
#include <cairn_lcm/snapshot_request_t.hpp>

#include "clients/common/progress.hpp"
#include "clients/common/subscribe.hpp"
#include "clients/common/text.hpp"
#include "wire/document.hpp"
#include "wire/replication_client.hpp"
#include "wire/request.hpp"

namespace cairn::clients {
namespace {

using Request = cairn_lcm::snapshot_request_t;
using cairn_lcm::result_t;

constexpr std::chrono::milliseconds kTick{20};
// A daemon that lives may take longer to make a large document than to say that it lives.
constexpr double kPatience = 4.0;

bool is_longer_than(double seconds, std::int64_t since_us) {
  return static_cast<double>(steady_us() - since_us) > seconds * 1e6;
}

}  // namespace

/// What has come in; the handlers write here.
struct DaemonLink::Inbox {
  std::int64_t heard_us = 0;  ///< Last sign of a daemon.
  std::optional<cairn_lcm::status_t> status;
  std::int64_t client_id = 0;  ///< Of the request under way: answers to others are not for us.
  std::optional<result_t> result;
  std::tuple<std::optional<cairn_lcm::plan_t>,
             std::optional<cairn_lcm::assertion_report_t>,
             std::optional<cairn_lcm::explanation_t>,
             std::optional<cairn_lcm::perception_t>>
      answers;
  wire::DocumentFetch* fetch = nullptr;

  /// @return when the waiting begins: equal to heard_us as long as nobody is heard
  std::int64_t begin(std::int64_t client) {
    client_id = client;
    result.reset();
    answers = {};
    heard_us = steady_us();
    return heard_us;
  }

  /// The answer, or a result in its place: a refusal carries no data.
  template <typename Answer>
  std::optional<Answer> take_answer() {
    auto& answer = std::get<std::optional<Answer>>(answers);
    if (!answer && result) {
      answer.emplace();
      answer->result = *result;
    }
    result.reset();
    return std::exchange(answer, std::nullopt);
  }

  template <typename Answer>
  void listen(wire::Bus& bus, const std::string& channel) {
    clients::subscribe<Answer>(bus, channel, [this](const Answer& answer) {
      if (answer.result.header.client_id == client_id) {
        heard_us = steady_us();
        std::get<std::optional<Answer>>(answers) = answer;
      }
    });
  }
};

std::int64_t random_client_id() {
  std::random_device entropy;
  return std::uniform_int_distribution<std::int64_t>(
      1, std::numeric_limits<std::int64_t>::max())(entropy);
}

std::int64_t steady_us() {
  return std::chrono::duration_cast<std::chrono::microseconds>(
             std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

std::int64_t now_utime() {
  return std::chrono::duration_cast<std::chrono::microseconds>(
             std::chrono::system_clock::now().time_since_epoch())
      .count();
}

DaemonLink::DaemonLink(const LinkOptions& options)
    : options_(options), inbox_(std::make_unique<Inbox>()) {
  wire::Expected<std::unique_ptr<wire::Bus>> bus = wire::Bus::open(options.lcm_url);
  if (!bus) {
    throw Failure(ExitCode::kConfiguration, bus.error());
  }
  own_bus_ = *std::move(bus);
  bus_ = own_bus_.get();
  subscribe();
}

DaemonLink::DaemonLink(const LinkOptions& options, wire::Bus& bus, std::function<void()> between)
    : options_(options),
      bus_(&bus),
      between_(std::move(between)),
      inbox_(std::make_unique<Inbox>()) {
  subscribe();
}

DaemonLink::~DaemonLink() = default;

void DaemonLink::subscribe() {
  Inbox* inbox = inbox_.get();
  clients::subscribe<cairn_lcm::status_t>(*bus_, "CAIRN_STATUS",
                                          [inbox](const cairn_lcm::status_t& status) {
                                            inbox->heard_us = steady_us();
                                            inbox->status = status;
                                          });
  clients::subscribe<result_t>(*bus_, "CAIRN_RESULT", [inbox](const result_t& result) {
    if (result.header.client_id == inbox->client_id) {
      inbox->heard_us = steady_us();
      inbox->result = result;
    }
  });
  inbox->listen<cairn_lcm::plan_t>(*bus_, "CAIRN_PLAN");
  inbox->listen<cairn_lcm::assertion_report_t>(*bus_, "CAIRN_ASSERTION");
  inbox->listen<cairn_lcm::explanation_t>(*bus_, "CAIRN_EXPLANATION");
  inbox->listen<cairn_lcm::perception_t>(*bus_, "CAIRN_PERCEPTION");
  clients::subscribe<cairn_lcm::snapshot_chunk_t>(
      *bus_, "CAIRN_SNAPSHOT", [inbox](const cairn_lcm::snapshot_chunk_t& chunk) {
        if (inbox->fetch != nullptr) {
          inbox->heard_us = steady_us();
          inbox->fetch->on_chunk(steady_us(), chunk);
        }
      });
}

void DaemonLink::handle(std::chrono::milliseconds at_most) {
  if (between_) {
    between_();
  }
  if (bus_->handle(static_cast<int>(at_most.count())) < 0) {
    throw Failure(ExitCode::kNoService, "the connection to the bus is gone: " + bus_->url());
  }
}

Failure DaemonLink::no_daemon() const {
  return {ExitCode::kNoService, "no daemon answered on " + bus_->url() + " within " +
                                    fixed(options_.timeout_s, 1) +
                                    " s: start cairnd, or give its bus with --lcm-url"};
}

cairn_lcm::status_t DaemonLink::status() {
  inbox_->status.reset();
  const std::int64_t begin_us = steady_us();
  while (!inbox_->status) {
    if (is_longer_than(options_.timeout_s, begin_us)) {
      throw no_daemon();
    }
    handle(kTick);
  }
  return *inbox_->status;
}

std::vector<std::uint8_t> DaemonLink::fetch(std::int32_t what,
                                            const std::string& name,
                                            std::int64_t hypothesis_id) {
  wire::ReplicationRequests requests;
  // A new client for each document, since each counts its requests from the beginning.
  requests.client_id = random_client_id();
  requests.send_snapshot_request = [this](const Request& request) {
    bus_->publish("CAIRN_REQUEST_SNAPSHOT", request);
  };
  wire::DocumentFetch fetch(what, 0, requests, hypothesis_id);
  const std::int64_t begin_us = inbox_->begin(requests.client_id);
  inbox_->fetch = &fetch;
  const auto leave = [this](wire::DocumentFetch*) { inbox_->fetch = nullptr; };
  const std::unique_ptr<wire::DocumentFetch, decltype(leave)> guard(&fetch, leave);
  wait_for(fetch, name);
  if (fetch.state() == wire::DocumentFetch::State::kDone) {
    return fetch.document();
  }
  if (inbox_->heard_us == begin_us) {
    throw no_daemon();
  }
  throw Failure(ExitCode::kNoService,
                "the daemon lives, but its " + name + " did not come through");
}

bool DaemonLink::is_at_work(const std::string& name, std::string* busy_with) {
  const std::optional<result_t> result = std::exchange(inbox_->result, std::nullopt);
  if (!result) {
    return false;
  }
  if (result->code == result_t::BUSY) {
    *busy_with = printable(result->reason);
  } else if (result->code >= result_t::BAD_REQUEST) {
    const bool is_ours = result->code != result_t::FAILED;
    throw Failure(is_ours ? ExitCode::kBadData : ExitCode::kNoService,
                  "the daemon has no " + name + ": " + printable(result->reason));
  }
  return result->code == result_t::ACCEPTED;
}

void DaemonLink::wait_for(wire::DocumentFetch& fetch, const std::string& name) {
  Progress progress("receiving the " + name);
  std::int64_t advanced_us = steady_us();
  double share = 0.0;
  std::string busy_with;
  while (fetch.tick(steady_us(), now_utime()) == wire::DocumentFetch::State::kAsking) {
    if (is_longer_than(kPatience * options_.timeout_s, advanced_us)) {
      break;
    }
    handle(kTick);
    const bool is_at_work_now = is_at_work(name, &busy_with);
    if (is_at_work_now || !busy_with.empty()) {
      fetch.accepted();
    }
    if (is_at_work_now || fetch.progress() != share) {
      share = fetch.progress();
      advanced_us = steady_us();
      busy_with.clear();
      progress.show(static_cast<std::int64_t>(share * 1000.0), 1000);
    }
    if (is_longer_than(options_.timeout_s, inbox_->heard_us)) {
      throw no_daemon();
    }
  }
  if (!busy_with.empty()) {
    throw Failure(ExitCode::kNoService, "the daemon is busy: " + busy_with + "; ask again later");
  }
}

template <typename Message>
Message DaemonLink::document(std::int32_t what,
                             const std::string& name,
                             std::int64_t hypothesis_id) {
  wire::Expected<Message> message = wire::from_document<Message>(fetch(what, name, hypothesis_id));
  if (!message) {
    throw Failure(ExitCode::kBadData, "the daemon's " + name + ": " + message.error());
  }
  return *std::move(message);
}

cairn_lcm::topology_t DaemonLink::topology() {
  return document<cairn_lcm::topology_t>(Request::TOPOLOGY, "topological map");
}

cairn_lcm::hypotheses_t DaemonLink::hypotheses() {
  return document<cairn_lcm::hypotheses_t>(Request::HYPOTHESES, "list of hypotheses");
}

cairn_lcm::grid_map_t DaemonLink::global_map() {
  return document<cairn_lcm::grid_map_t>(Request::GLOBAL_MAP, "global map");
}

cairn_lcm::trajectory_t DaemonLink::trajectory() {
  return document<cairn_lcm::trajectory_t>(Request::TRAJECTORY, "trajectory");
}

cairn_lcm::assertions_t DaemonLink::assertions() {
  return document<cairn_lcm::assertions_t>(Request::ASSERTIONS, "list of assertions");
}

template <typename Answer, typename Request>
Answer DaemonLink::ask(const std::string& channel, Request request) {
  request.header.client_id = random_client_id();
  request.header.request_id = 1;
  inbox_->begin(request.header.client_id);
  wire::RequestRetry retry;
  while (true) {
    const wire::RequestRetry::Step step = retry.step(steady_us());
    if (step == wire::RequestRetry::Step::kSend) {
      request.header.utime = now_utime();
      bus_->publish(channel, request);
    }
    if (step == wire::RequestRetry::Step::kGiveUp ||
        is_longer_than(options_.timeout_s, inbox_->heard_us)) {
      throw no_daemon();
    }
    handle(kTick);
    const std::optional<Answer> answer = inbox_->take_answer<Answer>();
    if (!answer) {
      continue;
    }
    if (answer->result.code == result_t::ACCEPTED) {
      retry.accepted(steady_us());
    } else if (answer->result.code == result_t::BUSY) {
      retry.busy(steady_us(), std::int64_t{answer->result.retry_after_ms} * 1'000);
    } else {
      return *answer;
    }
  }
}

cairn_lcm::plan_t DaemonLink::plan(cairn_lcm::plan_request_t request) {
  return ask<cairn_lcm::plan_t>("CAIRN_REQUEST_PLAN", std::move(request));
}

result_t DaemonLink::name_place(std::int64_t place, const std::string& name) {
  cairn_lcm::name_request_t request{};
  request.place = place;
  request.name = name;
  return ask<cairn_lcm::plan_t>("CAIRN_REQUEST_NAME", std::move(request)).result;
}

cairn_lcm::assertion_report_t DaemonLink::say(cairn_lcm::assert_request_t request) {
  return ask<cairn_lcm::assertion_report_t>("CAIRN_REQUEST_ASSERT", std::move(request));
}

cairn_lcm::explanation_t DaemonLink::explain(cairn_lcm::explain_request_t request) {
  return ask<cairn_lcm::explanation_t>("CAIRN_REQUEST_EXPLAIN", request);
}

cairn_lcm::visit_places_t DaemonLink::visit_places() {
  return document<cairn_lcm::visit_places_t>(Request::VISITS, "list of visits");
}

cairn_lcm::hypothesis_map_t DaemonLink::hypothesis_map(std::int64_t hypothesis_id) {
  return document<cairn_lcm::hypothesis_map_t>(
      Request::HYPOTHESIS_MAP, "map of hypothesis " + std::to_string(hypothesis_id), hypothesis_id);
}

cairn_lcm::perceived_place_t DaemonLink::perceived_place(std::int64_t visit) {
  cairn_lcm::perception_request_t request{};
  request.visit = visit;
  cairn_lcm::perception_t answer =
      ask<cairn_lcm::perception_t>("CAIRN_REQUEST_PERCEPTION", request);
  if (answer.result.code != result_t::OK) {
    const bool is_missing = answer.result.code == result_t::NOT_FOUND;
    throw Failure(is_missing ? ExitCode::kBadData : ExitCode::kNoService,
                  "the daemon does not show visit " + std::to_string(visit) + ": " +
                      printable(answer.result.reason));
  }
  return std::move(answer.perceived);
}

}  // namespace cairn::clients
