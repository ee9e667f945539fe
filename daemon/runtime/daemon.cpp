#include "runtime/daemon.hpp"

#include <array>
#include <chrono>
#include <cstdio>
#include <memory>
#include <random>
#include <utility>

#include <poll.h>
#include <spdlog/spdlog.h>

#include "runtime/hypothesis_drawer.hpp"
#include "runtime/map_log.hpp"
#include "runtime/mapping_thread.hpp"
#include "runtime/planner.hpp"
#include "runtime/publisher.hpp"
#include "runtime/solver_thread.hpp"
#include "runtime/status_board.hpp"
#include "runtime/stop_signal.hpp"
#include "runtime/supervisor.hpp"

namespace cairn {
namespace {

constexpr std::int64_t kStatusEvery_us = 1'000'000;

std::int64_t new_boot_id() {
  std::random_device random;
  std::int64_t id = 0;
  while (id <= 0) {
    id = (std::int64_t{random()} << 31) ^ std::int64_t{random()} ^ wall_utime();
  }
  return id;
}

/// The event loop: bus, signals, the two workers, the status. Everything here runs on one thread.
class Daemon {
 public:
  Daemon(const DaemonOptions& options,
         StopSignal& stop,
         wire::Bus& bus,
         std::unique_ptr<Engine> engine)
      : options_(options),
        stop_(stop),
        bus_(bus),
        mapping_(std::move(engine),
                 {static_cast<std::size_t>(options.queued_readings), options.commit_every_s, 1.0,
                  options.service.global_map.tile_cells},
                 wakeup_),
        solver_(
            options.service.refinement, options.service.global_map, options.service.path, wakeup_),
        hypothesis_drawer_(options.service.refinement, options.service.global_map, wakeup_),
        publisher_(bus,
                   new_boot_id(),
                   options.service.localisation,
                   {[this](const cairn_lcm::plan_request_t& one) { return order_plan(one); },
                    [this](MapRequest one) { mapping_.ask(std::move(one)); },
                    [this](const cairn_lcm::snapshot_request_t& one) { mapping_.ask(one); }}),
        inlets_(to_inlet_options(options),
                {[this](LaserScan scan) { take(std::move(scan)); },
                 [this](OdometrySample sample) { take(sample); }, [](const SonarRing&) {}}),
        board_(options) {}

  [[nodiscard]] bool subscribe() {
    const Status inputs = inlets_.subscribe(bus_, [] { return time_of_utime(wall_utime()); });
    if (!inputs) {
      spdlog::error("{}", inputs.error().message);
    }
    return inputs.ok() && publisher_.subscribe();
  }

  ExitCode run() {
    supervisor_.ready();
    spdlog::info("listening on {}", bus_.url());
    while (!stop_.was_raised()) {
      wait();
      if (bus_.handle(0, 256) < 0) {
        spdlog::error("the bus is gone: {}", bus_.url());
        return ExitCode::kNoService;
      }
      take_reports();
      take_outcomes();
      publisher_.pump();
      say_remarks();
      tick();
    }
    return ExitCode::kOk;
  }

  /// What waits is mapped, drawn and stored. @return whether all of it is on the disk
  bool shut_down() {
    supervisor_.stopping();
    board_.note_stopping();
    publish_status();
    std::unique_ptr<Engine> engine = mapping_.stop();
    take_reports();
    solver_.stop();
    MapMaker map_maker(options_.service.global_map);
    MapRefiner map_refiner(options_.service.refinement);
    const std::shared_ptr<const MapState> state = map_refiner.refined(engine->service().state());
    map_maker.draw(*state);
    engine->store(map_maker.documents(*state, {0, engine->map_id()}));
    const Status status = engine->close();
    if (!status) {
      spdlog::error("the map file is not complete: {}", status.error().message);
    }
    return status.ok();
  }

 private:
  void take(SensorReading reading) {
    board_.took(reading);
    mapping_.take(std::move(reading));
  }

