#include "bench/lab/run_breadth.hpp"

#include <algorithm>
#include <utility>

#include "base/check.hpp"
#include "bench/lab/resources.hpp"
#include "bench/lab/text.hpp"
#include "exact_search/order_atoms.hpp"
#include "topology/hypothesis_tree.hpp"
#include "topology/paths.hpp"
#include "topology/regions.hpp"

namespace cairn::lab {
namespace {

TopologyOptions strict(const ExactSearchOptions& options) {
  TopologyOptions strict;
  strict.planar = options.planar;
  strict.region_consistent = options.region_consistent;
  strict.max_places = options.max_places;
  strict.max_hypotheses = 10'000'000;
  strict.max_bytes = 1'000'000'000'000;
  strict.max_repair_steps = 0;
  return strict;
}

/// Codes of the simplest maps of a kind.
template <typename Simplest>
bool is_simplest(const TopologicalMap& map, std::optional<Simplest>* simplest) {
  const std::pair simplicity(map.path_count(), map.place_count());
  if (!*simplest || simplicity < std::pair((*simplest)->paths, (*simplest)->places)) {
    simplest->emplace();
    (*simplest)->paths = simplicity.first;
    (*simplest)->places = simplicity.second;
  }
  return simplicity == std::pair((*simplest)->paths, (*simplest)->places);
}

void count_final(const TopologicalMap& map, MapCounts& counts) {
  ++counts.final_maps;
  const bool is_closed_paper = map.has_no_lone_path();
  counts.closed_paper += is_closed_paper ? 1 : 0;
  counts.closed_no_pending += map.is_closed() ? 1 : 0;
  counts.perpendicular_closed_paper += is_closed_paper && is_perpendicular(map) ? 1 : 0;
  if (!is_region_consistent(map)) {
    return;
  }
  ++counts.region_consistent_finals;
  if (map.is_closed() && is_simplest(map, &counts.optimal)) {
    ++counts.optimal->count;
    counts.optimal->codes.push_back(canonical_code(map));
  }
  if (is_simplest(map, &counts.minimal_region)) {
    ++counts.minimal_region->count;
    count_order_atoms(map, &*counts.minimal_region);
    if (!has_triangle(map)) {
      ++counts.minimal_region->count_without_triangles;
      counts.minimal_region->codes.push_back(canonical_code(map));
    }
  }
}

/// As enumerate() gives them: sorted, and none where there are too many.
template <typename Simplest>
void tidy(std::size_t max_codes, std::optional<Simplest>* simplest) {
  if (*simplest) {
    std::vector<std::string>& codes = (*simplest)->codes;
    std::sort(codes.begin(), codes.end());
    if (codes.size() > max_codes) {
      codes.clear();
    }
  }
}

/// The tree as the papers have it: where nothing explains an arrival it has no leaves any more,
/// and nobody repairs it. Counts are those of the last travel that kept within the bound on nodes.
class StrictTree {
 public:
  StrictTree(const Exploration& exploration, const ExactSearchOptions& options)
      : exploration_(&exploration), max_nodes_(options.max_nodes), tree_(strict(options)) {
    CAIRN_CHECK(tree_.start({exploration.start, exploration.start_gateway, VisitId{0}}).ok());
    nodes_ = tree_.node_count();
    maps_ = tree_.maps_built();
  }

  /// The next step. False: that was the last one, or it was given up.
  bool extend() {
    if (leaves_.size() == exploration_->steps.size() || !given_up_.empty()) {
      return false;
    }
    if (is_refuted_) {
      leaves_.push_back(0);
      return true;
    }
    const ExplorationStep& next = exploration_->steps[leaves_.size()];
    const Result<ExtendReport> report =
        tree_.extend({next.turn}, {next.star, next.arrival_gateway, VisitId{tree_.visit_count()}});
    CAIRN_CHECK(report.ok());
    is_refuted_ = report->repair.has_value();
    if (!is_refuted_ && !has_kept_all(*report)) {
      return false;
    }
    mismatches_ += report->links_contradicted;
    leaves_.push_back(is_refuted_ ? 0 : report->leaves);
    if (!is_refuted_) {
      nodes_ = tree_.node_count();
      maps_ = tree_.maps_built();
    }
    return true;
  }

