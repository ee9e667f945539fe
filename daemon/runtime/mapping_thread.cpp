#include "runtime/mapping_thread.hpp"

#include <chrono>
#include <utility>

#include "runtime/operator_desk.hpp"
#include "runtime/planner.hpp"

namespace cairn {
namespace {

using Clock = std::chrono::steady_clock;

bool is_due(Clock::time_point last, double every_s) {
  return std::chrono::duration<double>(Clock::now() - last).count() >= every_s;
}

}  // namespace

MappingThread::MappingThread(std::unique_ptr<Engine> engine,
                             const Options& options,
                             const Wakeup& wakeup)
    : engine_(std::move(engine)),
      options_(options),
      wakeup_(wakeup),
      orders_(options.queued_readings),
      reports_(options.queued_readings + 16),
      thread_([this] { run(); }) {}

MappingThread::~MappingThread() {
  if (thread_.joinable()) {
    static_cast<void>(stop());
  }
}

std::unique_ptr<Engine> MappingThread::stop() {
  orders_.close();
  thread_.join();
  return std::move(engine_);
}

void MappingThread::run() {
  // What the journal held is published before the first reading comes.
  report({}, 0.0);
  while (!orders_.is_over()) {
    if (std::optional<Order> order = orders_.pop_within(std::chrono::seconds(1))) {
      std::visit([this](auto&& one) { carry_out(std::forward<decltype(one)>(one)); },
                 *std::move(order));
    } else if (!orders_.is_over() && is_due(last_reading_, options_.pause_after_s)) {
      finish_pause();
    }
    commit_when_due();
    ++progress_;
  }
  engine_->commit();
}

/// Readings have stopped: what waits for a later one is taken up now.
void MappingThread::finish_pause() {
  if (!has_paused_) {
    has_paused_ = true;
    report(engine_->finish(), 0.0);
  }
}

void MappingThread::carry_out(SensorReading reading) {
  has_paused_ = false;
  last_reading_ = Clock::now();
  const Clock::time_point start = Clock::now();
  const Updates updates = engine_->take(std::move(reading));
  const std::chrono::duration<double, std::milli> spent = Clock::now() - start;
  if (!updates.scans.empty() || updates.is_health_changed) {
    report(updates, spent.count());
  }
}

void MappingThread::carry_out(const MapRequest& request) {
  const std::int64_t revision = engine_->service().revision();
  MappingReport report = own_report();
  report.answer = std::visit([this](const auto& one) { return answered(one); }, request);
  if (engine_->service().revision() != revision) {
    report.state = engine_->service().state();
  }
  reports_.push(std::move(report));
  wakeup_.signal();
}

/// As long as a visit takes to be laid out. Drawn elsewhere.
void MappingThread::carry_out(cairn_lcm::snapshot_request_t request) {
  MappingReport report = own_report();
  Result<std::shared_ptr<const MapState>> state =
      engine_->service().state_of(request.hypothesis_id);
  if (state && !report.journal_trouble.empty()) {
    state =
        Error{ErrorCode::kUnavailable, "the map file cannot be written: " + report.journal_trouble};
  }
  report.hypothesis = AskedHypothesis{std::move(request), std::move(state)};
  reports_.push(std::move(report));
  wakeup_.signal();
}

MapAnswer MappingThread::answered(const cairn_lcm::name_request_t& request) {
  return to_result(request.header, engine_->name_place(request.place, request.name));
}

MapAnswer MappingThread::answered(const cairn_lcm::assert_request_t& request) {
  const auto now =
      std::chrono::time_point_cast<std::chrono::microseconds>(std::chrono::system_clock::now());
  return answer(request, now, engine_.get());
}

MapAnswer MappingThread::answered(const cairn_lcm::explain_request_t& request) {
  return answer(request, *engine_);
}

MapAnswer MappingThread::answered(const cairn_lcm::perception_request_t& request) {
  return answer(request, engine_.get());
}

void MappingThread::commit_when_due() {
  if (is_due(last_commit_, options_.commit_every_s)) {
    engine_->commit();
    last_commit_ = Clock::now();
  }
}

MappingReport MappingThread::own_report() const {
  const MappingService& service = engine_->service();
  MappingReport report;
  report.map_id = engine_->map_id();
  report.joiner = service.joiner_counters();
  report.health = service.health();
  report.local_map_restarts = service.local_map_restarts();
  report.distinctiveness = service.distinctiveness();
  report.journal_trouble = engine_->journal_trouble();
  return report;
}

void MappingThread::report(const Updates& updates, double update_ms) {
  MappingReport report = own_report();
  const MappingService& service = engine_->service();
  for (const PerceivedScan& scan : updates.scans) {
    report.fixes.push_back({scan.fix, service.T_global_robot()});
  }
  report.events = updates.events;
  report.extensions = updates.extensions;
  report.relocalised = updates.relocalised;
  report.update_ms = update_ms;
  // A map that could not be journalled is not made known.
  const bool may_publish = report.journal_trouble.empty();
  if (may_publish && (updates.is_map_changed || is_due(last_state_, options_.state_every_s))) {
    report.state = service.state();
    report.local_map = std::make_shared<const wire::ReplicatedGrid>(
        to_tiles(service.local_map(), options_.tile_cells));
    last_state_ = Clock::now();
  }
  reports_.push(std::move(report));
  wakeup_.signal();
}

}  // namespace cairn
