#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "topology/deferred.hpp"
#include "topology/evidence.hpp"
#include "topology/extend_report.hpp"
#include "topology/hypothesis.hpp"
#include "topology/leaf.hpp"
#include "topology/lineage.hpp"
#include "topology/operator_assertions.hpp"
#include "topology/successors.hpp"
#include "topology/topology_options.hpp"
#include "topology/tree_nodes.hpp"

namespace cairn {

/// The tree of topological maps: all maps that are consistent with the robot's experience, grown by
/// one arrival at a time.
///
/// Guarantee: without evidence and as long as nothing was given up, live and waiting hypotheses are
/// exactly the maps that agree with every view and violate neither the axioms nor, if assumed,
/// planarity and region-consistency. No two of them are the same map: the gateway of arrival and
/// the turn tell where the robot was before, so equal maps have equal pasts. As long as none waits,
/// the live ones are all. The report of each arrival says when this is given up.
///
/// A map is stored as its difference to another: a parent and one step. The tree keeps one working
/// map and moves it from leaf to leaf.
///
/// At most max_hypotheses are live. The others wait; whenever one of them comes to be better than a
/// live one, or when all live ones are refuted, it is brought up to date and takes its place. When
/// nothing that waits explains an arrival either, a repair search looks for the observations whose
/// misreading explains it at the least cost; failing that, the best hypotheses go on with the
/// arrival left unexplained, so that the tree is never empty.
///
/// Source: Fig. 4 of Kuipers et al., ICRA 2004; Fig. 2 of Savelli and Kuipers, IROS 2004.
/// Reproducible: same calls, same ids in the same order (unless a deadline intervenes).
/// Not for several threads at a time, constant members included: they move the working map.
class HypothesisTree {
 public:
  using PlaceClaim = cairn::PlaceClaim;
  using NodeView = HypothesisNode;
  using Considered = cairn::Considered;
  using Parting = cairn::Parting;
  using Fate = cairn::Fate;

  /// Whether an arrival has taken its time; the leaves that were not looked at then wait.
  using Deadline = std::function<bool()>;

  /// @pre validate(options).ok()
  explicit HypothesisTree(const TopologyOptions& options, Evidence evidence = {});
  ~HypothesisTree();
  HypothesisTree(HypothesisTree&&) noexcept;
  HypothesisTree& operator=(HypothesisTree&&) noexcept;

  /// The first place. An error, and nothing changed, if the tree is started, the view is invalid or
  /// its visit is not 0.
  Status start(const View& view);
  [[nodiscard]] bool is_started() const { return !live_.empty(); }

  /// A travel and what the robot saw at its end. An error, and nothing changed, if the tree is not
  /// started, the view is invalid, its visit is not the next one, or the turn is not in
  /// [0, number of gateways of the view before).
  Result<ExtendReport> extend(Action action, const View& view, const Deadline& is_time_up = {});
  /// The robot finds itself at a place without having travelled there: switched on in a known map,
  /// or carried. Every hypothesis goes on at each dstate whose view agrees, and elsewhere.
  /// An error as for extend().
  Result<ExtendReport> wake_up(const View& view, const Deadline& is_time_up = {});

  // What is known.

  /// The live hypotheses, best first.
  [[nodiscard]] std::vector<Hypothesis> fringe() const;
  /// @pre started
  [[nodiscard]] Hypothesis best() const;
  [[nodiscard]] std::int64_t live_count() const { return static_cast<std::int64_t>(live_.size()); }
  [[nodiscard]] std::int64_t waiting_count() const { return waiting_.count(); }
  /// For each hypothesis of the fringe its share of the live ones' posterior: they sum to 1.
  [[nodiscard]] std::vector<double> probabilities() const;
  /// How far the best live hypothesis is ahead of everything that waits or was given up, however
  /// well that may do when brought up to date: log-posterior difference, infinite if nothing waits.
  /// Positive: the best one is proven to be the best. Without a bound of the evidence it is loose.
  [[nodiscard]] double proven_gap() const;
  /// The simplest closed maps: of the live ones without pending gateways that are
  /// region-consistent, those with fewest paths, then places. Empty when there are none.
  [[nodiscard]] std::vector<HypothesisId> simplest_closed() const;
  /// The place where the robot is, named by the visit that made it known, once the odds of all live
  /// hypotheses that say so against the others reach claim_odds. The robot may always be at a place
  /// that it just found.
  [[nodiscard]] std::optional<PlaceClaim> claimed_place() const;

