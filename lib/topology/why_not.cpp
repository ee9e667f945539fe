// What would have become of a map that was not kept.

#include <algorithm>
#include <functional>

#include "base/check.hpp"
#include "topology/hypothesis_tree.hpp"
#include "topology/lineage.hpp"

namespace cairn {
namespace {

/// A map that is carried on by any steps that explain what came, the likeliest first.
class WhatIf {
 public:
  /// What operators say of a visit to this map.
  using Orders = std::function<PlaceOrder(VisitId, const WorkingMap&)>;

  WhatIf(const TopologyOptions& options,
         const Evidence& evidence,
         const ExperienceLog& experience,
         StarCatalogue& stars,
         Orders orders,
         Lineage lineage)
      : orders_(std::move(orders)),
        lineage_(std::move(lineage)),
        position_(lineage_.position()),
        successors_(options, evidence, experience, stars, lineage_.map()) {}

  enum class Outcome { kExplained, kRefuted, kUnknown };

  void take(const Alternative& step, VisitId visit) {
    lineage_.map().apply(step.amendment);
    lineage_.map().apply(step.change);
    lineage_.map().record_visit(step.position, visit);
    position_ = step.position;
    log_likelihood_ += step.log_likelihood;
  }
  /// The visits from `first` to `last`, both included. Depth first.
  Outcome explain(VisitId first, VisitId last, int max_steps) {
    std::vector<Level> levels;
    VisitId next = first;
    for (int step = 0; next <= last && step < max_steps; ++step) {
      levels.push_back(level_of(next));
      while (!levels.empty() && levels.back().untried.empty()) {
        levels.pop_back();
        if (!levels.empty()) {
          take_back(levels.back());
        }
      }
      if (levels.empty()) {
        return Outcome::kRefuted;
      }
      Level& level = levels.back();
      level.taken = level.untried.back();
      level.untried.pop_back();
      next.value = first.value + static_cast<std::int32_t>(levels.size());
      take(level.taken, VisitId{next.value - 1});
    }
    return next > last ? Outcome::kExplained : Outcome::kUnknown;
  }
  [[nodiscard]] const WorkingMap& map() { return lineage_.map(); }
  [[nodiscard]] double log_likelihood() const { return log_likelihood_; }
  /// The latest visit that could not be explained, and what spoke against its first alternative.
  [[nodiscard]] VisitId latest() const { return latest_; }
  [[nodiscard]] Refutation obstacle() const { return obstacle_; }

 private:
  struct Level {
    std::vector<Alternative> untried;  ///< The likeliest last.
    Alternative taken;
    GatewayIndex position = kNoGateway;  ///< Before the visit.
    double log_likelihood = 0.0;
  };

  Level level_of(VisitId visit) {
    Level level;
    level.position = position_;
    level.log_likelihood = log_likelihood_;
    successors_.list({position_, visit, orders_(visit, lineage_.map())}, Successors::Detail::kAll,
                     all_);
    for (auto one = all_.rbegin(); one != all_.rend(); ++one) {
      if (one->refuted_by == Refutation::kNone) {
        level.untried.push_back(*one);
      }
    }
    std::stable_sort(level.untried.begin(), level.untried.end(),
                     [](const Alternative& a, const Alternative& b) {
                       return a.log_likelihood < b.log_likelihood;
                     });
    if (level.untried.empty() && visit > latest_) {
      latest_ = visit;
      obstacle_ = all_.empty() ? Refutation::kOtherView : all_.front().refuted_by;
    }
    return level;
  }
  void take_back(const Level& level) {
    lineage_.map().forget_last_visit(lineage_.map().place_of(position_));
    lineage_.map().undo(level.taken.change);
    lineage_.map().undo(level.taken.amendment);
    position_ = level.position;
    log_likelihood_ = level.log_likelihood;
  }

