#include "runtime/engine.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

#include "base/check.hpp"
#include "transport/place_messages.hpp"
#include "wire/document.hpp"
#include "wire/signatures.hpp"

namespace cairn {
namespace {

/// About an hour of scans at 10 Hz.
constexpr std::size_t kMaxWaiting = 36'000;
constexpr std::size_t kCommitAfter = 2'000;

bool is_text_up_to_64_bytes(const std::string& text) {
  return text.size() <= 64 && std::none_of(text.begin(), text.end(), [](char c) {
           return static_cast<unsigned char>(c) < 0x20 || c == 0x7F;
         });
}

}  // namespace

Engine::Engine(const ServiceOptions& options, MapFile map_file)
    : place_options_(options.place),
      map_file_(std::move(map_file)),
      service_(std::make_unique<MappingService>(
          options, [this](Stage stage) { stage_clock_.enter(stage); })) {}

Result<std::unique_ptr<Engine>> Engine::open(const ServiceOptions& options,
                                             const std::string& map_file) {
  Result<MapFile> file = MapFile::open(map_file);
  if (!file) {
    return file.error();
  }
  std::unique_ptr<Engine> engine(new Engine(options, *std::move(file)));
  if (const Status status = engine->recall(); !status) {
    return Error{status.error().code, map_file + ": " + status.error().message};
  }
  return engine;
}

Status Engine::recall() {
  Status status =
      map_file_.read_journal({[this](PerceivedScan scan) { service_->recall(std::move(scan)); },
                              [this](Visit visit) { return service_->recall(std::move(visit)); },
                              [this](const OperatorOrder& order) -> Status {
                                const Result<AssertionReport> report = carry_out(order);
                                return report ? Status() : report.error();
                              }});
  if (!status) {
    return status;
  }
  journal(service_->resume());
  const Result<std::map<std::int64_t, std::string>> names = map_file_.read_names();
  if (!names) {
    return names.error();
  }
  for (const auto& [visit, name] : *names) {
    if (visit >= 0 && visit < map_file_.visit_count()) {
      service_->name_place_of(VisitId{static_cast<std::int32_t>(visit)}, name);
    }
  }
  return status;
}

Status Engine::name_place(std::int64_t place, const std::string& name) {
  if (!is_text_up_to_64_bytes(name)) {
    return Error{ErrorCode::kInvalidValue, "a name has at most 64 bytes and no control characters"};
  }
  const std::shared_ptr<const MapState> state = service_->state();
  if (place < 0 || place >= static_cast<std::int64_t>(state->places.size())) {
    return Error{ErrorCode::kNotFound, "there is no place " + std::to_string(place)};
  }
  for (const MappedPlace& other : state->places) {
    if (!name.empty() && other.name == name && other.id != place) {
      return Error{ErrorCode::kInvalidValue,
                   "'" + name + "' is the name of place " + std::to_string(other.id)};
    }
  }
  const std::optional<VisitId> visit = service_->first_visit(static_cast<int>(place));
  CAIRN_CHECK(visit.has_value());
  commit();
  if (!journal_trouble_.empty()) {
    return Error{ErrorCode::kUnavailable, "the map file cannot be written: " + journal_trouble_};
  }
  if (Status status = map_file_.write_name(visit->value, name); !status) {
    map_file_.roll_back();
    return status;
  }
  service_->name_place_of(*visit, name);
  return {};
}

Result<AssertionReport> Engine::take(const OperatorOrder& order) {
  const auto done = orders_done_.find({order.client_id, order.request_id});
  if (done != orders_done_.end()) {
    return done->second;
  }
  if (const Status status = check(order); !status) {
    return status.error();
  }
  if (std::optional<AssertionReport> report = said_already(order)) {
    return *std::move(report);
  }
  commit();
  if (!journal_trouble_.empty()) {
    return Error{ErrorCode::kUnavailable, "the map file cannot be written: " + journal_trouble_};
  }
  if (const Status status = map_file_.write_order(order); !status) {
    map_file_.roll_back();
    return status.error();
  }
  Result<AssertionReport> report = carry_out(order);
  store_map();
  return report;
}

std::optional<AssertionReport> Engine::said_already(const OperatorOrder& order) const {
  const bool is_same = order.kind == OperatorOrder::Kind::kSame;
  const HypothesisTree& tree = service_->tree();
  for (const OperatorAssertion& one : tree.assertions()) {
    const bool is_about_both = std::minmax(one.a, one.b) == std::minmax(order.a, order.b);
    if (order.kind != OperatorOrder::Kind::kRetract && !one.retracted_after_visits &&
        is_about_both && one.is_same == is_same) {
      AssertionReport report;
      report.assertion = one.number;
      const Hypothesis best = tree.best();
      report.best = best.id;
      report.log_posterior_before = report.log_posterior_after = best.log_posterior();
      report.sentence = "it is in force already, said by " + one.who + "; nothing changes";
      return report;
    }
  }
  return std::nullopt;
}

/// So that the map file does not show the map from before an operator spoke. The drawing follows.
void Engine::store_map() {
  store(documents_without_drawing(*service_->state(), {0, map_id()}));
}

Status Engine::check(const OperatorOrder& order) const {
  if (order.by.who.empty() || !is_text_up_to_64_bytes(order.by.who)) {
    return Error{ErrorCode::kInvalidValue,
                 "who says so: expected 1 to 64 bytes without control characters"};
  }
  const HypothesisTree& tree = service_->tree();
  return order.kind == OperatorOrder::Kind::kRetract
             ? tree.check_retraction(order.assertion)
             : tree.check_places(order.a, order.b, order.kind == OperatorOrder::Kind::kSame);
}

Result<AssertionReport> Engine::carry_out(const OperatorOrder& order) {
  Result<AssertionReport> report =
      order.kind == OperatorOrder::Kind::kRetract
          ? service_->retract(order.assertion, order.by)
          : service_->assert_places(order.a, order.b, order.kind == OperatorOrder::Kind::kSame,
                                    order.by);
  if (report) {
    orders_done_[{order.client_id, order.request_id}] = *report;
  }
  return report;
}

Updates Engine::take(SensorReading reading) {
  Updates updates = std::visit(
      [this](auto&& value) { return service_->absorb(std::forward<decltype(value)>(value)); },
      std::move(reading));
  journal(updates);
  return updates;
}

Updates Engine::finish() {
  Updates updates = service_->finish();
  journal(updates);
  return updates;
}

void Engine::journal(const Updates& updates) {
  for (const PerceivedScan& scan : updates.scans) {
    waiting_.emplace_back(scan);
  }
  for (const Visit& visit : updates.visits) {
    waiting_.emplace_back(visit);
  }
  if (is_journal_closed_) {
    waiting_.clear();
  }
  write_waiting(!updates.visits.empty() && journal_trouble_.empty());
  bound_waiting();
}

Status Engine::append(const PerceivedScan& scan) {
  return map_file_.append(scan);
}

Status Engine::append(const Visit& visit) {
  const Status status = map_file_.append(visit);
  if (!status) {
    return status;
  }
  const std::int64_t number = map_file_.visit_count() - 1;
  return map_file_.append_perception(
      number, wire::to_document(to_perceived_place(visit.perceived, number, place_options_)));
}

Result<cairn_lcm::perceived_place_t> Engine::perception(std::int64_t visit) {
  const std::vector<Visit>& visits = service_->experience().visits();
  if (visit < 0 || visit >= static_cast<std::int64_t>(visits.size())) {
    return Error{ErrorCode::kNotFound, "there is no visit " + std::to_string(visit) + "; " +
                                           std::to_string(visits.size()) + " so far"};
  }
  const Result<std::vector<std::uint8_t>> kept = map_file_.read_perception(visit);
  if (!kept) {
    return kept.error();
  }
  auto perceived = wire::from_document<cairn_lcm::perceived_place_t>(*kept);
  cairn_lcm::perceived_place_t message =
      perceived ? *std::move(perceived)
                : to_perceived_place(visits[static_cast<std::size_t>(visit)].perceived, visit,
                                     place_options_);
  const std::shared_ptr<const MapState> state = service_->state();
  const std::vector<int>& places = state->place_of_visit;
  const auto index = static_cast<std::size_t>(visit);
  message.place_id = index < places.size() ? places[index] : -1;
  return message;
}

void Engine::commit() {
  write_waiting(true);
}

void Engine::write_waiting(bool commit) {
  const bool is_retry_due = journal_trouble_.empty() || commit;
  if (is_journal_closed_ || !is_retry_due) {
    return;
  }
  const auto start = std::chrono::steady_clock::now();
  Status status;
  while (appended_ < waiting_.size() && status) {
    status = std::visit([this](const auto& entry) { return append(entry); }, waiting_[appended_]);
    appended_ += status ? 1U : 0U;
  }
  if (status && (commit || appended_ >= kCommitAfter)) {
    status = map_file_.commit();
    if (status) {
      waiting_.clear();
      appended_ = 0;
      journal_trouble_.clear();
    }
  }
  if (!status) {
    // The disk took only a part, or none: all of it stays here and is written anew later.
    map_file_.roll_back();
    appended_ = 0;
    journal_trouble_ = status.error().message;
  }
  journal_seconds_ +=
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// A journal with a hole could not be taken up again: rather an earlier end than a hole.
void Engine::bound_waiting() {
  if (waiting_.size() > kMaxWaiting) {
    waiting_.clear();
    is_journal_closed_ = true;
    journal_trouble_ += "; given up: what comes now is not kept, restart when there is space";
  }
}

void Engine::store(const Documents& documents) {
  commit();
  if (!journal_trouble_.empty()) {
    return;  // The journal comes first.
  }
  for (const auto& [what, bytes] : documents.bytes) {
    if (const Status status = map_file_.write_document(what, documents.revision, bytes); !status) {
      map_file_.roll_back();
      journal_trouble_ = status.error().message;
      return;
    }
  }
  if (const Status status = map_file_.commit(); !status) {
    map_file_.roll_back();
    journal_trouble_ = status.error().message;
  }
}

Status Engine::close() {
  commit();
  if (!journal_trouble_.empty()) {
    return Error{ErrorCode::kUnavailable, journal_trouble_};
  }
  return map_file_.close();
}

}  // namespace cairn
