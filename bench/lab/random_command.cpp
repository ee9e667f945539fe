#include <algorithm>
#include <ostream>

#include "bench/lab/counts.hpp"
#include "bench/lab/resources.hpp"
#include "bench/lab/text.hpp"
#include "bench/lab/topology_command.hpp"
#include "bench/lab/truth.hpp"
#include "bench/lab/worlds/random_exploration.hpp"
#include "clients/common/progress.hpp"
#include "clients/common/text.hpp"
#include "support/obvious_tree.hpp"

namespace cairn::lab {
namespace {

/// What came out of all worlds, in one mode.
struct Totals {
  std::int64_t worlds = 0;
  std::int64_t with_truth = 0;    ///< The true map is one of the leaves.
  std::int64_t agreeing = 0;      ///< Both implementations count the same.
  std::int64_t closed = 0;        ///< There is an optimal map.
  std::int64_t best_optimal = 0;  ///< Best-first search finds one.
  std::int64_t tree_nodes = 0;
  std::int64_t final_maps = 0;
  std::int64_t most_final_maps = 0;
  double cpu_s = 0.0;
  double obvious_cpu_s = 0.0;
  std::vector<std::string> complaints;
};

bool is_among(const std::string& code, const std::vector<test::ObviousMap>& leaves) {
  return std::any_of(leaves.begin(), leaves.end(), [&code](const test::ObviousMap& leaf) {
    return test::obvious_code(leaf) == code;
  });
}

/// Whether the first closed map is one of those that complete enumeration finds simplest.
bool best_is_optimal(const Exploration& exploration, bool planar, const SimplestMaps& optimal) {
  ExactSearchOptions options;
  options.planar = planar;
  options.region_consistent = true;
  const BestMap best = find_best(exploration, options, SearchOrder::kPaths);
  return best.map && best.is_proven &&
         std::find(optimal.codes.begin(), optimal.codes.end(), best.code) != optimal.codes.end();
}

void explore(std::uint64_t seed, bool planar, Totals* totals) {
  const Walk walk = random_exploration(seed);
  ExactSearchOptions options;
  options.planar = planar;
  options.max_codes = 1'000'000;
  const SearchRun run =
      run_search(SearchKind::kDepth, walk.exploration, options, SearchOrder::kPaths);

  const double start_s = cpu_time_s();
  const test::ObviousTree tree = test::obvious_tree(walk.exploration, {planar, false, {}});
  totals->obvious_cpu_s += cpu_time_s() - start_s;
  const std::vector<std::string> found =
      differences(to_json(test::counts_of(tree)), to_json(run.counts)).found;

  const auto complain = [&](const std::string& what) {
    totals->complaints.push_back("seed " + std::to_string(seed) +
                                 (planar ? ", planar: " : ", nonplanar: ") + what);
  };
  for (const std::string& difference : found) {
    complain(difference);
  }
  const bool has_truth = is_among(code_of_truth(walk), tree.leaves);
  if (!has_truth) {
    complain("the true map is not among the leaves");
  }
  if (run.counts.optimal) {
    const bool is_best = best_is_optimal(walk.exploration, planar, *run.counts.optimal);
    ++totals->closed;
    totals->best_optimal += is_best ? 1 : 0;
    if (!is_best) {
      complain("best-first search did not find a simplest closed map");
    }
  }
  ++totals->worlds;
  totals->with_truth += has_truth ? 1 : 0;
  totals->agreeing += found.empty() ? 1 : 0;
  totals->tree_nodes += run.counts.tree_nodes;
  totals->final_maps += run.counts.final_maps;
  totals->most_final_maps = std::max(totals->most_final_maps, run.counts.final_maps);
  totals->cpu_s += run.cpu_s;
}

Json json_of(const Totals& totals) {
  return {{"worlds", totals.worlds},
          {"true_map_among_leaves", totals.with_truth},
          {"obvious_implementation_agrees", totals.agreeing},
          {"with_closed_map", totals.closed},
          {"best_first_is_optimal", totals.best_optimal},
          {"tree_nodes", totals.tree_nodes},
          {"final_maps", totals.final_maps},
          {"most_final_maps", totals.most_final_maps},
          {"cpu_ms", milliseconds(totals.cpu_s)},
          {"obvious_cpu_ms", milliseconds(totals.obvious_cpu_s)},
          {"complaints", totals.complaints}};
}

std::string of(std::int64_t part, std::int64_t whole) {
  return grouped(part) + " of " + grouped(whole);
}

void print(const Totals& nonplanar, const Totals& planar, std::ostream& out) {
  clients::Table table({"", "nonplanar", "planar"});
  const auto line = [&](const std::string& name, const auto& value) {
    table.add({name, value(nonplanar), value(planar)});
  };
  line("true map is a leaf", [](const Totals& t) { return of(t.with_truth, t.worlds); });
  line("obvious search agrees", [](const Totals& t) { return of(t.agreeing, t.worlds); });
  line("best-first is optimal", [](const Totals& t) { return of(t.best_optimal, t.closed); });
  line("tree nodes", [](const Totals& t) { return grouped(t.tree_nodes); });
  line("final maps", [](const Totals& t) { return grouped(t.final_maps); });
  line("most final maps", [](const Totals& t) { return grouped(t.most_final_maps); });
  line("CPU ms", [](const Totals& t) { return clients::fixed(1000.0 * t.cpu_s, 1); });
  line("CPU ms, obvious",
       [](const Totals& t) { return clients::fixed(1000.0 * t.obvious_cpu_s, 1); });
  table.print(out);
  for (const Totals* totals : {&nonplanar, &planar}) {
    for (const std::string& complaint : totals->complaints) {
      out << complaint << '\n';
    }
  }
  SearchRun all;
  all.counts.tree_nodes = nonplanar.tree_nodes + planar.tree_nodes;
  all.cpu_s = nonplanar.cpu_s + planar.cpu_s;
  out << cost_text(all) << '\n';
}

}  // namespace

int explore_random_worlds(const TopologyRequest& request, std::ostream& out) {
  Totals nonplanar;
  Totals planar;
  {
    clients::Progress progress("random worlds");
    for (int world = 0; world < request.count; ++world) {
      const std::uint64_t seed = *request.seed + static_cast<std::uint64_t>(world);
      explore(seed, false, &nonplanar);
      explore(seed, true, &planar);
      progress.show(world + 1, request.count);
    }
  }
  const bool is_good = nonplanar.complaints.empty() && planar.complaints.empty();
  if (request.as_json) {
    const Json json = {{"first_seed", *request.seed},
                       {"count", request.count},
                       {"nonplanar", json_of(nonplanar)},
                       {"planar", json_of(planar)},
                       {"peak_resident_bytes", peak_resident_bytes()},
                       {"agrees", is_good}};
    out << json.dump(2) << '\n';
  } else {
    out << request.count << " random planar worlds, seeds from " << *request.seed << '\n';
    print(nonplanar, planar, out);
  }
  return is_good ? 0 : 1;
}

}  // namespace cairn::lab
