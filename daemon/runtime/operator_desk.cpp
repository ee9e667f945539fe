#include "runtime/operator_desk.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "runtime/planner.hpp"

namespace cairn {
namespace {

using cairn_lcm::assert_request_t;
using cairn_lcm::explain_request_t;
using cairn_lcm::explained_step_t;
using cairn_lcm::explanation_t;

/// Fates are looked at for so many alternatives of a visit: each follows the whole way since.
constexpr int kMostFates = 16;

std::string text_of(std::int64_t number) {
  return std::to_string(number);
}

/// The visit of which an operator speaks.
Result<VisitId> visit_of(const cairn_lcm::place_ref_t& ref, const MappingService& service) {
  const auto visits = static_cast<std::int64_t>(service.experience().visits().size());
  if (ref.visit >= 0) {
    if (ref.visit >= visits) {
      return Error{ErrorCode::kNotFound,
                   "there is no visit " + text_of(ref.visit) + "; " + text_of(visits) + " so far"};
    }
    return VisitId{static_cast<std::int32_t>(ref.visit)};
  }
  std::int64_t place = ref.place;
  if (place < 0) {
    const std::shared_ptr<const MapState> state = service.state();
    const auto named = std::find_if(
        state->places.begin(), state->places.end(),
        [&](const MappedPlace& one) { return !one.name.empty() && one.name == ref.name; });
    if (named == state->places.end()) {
      return Error{ErrorCode::kNotFound, "no place is called '" + ref.name + "'"};
    }
    place = named->id;
  }
  const bool fits = place <= std::numeric_limits<int>::max();
  const std::optional<VisitId> visit =
      fits ? service.first_visit(static_cast<int>(place)) : std::nullopt;
  if (!visit) {
    return Error{ErrorCode::kNotFound, "there is no place " + text_of(place)};
  }
  return *visit;
}

/// For an error: what was typed.
std::string name_of(const cairn_lcm::place_ref_t& ref) {
  return ref.visit >= 0   ? "visit " + text_of(ref.visit)
         : ref.place >= 0 ? "place " + text_of(ref.place)
                          : "'" + ref.name + "'";
}

Result<OperatorOrder> order_of(const assert_request_t& request,
                               TimePoint now,
                               const MappingService& service) {
  OperatorOrder order;
  order.by = {request.who, now};
  order.client_id = request.header.client_id;
  order.request_id = request.header.request_id;
  if (request.kind == assert_request_t::RETRACT) {
    order.kind = OperatorOrder::Kind::kRetract;
    if (request.assertion < 0 || request.assertion > std::numeric_limits<std::int32_t>::max()) {
      return Error{ErrorCode::kNotFound, "there is no assertion " + text_of(request.assertion)};
    }
    order.assertion = static_cast<int>(request.assertion);
    return order;
  }
  if (request.kind != assert_request_t::SAME && request.kind != assert_request_t::DIFFERENT) {
    return Error{ErrorCode::kInvalidValue,
                 "kind: expected 0, 1 or 2, got " + text_of(request.kind)};
  }
  order.kind = request.kind == assert_request_t::SAME ? OperatorOrder::Kind::kSame
                                                      : OperatorOrder::Kind::kDifferent;
  const Result<VisitId> a = visit_of(request.a, service);
  const Result<VisitId> b = visit_of(request.b, service);
  if (!a || !b) {
    return !a ? a.error() : b.error();
  }
  if (*a == *b) {
    return Error{ErrorCode::kInvalidValue, name_of(request.a) + " and " + name_of(request.b) +
                                               " are the same visit (" + text_of(a->value) +
                                               "): expected two; see 'cairn why' for visits"};
  }
  order.a = *a;
  order.b = *b;
  return order;
}

void put(const AssertionReport& report,
         const MapState& state,
         cairn_lcm::assertion_report_t* message) {
  message->assertion = report.assertion;
  message->hypothesis_id = report.best.value;
  message->before_log_posterior = report.log_posterior_before;
  message->after_log_posterior = report.log_posterior_after;
  message->sentence = report.sentence;
  message->num_moved = static_cast<std::int32_t>(report.moved.size());
  const std::size_t listed = std::min(report.moved.size(), kMostMoved);
  for (std::size_t i = 0; i < listed; ++i) {
    const MovedVisit& moved = report.moved[i];
    message->visit.push_back(moved.visit.value);
    message->known_since_before.push_back(moved.place_before.value);
    message->known_since_after.push_back(moved.place_after.value);
    message->place.push_back(moved.visit.index() < state.place_of_visit.size()
                                 ? state.place_of_visit[moved.visit.index()]
                                 : -1);
  }
  message->num_listed = static_cast<std::int32_t>(listed);
}

explained_step_t to_step(const HypothesisTree::Considered& one, VisitId visit, HypothesisId of) {
  explained_step_t step{};
  step.visit = visit.value;
  step.hypothesis_id = of.value;
  step.at_place = -1;
  step.kind_name = std::string(cairn::name_of(one.kind));
  step.is_taken = one.is_taken ? 1 : 0;
  step.refuted_by =
      one.refuted_by == Refutation::kNone ? "" : std::string(reason_of(one.refuted_by));
  step.from_place = one.departure.place.value;
  step.from_gateway = one.departure.gateway;
  step.to_place = one.target.place.value;
  step.to_gateway = one.target.gateway;
  step.log_likelihood = one.log_likelihood;
  step.fate_visit = -1;
  step.sentence = one.sentence;
  return step;
}

void put(const HypothesisTree::Fate& fate, explained_step_t* step) {
  step->is_fate_known = 1;
  step->fate_visit = fate.visit.value;
  step->fate_log_odds = fate.log_odds;
  step->sentence = fate.sentence;
}

bool is_taken_before(const explained_step_t& a, const explained_step_t& b) {
  const auto rank = [](const explained_step_t& step) {
    return step.is_taken != 0 ? 0 : step.refuted_by.empty() ? 1 : 2;
  };
  return rank(a) < rank(b);
}

void explain_visit(const HypothesisTree& tree, VisitId visit, explanation_t* message) {
  const HypothesisId best = tree.best().id;
  const int place = tree.map(best).at_visit(visit).place.value;
  const std::vector<HypothesisTree::Considered> all = tree.explanation(best, visit);
  int fates = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    explained_step_t step = to_step(all[i], visit, best);
    step.at_place = place;
    const bool is_open = !all[i].is_taken && all[i].refuted_by == Refutation::kNone;
    if (is_open && ++fates <= kMostFates) {
      put(tree.why_not(best, visit, i), &step);
    }
    message->steps.push_back(std::move(step));
  }
  std::stable_sort(message->steps.begin(), message->steps.end(), is_taken_before);
  if (message->steps.size() > kMostSteps) {
    message->num_left_out = static_cast<std::int32_t>(message->steps.size() - kMostSteps);
    message->steps.resize(kMostSteps);
  }
}

void explain_all(const HypothesisTree& tree, std::int64_t first, explanation_t* message) {
  const HypothesisId best = tree.best().id;
  const TopologicalMap map = tree.map(best);
  const std::int64_t end = std::min<std::int64_t>(first + kVisitsAtOnce, tree.visit_count());
  for (std::int64_t number = first; number < end; ++number) {
    const VisitId visit{static_cast<std::int32_t>(number)};
    for (const HypothesisTree::Considered& one : tree.explanation(best, visit)) {
      if (one.is_taken) {
        message->steps.push_back(to_step(one, visit, best));
        message->steps.back().at_place = map.at_visit(visit).place.value;
        break;
      }
    }
  }
  message->next_visit = end < tree.visit_count() ? end : -1;
}

Status explain_parting(const HypothesisTree& tree,
                       const explain_request_t& request,
                       explanation_t* message) {
  std::optional<HypothesisId> found[2];
  const std::int64_t asked[2] = {request.hypothesis_a, request.hypothesis_b};
  for (const Hypothesis& live : tree.fringe()) {
    for (int i = 0; i < 2; ++i) {
      if (live.id.value == asked[i]) {
        found[i] = live.id;
      }
    }
  }
  for (int i = 0; i < 2; ++i) {
    if (!found[i]) {
      return Error{ErrorCode::kNotFound, "hypothesis " + text_of(asked[i]) + " is not live"};
    }
  }
  if (asked[0] == asked[1]) {
    return Error{ErrorCode::kInvalidValue,
                 "expected two hypotheses, got " + text_of(asked[0]) + " twice"};
  }
  const HypothesisTree::Parting parting = tree.parting(*found[0], *found[1]);
  message->hypothesis_id = asked[0];
  message->visit = parting.visit.value;
  message->log_odds = parting.log_odds;
  message->sentence = parting.sentence;
  message->steps = {to_step(parting.of_a, parting.visit, *found[0]),
                    to_step(parting.of_b, parting.visit, *found[1])};
  for (int i = 0; i < 2; ++i) {
    message->steps[static_cast<std::size_t>(i)].at_place =
        tree.map(*found[i]).at_visit(parting.visit).place.value;
  }
  return {};
}

Status explain(const HypothesisTree& tree,
               const explain_request_t& request,
               explanation_t* message) {
  if (!tree.is_started()) {
    return Error{ErrorCode::kNotFound, "there is no map yet"};
  }
  message->hypothesis_id = tree.best().id.value;
  if (request.kind == explain_request_t::PARTING) {
    return explain_parting(tree, request, message);
  }
  if (request.visit < 0 || request.visit >= tree.visit_count()) {
    return Error{ErrorCode::kNotFound, "visit: expected one in [0, " + text_of(tree.visit_count()) +
                                           "), got " + text_of(request.visit)};
  }
  if (request.kind == explain_request_t::VISIT) {
    explain_visit(tree, VisitId{static_cast<std::int32_t>(request.visit)}, message);
    return {};
  }
  if (request.kind == explain_request_t::OVERVIEW) {
    explain_all(tree, request.visit, message);
    return {};
  }
  return Error{ErrorCode::kInvalidValue, "kind: expected 0, 1 or 2, got " + text_of(request.kind)};
}

}  // namespace