  void wait() {
    std::array<pollfd, 3> fds = {
        {{bus_.fileno(), POLLIN, 0}, {stop_.fd(), POLLIN, 0}, {wakeup_.fd(), POLLIN, 0}}};
    const int timeout_ms = publisher_.has_work() ? 2 : 100;
    static_cast<void>(poll(fds.data(), fds.size(), timeout_ms));
    wakeup_.clear();
  }

  void take_reports() {
    while (const std::optional<MappingReport> report = mapping_.next_report()) {
      publisher_.publish(*report);
      board_.took(*report);
      if (board_.note_journal(report->journal_trouble)) {
        publish_status();
      }
      if (report->state != nullptr) {
        newest_ = report->state;
      }
      if (report->hypothesis && report->hypothesis->state) {
        hypothesis_drawer_.order({*report->hypothesis->state, publisher_.sender()});
      }
      log_extensions(*report);
      log_assertion(*report);
    }
    order_drawing();
  }

  /// One drawing is under way at a time; the newest state is drawn next. What was drawn is stored
  /// now and then, and soon after the map has changed.
  void order_drawing() {
    constexpr std::int64_t kSoon_us = 5'000'000;
    const std::shared_ptr<const MapState> next = newest_ != nullptr ? newest_ : drawn_;
    if (is_drawing_ || next == nullptr) {
      return;
    }
    const std::int64_t age_us = steady_us() - last_documents_us_;
    const bool has_changed = next->topology_revision != stored_revision_;
    const bool is_old = static_cast<double>(age_us) > 1e6 * options_.documents_every_s;
    const bool with_documents =
        (has_changed && age_us > kSoon_us) || (is_old && newest_ != nullptr);
    if (newest_ == nullptr && !with_documents) {
      return;
    }
    // A large map takes long to refine; more of the same map waits, so that it takes a tenth of a
    // core at most. What is new in it does not.
    constexpr std::int64_t kRest = 9;
    const bool is_same_map =
        drawn_ != nullptr && next->topology_revision == drawn_->topology_revision;
    if (is_same_map && steady_us() - drawing_end_us_ < kRest * drawing_us_) {
      return;
    }
    if (with_documents) {
      last_documents_us_ = steady_us();
      stored_revision_ = next->topology_revision;
    }
    is_drawing_ = true;
    drawing_begin_us_ = steady_us();
    drawn_ = next;
    newest_ = nullptr;
    solver_.order(DrawOrder{next, {0, publisher_.sender().map_id}, with_documents});
  }

  bool order_plan(const cairn_lcm::plan_request_t& request) {
    if (solver_.waiting() + 2 >= SolverThread::kMaxWaiting) {
      return false;
    }
    solver_.order(PlanOrder{request, publisher_.sender()});
    return true;
  }

  void take_outcomes() {
    while (std::optional<SolverThread::Outcome> outcome = solver_.next_outcome()) {
      if (const auto* const plan = std::get_if<cairn_lcm::plan_t>(&*outcome)) {
        publisher_.publish(*plan);
        continue;
      }
      auto& drawing = std::get<Drawing>(*outcome);
      publisher_.publish(drawing, options_.service.global_map);
      if (drawing.documents) {
        mapping_.store(*std::move(drawing.documents));
      }
      is_drawing_ = false;
      drawing_end_us_ = steady_us();
      drawing_us_ = drawing_end_us_ - drawing_begin_us_;
    }
    while (std::optional<HypothesisDrawing> drawing = hypothesis_drawer_.next_drawing()) {
      publisher_.publish(*std::move(drawing));
    }
    order_drawing();
  }

  void say_remarks() {
    for (const std::string& remark : inlets_.take_remarks()) {
      spdlog::warn("{}", remark);
    }
    if (const std::string remark = publisher_.take_remark(); !remark.empty()) {
      spdlog::warn("{}", remark);
      publish_status();
    }
  }