  [[nodiscard]] const HypothesisTree& tree() const { return tree_; }
  [[nodiscard]] const std::vector<std::int64_t>& leaves() const { return leaves_; }
  [[nodiscard]] std::int64_t nodes() const { return nodes_; }
  [[nodiscard]] std::int64_t maps() const { return maps_; }
  [[nodiscard]] std::int64_t mismatches() const { return mismatches_; }
  [[nodiscard]] const std::string& given_up() const { return given_up_; }
  [[nodiscard]] bool is_refuted() const { return is_refuted_; }

 private:
  /// Whether all leaves of the travel are there, with no more nodes than allowed.
  bool has_kept_all(const ExtendReport& report) {
    const std::string in_travel = "given up in travel " + std::to_string(leaves_.size() + 1) +
                                  " of " + std::to_string(exploration_->steps.size());
    if (max_nodes_ > 0 && tree_.node_count() > max_nodes_) {
      given_up_ = in_travel + ", which makes more than " + grouped(max_nodes_) +
                  " nodes (--max-nodes); counted is the tree before it";
    } else if (report.waiting > 0 || report.guarantee_given_up) {
      given_up_ = in_travel + ", of which not all maps can be kept; counted is the tree before it";
    }
    return given_up_.empty();
  }

  const Exploration* exploration_;
  std::int64_t max_nodes_;
  HypothesisTree tree_;
  std::vector<std::int64_t> leaves_;
  std::int64_t nodes_ = 0;
  std::int64_t maps_ = 0;
  std::int64_t mismatches_ = 0;
  std::string given_up_;
  bool is_refuted_ = false;
};

/// Maps that are not region-consistent never heal, so those left by pruning are those that are.
std::vector<std::int64_t> region_leaves(const Exploration& exploration,
                                        ExactSearchOptions options,
                                        const std::vector<std::int64_t>& leaves) {
  if (options.region_consistent) {
    return leaves;
  }
  options.region_consistent = true;
  StrictTree tree(exploration, options);
  while (tree.leaves().size() < leaves.size() && tree.extend()) {
  }
  return tree.leaves();
}

}  // namespace

SearchRun run_breadth(const Exploration& exploration, const ExactSearchOptions& options) {
  const double start_s = cpu_time_s();
  StrictTree grown(exploration, options);
  while (grown.extend()) {
  }
  SearchRun run;
  run.given_up = grown.given_up();
  MapCounts& counts = run.counts;
  counts.tree_nodes = grown.nodes();
  counts.maps_built = grown.maps();
  counts.view_mismatches = grown.mismatches();
  counts.leaves_per_step = grown.leaves();
  const HypothesisTree::Memory memory = grown.tree().memory();
  run.stored = {static_cast<std::int64_t>(memory.nodes),
                static_cast<std::int64_t>(memory.bytes_of_nodes),
                grown.tree().live_count() + grown.tree().waiting_count(),
                static_cast<std::int64_t>(memory.bytes_of_leaves)};
  run.cpu_s = cpu_time_s() - start_s;
  // Looking at every map afterwards is not part of the search.
  const double counting_start_s = cpu_time_s();
  const auto max_codes = static_cast<std::size_t>(options.max_codes);
  if (run.given_up.empty() && !grown.is_refuted()) {
    grown.tree().for_each_map(
        [&](const Hypothesis&, const TopologicalMap& map) { count_final(map, counts); });
  }
  counts.region_leaves_per_step = region_leaves(exploration, options, counts.leaves_per_step);
  tidy(max_codes, &counts.optimal);
  tidy(max_codes, &counts.minimal_region);
  run.counting_cpu_s = cpu_time_s() - counting_start_s;
  return run;
}

}  // namespace cairn::lab