  /// @pre the hypothesis is live
  [[nodiscard]] TopologicalMap map(HypothesisId live) const;
  /// Of all live hypotheses, best first; no more than one map is held at a time.
  void for_each_map(
      const std::function<void(const Hypothesis&, const TopologicalMap&)>& visit) const;
  /// What this hypothesis' map was after an earlier visit.
  /// @pre the hypothesis is live; 0 <= visit < visit_count()
  [[nodiscard]] TopologicalMap map_at(HypothesisId live, VisitId visit) const;

  /// The map from which this one grew; none for the first. @pre is_known(id)
  [[nodiscard]] HypothesisId parent(HypothesisId id) const;
  /// The visit at which it grew from its parent. @pre is_known(id)
  [[nodiscard]] VisitId visit(HypothesisId id) const;
  [[nodiscard]] StepKind step(HypothesisId id) const;
  /// Whether it is live, waiting, or an ancestor of one that is.
  [[nodiscard]] bool is_known(HypothesisId id) const { return find_node(id) != kNoNode; }

  /// All nodes that are needed, parents before children.
  [[nodiscard]] std::vector<NodeView> nodes() const;

  // Why: explanation.cpp.

  /// Everything the visit might have meant to this hypothesis, and what decided.
  /// @pre as map_at()
  [[nodiscard]] std::vector<Considered> explanation(HypothesisId live, VisitId visit) const;

  /// @pre both are live and not the same
  [[nodiscard]] Parting parting(HypothesisId a, HypothesisId b) const;

  /// @param alternative position in explanation(live, visit)
  /// @pre as map_at(); 0 <= alternative < its size
  [[nodiscard]] Fate why_not(HypothesisId live, VisitId visit, std::size_t alternative) const;

  // What an operator says: assertions.cpp.

  /// Whether assert_places() would take this up.
  [[nodiscard]] Status check_places(VisitId a, VisitId b, bool is_same) const;
  /// Whether retract() would take this back.
  [[nodiscard]] Status check_retraction(int assertion) const {
    return assertions_.check_retraction(assertion);
  }
  /// The two visits were, or were not, to the same place. The tree is grown anew from the
  /// experience under all assertions in force. An error, and nothing changed, if the visits are not
  /// known or are the same one, or the assertion contradicts those in force.
  Result<AssertionReport> assert_places(VisitId a, VisitId b, bool is_same, std::string who);
  /// Takes an assertion back. An error if there is none by that number in force.
  Result<AssertionReport> retract(int assertion, std::string who);
  /// All that was ever said, in order.
  [[nodiscard]] const std::vector<OperatorAssertion>& assertions() const {
    return assertions_.all();
  }

  // Figures.

  /// The first time, if ever.
  [[nodiscard]] const std::optional<GuaranteeGivenUp>& guarantee_given_up() const {
    return given_up_;
  }
  /// All hypotheses agree on everything up to this visit.
  [[nodiscard]] VisitId settled_through() const;
  /// Root and all consistent successors so far: "search-tree nodes" of Savelli and Kuipers, Fig. 4.
  [[nodiscard]] std::int64_t node_count() const { return node_count_; }
  /// Root, closures and new places: "maps ever built".
  [[nodiscard]] std::int64_t maps_built() const { return maps_built_; }
  [[nodiscard]] int visit_count() const { return engine_->experience.size(); }
  /// Memory in use. What was freed is used again before more is taken.
  struct Memory {
    std::size_t nodes = 0;  ///< Stored.
    std::size_t bytes_of_nodes = 0;
    std::size_t bytes_held_for_nodes = 0;  ///< Room for new ones included.
    std::size_t bytes_of_leaves = 0;       ///< Live and waiting.
    std::size_t bytes_of_experience = 0;
    std::size_t bytes_of_map = 0;
  };
  [[nodiscard]] Memory memory() const;