cairn_lcm::assertion_report_t answer(const assert_request_t& request,
                                     TimePoint now,
                                     Engine* engine) {
  cairn_lcm::assertion_report_t message{};
  message.map_id = engine->map_id();
  Result<OperatorOrder> order = order_of(request, now, engine->service());
  if (!order) {
    message.result = to_result(request.header, order.error());
    return message;
  }
  const Result<AssertionReport> report = engine->take(*order);
  message.result = to_result(request.header, report ? Status() : report.error());
  if (report) {
    put(*report, *engine->service().state(), &message);
  }
  return message;
}

explanation_t answer(const explain_request_t& request, const Engine& engine) {
  explanation_t message{};
  message.map_id = engine.map_id();
  message.kind = request.kind;
  message.visit = request.visit;
  message.next_visit = -1;
  message.result = to_result(request.header, explain(engine.service().tree(), request, &message));
  message.num_steps = static_cast<std::int32_t>(message.steps.size());
  return message;
}

cairn_lcm::perception_t answer(const cairn_lcm::perception_request_t& request, Engine* engine) {
  cairn_lcm::perception_t answer{};
  Result<cairn_lcm::perceived_place_t> perceived = engine->perception(request.visit);
  answer.result = to_result(request.header, perceived ? Status() : Status(perceived.error()));
  answer.map_id = engine->map_id();
  if (perceived) {
    answer.perceived = *std::move(perceived);
  }
  return answer;
}

}  // namespace cairn
