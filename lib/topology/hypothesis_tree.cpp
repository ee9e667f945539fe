#include "topology/hypothesis_tree.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "base/check.hpp"

namespace cairn {
namespace {

MisreadingCosts costs_of(const TopologyOptions& options) {
  return {options.log_penalty_misread, options.log_penalty_missed_gateway,
          options.log_penalty_false_gateway};
}

WorkingMap::Rings rings_of(const TopologyOptions& options) {
  return options.planar || options.log_penalty_handle > 0.0 ? WorkingMap::Rings::kFaces
                                                            : WorkingMap::Rings::kOne;
}

/// Paths that a change adds; those that it joins count negative.
int paths_added(const StarCatalogue& stars, const MapChange& change) {
  switch (change.kind) {
    case MapChange::Kind::kLink:
      return -1;
    case MapChange::Kind::kPlace:
    case MapChange::Kind::kInsertPlace:
      return stars.fragment_count(change.star) - 1;
    case MapChange::Kind::kStrayPlace:
      return stars.fragment_count(change.star);
    default:
      return 0;
  }
}

}  // namespace

HypothesisTree::Engine::Engine(const TopologyOptions& chosen, Evidence given)
    : options(chosen),
      evidence(std::move(given)),
      experience(stars, costs_of(chosen)),
      records_visits(chosen.noisy_stars || evidence.same_place || chosen.max_repair_steps > 0),
      cursor(nodes, stars, rings_of(chosen), records_visits),
      successors(options, evidence, experience, stars, cursor.map()) {}

HypothesisTree::HypothesisTree(const TopologyOptions& options, Evidence evidence)
    : engine_(std::make_unique<Engine>(options, std::move(evidence))),
      waiting_(options.preference) {
  CAIRN_CHECK(validate(options).ok());
}

HypothesisTree::~HypothesisTree() = default;
HypothesisTree::HypothesisTree(HypothesisTree&&) noexcept = default;
HypothesisTree& HypothesisTree::operator=(HypothesisTree&&) noexcept = default;

Status HypothesisTree::start(const View& view) {
  if (is_started()) {
    return Error{ErrorCode::kOutOfOrder,
                 "start: expected once, the tree has " + std::to_string(visit_count()) + " visits"};
  }
  if (Status status = validate(view); !status.ok()) {
    return status;
  }
  if (view.visit.value != 0) {
    return Error{ErrorCode::kOutOfOrder,
                 "start: expected visit 0, got " + std::to_string(view.visit.value)};
  }
  engine_->experience.add({}, view, false);
  plant();
  return {};
}

Result<ExtendReport> HypothesisTree::extend(Action action,
                                            const View& view,
                                            const Deadline& is_time_up) {
  return arrive(action, view, false, is_time_up);
}

Result<ExtendReport> HypothesisTree::wake_up(const View& view, const Deadline& is_time_up) {
  return arrive({}, view, true, is_time_up);
}

Result<ExtendReport> HypothesisTree::arrive(Action action,
                                            const View& view,
                                            bool is_carried,
                                            const Deadline& is_time_up) {
  if (Status status = check(action, view, is_carried); !status.ok()) {
    return status.error();
  }
  engine_->experience.add(action, view, is_carried);
  return absorb_next(is_time_up);
}

Status HypothesisTree::check(Action action, const View& view, bool is_carried) const {
  if (!is_started()) {
    return Error{ErrorCode::kOutOfOrder, "a travel before the start: expected start() first"};
  }
  if (Status status = validate(view); !status.ok()) {
    return status;
  }
  if (view.visit.value != visit_count()) {
    return Error{ErrorCode::kOutOfOrder, "visit: expected " + std::to_string(visit_count()) +
                                             ", the next one, got " +
                                             std::to_string(view.visit.value)};
  }
  const int gateways = gateway_count(engine_->experience.view(last_visit()).star);
  if (!is_carried && (action.turn < 0 || action.turn >= gateways)) {
    return Error{ErrorCode::kInvalidValue, "turn: expected a gateway of the place before, in [0, " +
                                               std::to_string(gateways) + "), got " +
                                               std::to_string(action.turn)};
  }
  return {};
}

/// The map of the first visit.
void HypothesisTree::plant() {
  Engine& engine = *engine_;
  const ReadingMatcher& first = engine.experience.matcher(VisitId{0});
  TreeNode root;
  root.change = {MapChange::Kind::kNothing, first.star_id(0), VisitId{0}, kNoGateway, kNoGateway};
  root.visit = VisitId{0};
  root.position = first.view().arrival_gateway;
  root_ = engine.nodes.add_root(root);
  engine.nodes.hold(root_);
  engine.cursor.start(root_);
  live_ = {first_leaf()};
  node_count_ = 1;
  maps_built_ = 1;
  baseline_log_posterior_ = {0.0};
  log_bound_ = {0.0};
  ExtendReport unreported;
  lay_out(unreported);
}

/// The visit after the last one that the live hypotheses explain.
ExtendReport HypothesisTree::absorb_next(const Deadline& is_time_up) {
  Engine& engine = *engine_;
  ExtendReport report;
  report.visit = VisitId{static_cast<std::int32_t>(baseline_log_posterior_.size())};
  auto refuted_before = engine.successors.refuted();
  std::int64_t contradicted_before = engine.successors.links_contradicted();
  candidates_.clear();
  siblings_.clear();
  amendments_.clear();
  expand_live(is_time_up, report);
  if (const double surprise = surprise_of_best();
      engine.options.noisy_stars && surprise > engine.options.log_penalty_break) {
    engine.successors.allow_rejoining(report.visit);
    refuted_before = engine.successors.refuted();
    contradicted_before = engine.successors.links_contradicted();
    report = ExtendReport();
    report.visit = VisitId{static_cast<std::int32_t>(baseline_log_posterior_.size())};
    candidates_.clear();
    siblings_.clear();
    amendments_.clear();
    expand_live(is_time_up, report);
  }
  for (const Leaf& leaf : not_looked_at_) {
    defer(leaf, report);
  }
  if (candidates_.empty()) {
    repair(report);
  } else if (std::all_of(candidates_.begin(), candidates_.end(), [](const Candidate& next) {
               return next.kind == StepKind::kContradiction;
             })) {
    report.repair.emplace();
    publish_blame(report);
  }
  keep_best(report);
  log_bound_.push_back(log_bound_.back() + most_gained_at(report.visit));
  revive(is_time_up, report);
  lay_out(report);
  make_room(report);
  advance_root();
  for (std::size_t reason = 0; reason < refuted_before.size(); ++reason) {
    report.refuted[reason] = engine.successors.refuted()[reason] - refuted_before[reason];
  }
  report.links_contradicted = engine.successors.links_contradicted() - contradicted_before;
  node_count_ += report.nodes_added();
  maps_built_ += report.count(StepKind::kClosure) + report.count(StepKind::kNewPlace);
  report.leaves = live_count();
  report.waiting = waiting_count();
  report.settled_through = settled_through();
  if (!given_up_) {
    given_up_ = report.guarantee_given_up;
  }
  return report;
}

/// No step at this visit can have a greater log-likelihood.
double HypothesisTree::most_gained_at(VisitId visit) const {
  const Engine& engine = *engine_;
  if (!engine.evidence.same_place) {
    return 0.0;
  }
  const double most = engine.evidence.same_place_bound ? engine.evidence.same_place_bound(visit)
                                                       : engine.options.max_log_evidence;
  return std::max(most, 0.0) * most_independent_answers(engine.options);
}

void HypothesisTree::expand_live(const Deadline& is_time_up, ExtendReport& report) {
  not_looked_at_.clear();
  std::vector<std::size_t> order(live_.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  if (is_time_up) {  // Then the best come first, not those that lie together.
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return comes_before(rank_of(live_[a]), rank_of(live_[b]), engine_->options.preference);
    });
  }
  for (const std::size_t index : order) {
    // The first one is always looked at, so that time alone cannot refute all.
    if (is_time_up && index != order.front() && is_time_up()) {
      not_looked_at_.push_back(live_[index]);
    } else {
      expand(live_[index], report);
    }
  }
}