 private:
  /// A successor that is not built yet.
  struct Candidate {
    Leaf leaf;  ///< As it will be, but still on its parent's node.
    StepKind kind = StepKind::kStart;
    Misreading misreading = Misreading::kNone;
    double log_likelihood = 0.0;
    MapChange change;
    std::int32_t amendment = -1;  ///< Position in amendments_.
    std::int32_t paths_added = 0;
    bool is_departure_open = false;  ///< As Alternative::is_departure_open.
  };

  /// The successors of one leaf among the candidates.
  struct Siblings {
    Leaf parent;
    std::size_t first = 0;
    std::size_t end = 0;
  };

  Result<ExtendReport> arrive(Action action,
                              const View& view,
                              bool is_carried,
                              const Deadline& is_time_up);
  [[nodiscard]] Status check(Action action, const View& view, bool is_carried) const;
  void plant();
  ExtendReport absorb_next(const Deadline& is_time_up);
  std::optional<Repair> regrow();
  AssertionReport regrow_and_compare();
  [[nodiscard]] std::vector<VisitId> places_by_visit(const Leaf& leaf) const;
  void expand(const Leaf& leaf, ExtendReport& report);
  [[nodiscard]] double most_gained_at(VisitId visit) const;
  void expand_live(const Deadline& is_time_up, ExtendReport& report);
  [[nodiscard]] Candidate candidate_of(const Leaf& leaf, const Alternative& alternative);
  [[nodiscard]] Situation situation_of(const Leaf& leaf) const;
  [[nodiscard]] PlaceOrder order_for(const Leaf& leaf, VisitId visit) const;
  [[nodiscard]] PlaceOrder order_by_places(
      VisitId visit, const std::function<std::optional<PlaceId>(VisitId)>& place_of) const;
  [[nodiscard]] std::optional<PlaceId> place_of_visit(const Leaf& leaf, VisitId visit) const;

  // hypothesis_budget.cpp
  void keep_best(ExtendReport& report);
  [[nodiscard]] Leaf grow(const Candidate& candidate);
  void defer(const Leaf& leaf, ExtendReport& report);
  void defer_untried(const Siblings& siblings,
                     const std::vector<bool>& waits,
                     ExtendReport& report);
  [[nodiscard]] std::vector<bool> those_that_wait() const;
  [[nodiscard]] std::vector<NodeIndex> forks_from(NodeIndex leaf) const;
  [[nodiscard]] double surprise_of_best();
  [[nodiscard]] Rank rank_of_candidate(std::size_t index) const;
  [[nodiscard]] std::vector<std::size_t> best_first(const Siblings& siblings) const;
  void skip_tried(const Siblings& siblings);
  [[nodiscard]] bool is_wanted(const Rank& waiting) const;
  void revive(const Deadline& is_time_up, ExtendReport& report);
  void bring_forward(const Leaf& leaf, ExtendReport& report);
  void make_room(ExtendReport& report);
  [[nodiscard]] std::vector<Leaf> take_worst_half_of_live();
  void give_up(std::vector<Leaf> leaves, ExtendReport& report);
  void repair(ExtendReport& report);
  void search_among(DeferredLeaves& leaves, bool all_wanted, ExtendReport& report);
  [[nodiscard]] Leaf first_leaf() const;
  [[nodiscard]] const Candidate& best_candidate() const;
  void publish_blame(ExtendReport& report);
  void go_on_unexplained(ExtendReport& report);
  [[nodiscard]] Rank rank_of(const Leaf& leaf) const;
  [[nodiscard]] Rank waiting_rank_of(const Leaf& leaf) const;
  [[nodiscard]] Rank waiting_rank(Rank rank, VisitId visit) const;
  [[nodiscard]] Rank baseline_rank(Rank rank, VisitId visit) const;
  [[nodiscard]] double most_likely(const Leaf& waiting) const;
  [[nodiscard]] std::vector<Blame> blamed_by(const Candidate& candidate) const;

