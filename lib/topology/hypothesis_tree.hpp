#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "topology/evidence.hpp"
#include "topology/extend_report.hpp"
#include "topology/successors.hpp"
#include "topology/topology_options.hpp"

namespace cairn {

/// A leaf of the tree: a map that explains everything experienced so far.
struct Hypothesis {
  HypothesisId id;  ///< Stays while travels only follow known links: it names the map.
  HypothesisId parent;
  TopologicalMap map;
  double log_steps = 0.0;   ///< Priors, evidence of same places, penalties.
  double log_layout = 0.0;  ///< Of the metrical layout; the parent's where deferred.
  int contradictions =
      0;  ///< Breaks, misread stars, rejoined places: what the map fails to explain.
  bool is_layout_deferred = false;

  /// Natural logarithm, not normalised. An upper bound where the layout is deferred.
  [[nodiscard]] double log_posterior() const { return log_steps + log_layout; }
};

/// The tree of topological maps: all maps that are consistent with the robot's experience, grown by
/// one arrival at a time.
///
/// Guarantee: without evidence and as long as neither the budget nor a contradiction intervenes,
/// the leaves are exactly the maps that agree with every view and violate neither the axioms nor,
/// if assumed, planarity and region-consistency; no two of them are the same map. The report of
/// each arrival says when this is given up.
///
/// When every leaf is refuted, the best of them go on with the arrival as a new place behind an
/// unexplained gateway (a break), so that the tree is never empty. With evidence, every refuted
/// leaf may go on so and compete by its posterior (keep_contradicted).
///
/// Source: Fig. 4 of Kuipers et al., ICRA 2004; Fig. 2 of Savelli and Kuipers, IROS 2004.
/// Reproducible: same calls, same ids in the same order.
class HypothesisTree {
 public:
  /// @pre validate(options).ok()
  explicit HypothesisTree(const TopologyOptions& options, Evidence evidence = {});

  /// The first place. @pre not started; the view is valid and its visit is 0
  void start(const View& view);
  [[nodiscard]] bool is_started() const { return !fringe_.empty(); }

  /// A travel and what the robot saw at its end.
  /// @pre started; 0 <= action.turn < number of gateways of the view before; the view is valid; its
  ///   visit is the next one
  ExtendReport extend(Action action, const View& view);

  /// The leaves, best first. Valid until the next arrival.
  [[nodiscard]] const std::vector<Hypothesis>& fringe() const { return fringe_; }
  /// For each leaf of the fringe its share of the posterior: they sum to 1.
  [[nodiscard]] std::vector<double> probabilities() const;
  /// The simplest closed maps: of the leaves without pending gateways that are region-consistent,
  /// those with fewest paths, then places. Empty when there are none.
  [[nodiscard]] std::vector<HypothesisId> simplest_closed() const;

  /// The map of a leaf. @pre the hypothesis is on the fringe
  [[nodiscard]] const TopologicalMap& map(HypothesisId leaf) const;
  /// What this leaf's map was after an earlier visit, rebuilt from the experience.
  /// @pre the hypothesis is on the fringe; 0 <= visit < visit_count()
  [[nodiscard]] TopologicalMap map_at(HypothesisId leaf, VisitId visit) const;
  /// One line for each alternative that this leaf's map had at a visit: which was taken, which
  /// closures were possible, which were refuted and why.
  /// @pre as map_at()
  [[nodiscard]] std::vector<std::string> explanation(HypothesisId leaf, VisitId visit) const;

  /// The map from which this one grew; none for the first. @pre is_known(id)
  [[nodiscard]] HypothesisId parent(HypothesisId id) const;
  /// The step by which it grew from its parent, and at which visit. @pre is_known(id)
  [[nodiscard]] Step step(HypothesisId id) const;
  [[nodiscard]] VisitId visit(HypothesisId id) const;
  /// Leaves and their ancestors are known; maps that died out are forgotten now and then.
  [[nodiscard]] bool is_known(HypothesisId id) const { return find_node(id) != nullptr; }

  /// The first time, if ever.
  [[nodiscard]] const std::optional<GuaranteeGivenUp>& guarantee_given_up() const {
    return given_up_;
  }
  /// Root and all consistent successors so far: "search-tree nodes" of Savelli and Kuipers, Fig. 4.
  [[nodiscard]] std::int64_t node_count() const { return node_count_; }
  /// Root, closures and new places: "maps ever built".
  [[nodiscard]] std::int64_t maps_built() const { return maps_built_; }
  [[nodiscard]] int visit_count() const { return static_cast<int>(experience_.size()); }

 private:
  /// How one map grew from another. Travels along known links leave no node.
  struct Node {
    HypothesisId id;
    HypothesisId parent;
    VisitId visit;
    Step step;
  };
  /// A successor that is not built yet.
  struct Candidate {
    std::size_t leaf = 0;  ///< Position of its parent in fringe_.
    Step step;
    double log_steps = 0.0;
    double log_posterior = 0.0;
    int contradictions = 0;
    int path_count = 0;
    int place_count = 0;
  };
  struct Experienced {
    Action action;  ///< Which led here; nothing at the start.
    Arrival arrival;
  };

  Arrival recognise(const View& view);
  std::vector<Candidate> successors(const Experienced& now, ExtendReport& report) const;
  [[nodiscard]] bool may_go_on_contradicted(const TopologicalMap& map, Action action) const;
  [[nodiscard]] Candidate broken(std::size_t leaf,
                                 const Experienced& now,
                                 ExtendReport& report) const;
  std::vector<Candidate> break_all(const Experienced& now, ExtendReport& report) const;
  [[nodiscard]] std::string contradiction(const Experienced& now) const;
  [[nodiscard]] Candidate candidate(std::size_t leaf,
                                    const Alternative& alternative,
                                    const Arrival& arrival) const;
  void keep_best(std::vector<Candidate>& candidates, ExtendReport& report) const;
  void grow(const std::vector<Candidate>& candidates, const Arrival& arrival);
  void lay_out(ExtendReport& report);
  void rank();
  void forget_the_dead();
  [[nodiscard]] const Node* find_node(HypothesisId id) const;
  [[nodiscard]] const Hypothesis& leaf_of(HypothesisId id) const;
  [[nodiscard]] std::string describe(const TopologicalMap& map,
                                     const Alternative& alternative,
                                     const Arrival& arrival) const;

  TopologyOptions options_;
  Evidence evidence_;
  std::shared_ptr<const StarCatalogue> stars_;
  std::vector<Experienced> experience_;
  std::vector<Node> nodes_;  // By id, so that children come after their parents.
  std::vector<Hypothesis> fringe_;
  std::int32_t next_id_ = 0;
  std::size_t nodes_to_keep_ = 0;  // As many as were alive when the dead were last forgotten.
  std::int64_t node_count_ = 0;
  std::int64_t maps_built_ = 0;
  std::optional<GuaranteeGivenUp> given_up_;
};

}  // namespace cairn
