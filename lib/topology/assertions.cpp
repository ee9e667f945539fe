// What an operator says, and what it does to the tree.

#include <algorithm>
#include <utility>

#include "base/check.hpp"
#include "topology/hypothesis_tree.hpp"
#include "topology/lineage.hpp"

namespace cairn {

Status HypothesisTree::check_places(VisitId a, VisitId b, bool is_same) const {
  for (const VisitId visit : {a, b}) {
    if (!visit.is_valid() || visit.value >= visit_count()) {
      return Error{ErrorCode::kNotFound, "visit: expected one in [0, " +
                                             std::to_string(visit_count()) + "), got " +
                                             std::to_string(visit.value)};
    }
  }
  if (a == b) {
    return Error{ErrorCode::kInvalidValue,
                 "expected two visits, got visit " + std::to_string(a.value) + " twice"};
  }
  OperatorAssertion assertion;
  assertion.a = a;
  assertion.b = b;
  assertion.is_same = is_same;
  return assertions_.check(std::move(assertion));
}

Result<AssertionReport> HypothesisTree::assert_places(VisitId a,
                                                      VisitId b,
                                                      bool is_same,
                                                      std::string who) {
  if (Status status = check_places(a, b, is_same); !status.ok()) {
    return status.error();
  }
  OperatorAssertion assertion;
  assertion.a = a;
  assertion.b = b;
  assertion.is_same = is_same;
  assertion.who = std::move(who);
  assertion.made_after_visits = visit_count();
  const Result<int> number = assertions_.add(std::move(assertion));
  if (!number) {
    return number.error();
  }
  AssertionReport report = regrow_and_compare();
  report.assertion = *number;
  return report;
}

Result<AssertionReport> HypothesisTree::retract(int assertion, std::string who) {
  if (Status status = assertions_.retract(assertion, visit_count(), std::move(who)); !status.ok()) {
    return status.error();
  }
  AssertionReport report = regrow_and_compare();
  report.assertion = assertion;
  return report;
}

/// By visit, the visit that made its place known.
std::vector<VisitId> HypothesisTree::places_by_visit(const Leaf& leaf) const {
  Lineage lineage = lineage_of(leaf);
  while (lineage.visit() < leaf.visit) {
    lineage.advance();
  }
  std::vector<VisitId> places;
  for (const GatewayRef& arrival : lineage.arrivals()) {
    places.push_back(lineage.map().first_visit(arrival.place));
  }
  return places;
}

AssertionReport HypothesisTree::regrow_and_compare() {
  AssertionReport report;
  const std::vector<VisitId> earlier = places_by_visit(leaf_of(best().id));
  report.log_posterior_before = best().log_posterior();
  report.repair = regrow();
  const std::vector<VisitId> later = places_by_visit(leaf_of(best().id));
  report.best = best().id;
  report.log_posterior_after = best().log_posterior();
  for (std::size_t visit = 0; visit < later.size(); ++visit) {
    if (earlier[visit] != later[visit]) {
      report.moved.push_back(
          {VisitId{static_cast<std::int32_t>(visit)}, earlier[visit], later[visit]});
    }
  }
  if (report.moved.empty()) {
    report.sentence = "the best map stays as it was";
  } else if (const std::string first = "visit " + std::to_string(report.moved[0].visit.value);
             report.moved.size() == 1) {
    report.sentence = first + " is at another place now";
  } else {
    report.sentence = std::to_string(report.moved.size()) +
                      " visits are at other places now, the first is " + first;
  }
  report.sentence += "; log-posterior " + std::to_string(report.log_posterior_before) + " -> " +
                     std::to_string(report.log_posterior_after);
  return report;
}

/// From the first visit on, under the assertions in force. Ids go on: none is given twice.
/// @return the last repair, if there was any
std::optional<Repair> HypothesisTree::regrow() {
  const int visits = engine_->experience.size();
  const std::int32_t next_id = engine_->nodes.next_id();
  auto engine = std::make_unique<Engine>(engine_->options, std::move(engine_->evidence));
  engine->nodes.skip_ids(next_id);
  for (VisitId visit{0}; visit.value < visits; ++visit.value) {
    View view = engine_->experience.view(visit);
    view.visit = visit;
    engine->experience.add(engine_->experience.action(visit), view,
                           engine_->experience.is_carried(visit));
  }
  engine_ = std::move(engine);
  waiting_ = DeferredLeaves(engine_->options.preference);
  given_up_.reset();
  log_given_up_ = -std::numeric_limits<double>::infinity();
  std::optional<Repair> repair;
  plant();
  while (static_cast<int>(baseline_log_posterior_.size()) < visits) {
    if (const ExtendReport report = absorb_next({}); report.repair) {
      repair = report.repair;
    }
  }
  return repair;
}

PlaceOrder HypothesisTree::order_for(const Leaf& leaf, VisitId visit) const {
  return order_by_places(visit, [&](VisitId other) { return place_of_visit(leaf, other); });
}

/// What operators say of a visit, where earlier visits were to these places.
PlaceOrder HypothesisTree::order_by_places(
    VisitId visit, const std::function<std::optional<PlaceId>(VisitId)>& place_of) const {
  PlaceOrder order;
  if (!assertions_.is_any_in_force() || !assertions_.names(visit)) {
    return order;
  }
  // Every earlier visit of a chain obeyed already, so all of them are at one place.
  for (const VisitId other : assertions_.same_as(visit)) {
    if (other < visit) {
      order.must_be = place_of(other);
    }
  }
  for (const VisitId other : assertions_.different_from(visit)) {
    const std::optional<PlaceId> place = other < visit ? place_of(other) : std::nullopt;
    if (place) {
      order.must_not_be.push_back(*place);
    }
  }
  return order;
}

/// Visits that assertions name leave a node, even where a known link was followed.
std::optional<PlaceId> HypothesisTree::place_of_visit(const Leaf& leaf, VisitId visit) const {
  const TreeNodes& nodes = engine_->nodes;
  for (NodeIndex node = leaf.node; node != kNoNode; node = nodes[node].parent) {
    if (nodes[node].visit == visit && !nodes[node].is_part) {
      return engine_->cursor.map().place_of(nodes[node].position);
    }
  }
  return std::nullopt;
}

}  // namespace cairn