  Orders orders_;
  Lineage lineage_;
  GatewayIndex position_;
  Successors successors_;
  std::vector<Alternative> all_;  // Reused.
  VisitId latest_;
  Refutation obstacle_ = Refutation::kNone;
  double log_likelihood_ = 0.0;
};

/// Where the map says that the robot was.
std::optional<PlaceId> place_in(const WorkingMap& map, VisitId visit) {
  for (PlaceId place{0}; place.value < map.place_count(); ++place.value) {
    for (std::int32_t at = map.latest_record(place); at >= 0; at = map.record(at).previous) {
      if (map.record(at).visit == visit) {
        return place;
      }
    }
  }
  return std::nullopt;
}

}  // namespace

HypothesisTree::Fate HypothesisTree::why_not(HypothesisId live,
                                             VisitId visit,
                                             std::size_t alternative) const {
  CAIRN_CHECK(visit.value > 0 && visit.value < visit_count());
  Engine& engine = *engine_;
  const Leaf& leaf = leaf_of(live);
  const Leaf earlier = before(leaf, visit);
  const std::vector<Alternative> all = alternatives_at(earlier);
  Fate fate;
  fate.visit = visit;
  if (alternative >= all.size() || has_taken(leaf, visit, all[alternative])) {
    fate.sentence = "this is what the hypothesis took the visit for";
    return fate;
  }
  const Considered asked = considered(all[alternative], visit);
  const auto refute = [&](VisitId at, Refutation reason) {
    fate.is_refuted = true;
    fate.visit = at;
    fate.reason = reason;
    fate.log_odds = -std::numeric_limits<double>::infinity();
    fate.sentence = asked.sentence;
    if (at != visit) {
      fate.sentence += "; refuted later, at visit " + std::to_string(at.value) + ": " +
                       std::string(reason_of(reason));
    }
    return fate;
  };
  if (asked.refuted_by != Refutation::kNone) {
    return refute(visit, asked.refuted_by);
  }
  Lineage lineage = lineage_of(leaf);
  double log_taken = leaf.log_steps;
  while (lineage.visit().value + 1 < visit.value) {
    lineage.advance();
  }
  const auto orders = [&](VisitId at, const WorkingMap& map) {
    return order_by_places(at, [&](VisitId earlier_visit) { return place_in(map, earlier_visit); });
  };
  WhatIf other(engine.options, engine.evidence, engine.experience, engine.stars, orders,
               std::move(lineage));
  other.take(all[alternative], visit);
  const auto outcome =
      other.explain(VisitId{visit.value + 1}, last_visit(), engine.options.max_repair_steps);
  if (outcome == WhatIf::Outcome::kRefuted) {
    return refute(other.latest(), other.obstacle());
  }
  if (outcome == WhatIf::Outcome::kUnknown) {
    fate.visit = last_visit();
    fate.sentence = asked.sentence +
                    "; whether it explains everything since was not found out in " +
                    std::to_string(engine.options.max_repair_steps) + " steps";
    return fate;
  }
  log_taken -= log_steps_before(leaf, visit);
  fate.visit = last_visit();
  fate.log_odds = other.log_likelihood() - log_taken;
  if (engine.evidence.layout) {
    const std::vector<GatewayRef> not_told(static_cast<std::size_t>(visit_count()));
    const double log_layout = engine.evidence.layout(assembled(other.map(), not_told));
    if (log_layout == -std::numeric_limits<double>::infinity()) {
      return refute(last_visit(), Refutation::kEvidence);
    }
    fate.log_odds += log_layout - leaf.log_layout;
  }
  fate.sentence = asked.sentence + "; it explains everything since, with log-odds " +
                  std::to_string(fate.log_odds) + " against the live hypothesis";
  return fate;
}

/// What the steps of a hypothesis up to a visit, that visit not included, sum up to.
double HypothesisTree::log_steps_before(const Leaf& leaf, VisitId visit) const {
  Engine& engine = *engine_;
  Lineage lineage = lineage_of(leaf);
  Successors successors(engine.options, engine.evidence, engine.experience, engine.stars,
                        lineage.map());
  double since = 0.0;
  std::vector<Alternative> possible;
  const TreeNodes& nodes = engine.nodes;
  for (NodeIndex node = leaf.node; node != kNoNode; node = nodes[node].parent) {
    if (nodes[node].visit >= visit && !nodes[node].is_part) {
      since += static_cast<double>(nodes[node].log_likelihood);
    }
  }
  // Known links leave no node: ask for them again.
  while (lineage.visit().value + 1 < visit_count()) {
    const VisitId next{lineage.visit().value + 1};
    if (next >= visit && !leaves_node(leaf, next)) {
      successors.list({lineage.position(), next, {}}, Successors::Detail::kPossible, possible);
      for (const Alternative& step : possible) {
        since += step.kind == StepKind::kKnownLink ? step.log_likelihood : 0.0;
      }
    }
    lineage.advance();
  }
  return leaf.log_steps - since;
}

bool HypothesisTree::leaves_node(const Leaf& leaf, VisitId visit) const {
  const TreeNodes& nodes = engine_->nodes;
  for (NodeIndex node = leaf.node; node != kNoNode; node = nodes[node].parent) {
    if (nodes[node].visit == visit) {
      return true;
    }
  }
  return false;
}

}  // namespace cairn