  void tick() {
    const std::int64_t now = steady_us();
    const std::int64_t progress = mapping_.progress();
    if (progress != last_progress_ || mapping_.waiting() == 0) {
      last_progress_ = progress;
      supervisor_.alive(std::chrono::steady_clock::now());
    }
    const int state = board_.state(publisher_.hears_another_daemon()).first;
    if (now - last_status_us_ >= kStatusEvery_us || state != last_state_) {
      last_state_ = state;
      publish_status();
    }
  }

  void publish_status() {
    cairn_lcm::status_t status =
        board_.status(publisher_.hears_another_daemon(), inlets_, mapping_.dropped());
    last_status_us_ = steady_us();
    supervisor_.status(std::string(status.state_name) +
                       (status.reason.empty() ? "" : ": " + status.reason));
    publisher_.publish(std::move(status));
  }

  const DaemonOptions& options_;
  StopSignal& stop_;
  wire::Bus& bus_;
  Wakeup wakeup_;
  MappingThread mapping_;
  SolverThread solver_;
  HypothesisDrawer hypothesis_drawer_;
  Publisher publisher_;
  Inlets inlets_;
  Supervisor supervisor_;
  StatusBoard board_;

  std::shared_ptr<const MapState> newest_;  ///< Waits to be drawn.
  std::shared_ptr<const MapState> drawn_;   ///< Was drawn last.
  std::int64_t stored_revision_ = 0;        ///< Of the documents in the map file.
  bool is_drawing_ = false;
  std::int64_t drawing_begin_us_ = 0;
  std::int64_t drawing_end_us_ = 0;
  std::int64_t drawing_us_ = 0;  ///< How long the last one took.
  std::int64_t last_documents_us_ = 0;
  std::int64_t last_status_us_ = 0;
  std::int64_t last_progress_ = -1;
  int last_state_ = cairn_lcm::status_t::STARTING;
};

void complain(const std::string& message) {
  static_cast<void>(std::fprintf(stderr, "cairnd: %s\n", message.c_str()));
}

}  // namespace

ExitCode serve(const DaemonOptions& options) {
  StopSignal stop;  // Before LCM and the workers start their threads.
  const auto bus = wire::Bus::open(wire::effective_url(options.lcm_url));
  if (!bus) {
    complain(bus.error());
    return ExitCode::kNoService;
  }
  Result<std::unique_ptr<Engine>> engine = Engine::open(options.service, options.map_file);
  if (!engine) {
    complain(engine.error().message);
    return engine.error().code == ErrorCode::kMalformed ? ExitCode::kBadData
                                                        : ExitCode::kCannotCreate;
  }
  spdlog::info("map file {}: {} visits, {} scans", options.map_file,
               (*engine)->service().experience().visits().size(),
               (*engine)->service().experience().scans().size());
  Daemon daemon(options, stop, **bus, *std::move(engine));
  if (!daemon.subscribe()) {
    return ExitCode::kNoService;
  }
  const ExitCode code = daemon.run();
  const bool is_stored = daemon.shut_down();
  return code == ExitCode::kOk && !is_stored ? ExitCode::kCannotCreate : code;
}

ExitCode test_bus(const DaemonOptions& options) {
  const std::string url = wire::effective_url(options.lcm_url);
  const auto bus = wire::Bus::open(url);
  if (!bus) {
    complain(bus.error());
    return ExitCode::kNoService;
  }
  bool has_arrived = false;
  const bool is_subscribed = (*bus)->subscribe(
      "CAIRN_SELF_TEST", 4, [&has_arrived](const wire::Received&) { has_arrived = true; });
  const std::int64_t until = steady_us() + 2'000'000;
  while (is_subscribed && !has_arrived && steady_us() < until) {
    (*bus)->publish("CAIRN_SELF_TEST", wire::Bytes(8, 0));
    if ((*bus)->handle(100) < 0) {
      break;
    }
  }
  if (!has_arrived) {
    complain("a message to ourselves did not arrive over " + url);
    return ExitCode::kNoService;
  }
  static_cast<void>(std::printf("the bus works: %s\n", url.c_str()));
  return ExitCode::kOk;
}

}  // namespace cairn