Situation HypothesisTree::situation_of(const Leaf& leaf) const {
  const VisitId next{leaf.visit.value + 1};
  return {leaf.position, next, order_for(leaf, next)};
}

void HypothesisTree::expand(const Leaf& leaf, ExtendReport& report) {
  Engine& engine = *engine_;
  engine.cursor.at(leaf.node);
  const Situation situation = situation_of(leaf);
  engine.successors.list(situation, Successors::Detail::kPossible, alternatives_);
  Siblings siblings{leaf, candidates_.size(), 0};
  for (const Alternative& alternative : alternatives_) {
    ++report.steps[static_cast<std::size_t>(alternative.kind)];
    candidates_.push_back(candidate_of(leaf, alternative));
  }
  if (candidates_.size() == siblings.first && engine.options.noisy_stars) {
    ++report.breaks;
    ++report.steps[static_cast<std::size_t>(StepKind::kContradiction)];
    candidates_.push_back(candidate_of(leaf, engine.successors.unexplained(situation)));
  }
  siblings.end = candidates_.size();
  if (leaf.tried > 0) {
    skip_tried(siblings);
    siblings.end = candidates_.size();
  }
  siblings_.push_back(siblings);
}

HypothesisTree::Candidate HypothesisTree::candidate_of(const Leaf& leaf,
                                                       const Alternative& alternative) {
  const Engine& engine = *engine_;
  Candidate next;
  next.leaf = leaf;
  next.leaf.visit.value += 1;
  next.leaf.tried = 0;
  next.leaf.untried = 0;
  next.leaf.log_untried = 0.0;
  next.leaf.position = alternative.position;
  next.leaf.log_steps += alternative.log_likelihood;
  next.leaf.contradictions += is_contradiction(alternative.kind) ? 1 : 0;
  next.leaf.place_count += adds_place(alternative.change) ? 1 : 0;
  next.paths_added = paths_added(engine.stars, alternative.change);
  next.kind = alternative.kind;
  next.misreading = alternative.misreading;
  next.log_likelihood = alternative.log_likelihood;
  next.change = alternative.change;
  next.is_departure_open = alternative.is_departure_open;
  if (alternative.amendment.kind != MapChange::Kind::kNothing) {
    const WorkingMap& map = engine.cursor.map();
    const PlaceId place = map.place_of(alternative.amendment.departure);
    next.paths_added += engine.stars.fragment_count(alternative.amendment.star) -
                        engine.stars.fragment_count(map.star(place));
    next.amendment = static_cast<std::int32_t>(amendments_.size());
    amendments_.push_back(alternative.amendment);
  }
  next.leaf.path_count += next.paths_added;
  return next;
}

// What only one thing below needs is shared by all leaves.
void HypothesisTree::advance_root() {
  const TreeNodes& nodes = engine_->nodes;
  if (nodes[root_].references > 1 || live_.front().node == root_) {
    return;
  }
  for (const NodeIndex next : nodes.branch(live_.front().node, root_)) {
    if (nodes[root_].references > 1) {
      break;
    }
    root_ = next;
  }
}

VisitId HypothesisTree::settled_through() const {
  return live_.size() == 1 && waiting_.empty() ? live_.front().visit : engine_->nodes[root_].visit;
}

}  // namespace cairn