  void lay_out(ExtendReport& report);
  void advance_root();
  [[nodiscard]] Hypothesis hypothesis_of(const Leaf& leaf) const;
  [[nodiscard]] NodeIndex find_node(HypothesisId id) const;
  [[nodiscard]] const Leaf& leaf_of(HypothesisId id) const;
  [[nodiscard]] TopologicalMap map_of(const Leaf& leaf, int visits) const;
  [[nodiscard]] TopologicalMap assembled(const WorkingMap& map,
                                         const std::vector<GatewayRef>& departures) const;
  [[nodiscard]] Lineage lineage_of(const Leaf& leaf) const;
  [[nodiscard]] Leaf before(const Leaf& leaf, VisitId visit) const;
  [[nodiscard]] std::vector<Leaf> ranked() const;
  [[nodiscard]] HypothesisId parent_of(const TreeNode& node) const;

  [[nodiscard]] std::vector<Alternative> alternatives_at(const Leaf& earlier) const;
  [[nodiscard]] bool has_taken(const Leaf& leaf,
                               VisitId visit,
                               const Alternative& alternative) const;
  [[nodiscard]] Considered considered(const Alternative& alternative, VisitId visit) const;
  [[nodiscard]] Considered taken_at(const Leaf& leaf, VisitId visit) const;
  [[nodiscard]] double log_steps_before(const Leaf& leaf, VisitId visit) const;
  [[nodiscard]] bool leaves_node(const Leaf& leaf, VisitId visit) const;
  [[nodiscard]] VisitId last_visit() const { return VisitId{engine_->experience.size() - 1}; }

  /// What the parts below point to stays where it is when the tree is moved.
  struct Engine {
    Engine(const TopologyOptions& chosen, Evidence given);

    TopologyOptions options;
    Evidence evidence;
    StarCatalogue stars;
    ExperienceLog experience;
    TreeNodes nodes;
    bool records_visits;  // Each arrival leaves a node, so that evidence of all visits counts.
    MapCursor cursor;
    Successors successors;
    std::shared_ptr<const StarCatalogue> shared_stars;  // For maps that are handed out.
  };
  std::unique_ptr<Engine> engine_;
  std::vector<Leaf> live_;  // Children where their parent was: in the order of the tree.
  DeferredLeaves waiting_;
  NodeIndex root_ = kNoNode;  // The deepest one that all leaves stand on or below.
  OperatorAssertions assertions_;
  // By visit: what the right map may have come to. It gains what the best live one gains, loses no
  // more than by a new place, and gains what evidence says that the best one misses.
  std::vector<double> baseline_log_posterior_;
  std::vector<double> log_bound_;  // By visit: what all steps up to it may have gained.
  std::int64_t node_count_ = 0;
  std::int64_t maps_built_ = 0;
  std::optional<GuaranteeGivenUp> given_up_;
  double log_given_up_ = -std::numeric_limits<double>::infinity();  // Bound, as of visit 0.

  std::vector<Candidate> candidates_;  // Of the arrival at hand.
  std::vector<Siblings> siblings_;     // They follow each other in the candidates.
  std::vector<Leaf> not_looked_at_;    // Of the arrival at hand, for want of time.
  std::vector<MapChange> amendments_;
  std::vector<NodeIndex> searched_;        // On which candidates stand that repair found.
  std::vector<Alternative> alternatives_;  // Reused.
};

}  // namespace cairn
