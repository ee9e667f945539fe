// The published vectors of explorations: every count of every exploration, with and without
// planarity, and the office experiment of Kuipers et al., ICRA 2004, Sec. IV.

#include "support/topology_vectors.hpp"

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "topology/hypothesis_tree.hpp"
#include "topology/regions.hpp"

namespace cairn::test {
namespace {

using Json = nlohmann::json;

/// The tree after an exploration, and what happened on the way.
struct Explored {
  HypothesisTree tree;
  std::vector<int> leaves_per_step;
  std::int64_t links_contradicted = 0;
};

Explored explore(const Json& vector,
                 const std::map<std::string, Star>& stars,
                 TopologyOptions options) {
  options.max_hypotheses = 10'000'000;
  if (!vector["max_places"].is_null()) {
    options.max_places = vector["max_places"].get<int>();
  }
  Explored explored{HypothesisTree(options), {}, 0};
  EXPECT_TRUE(
      explored.tree.start({stars.at(vector["start"]["star"]), vector["start"]["gate"], VisitId{0}})
          .ok());
  VisitId visit{0};
  for (const Json& step : vector["steps"]) {
    ++visit.value;
    const ExtendReport report =
        *explored.tree.extend({step[0]}, {stars.at(step[1]), step[2], visit});
    EXPECT_FALSE(report.guarantee_given_up);
    EXPECT_EQ(report.waiting, 0);
    explored.leaves_per_step.push_back(static_cast<int>(report.leaves));
    explored.links_contradicted += report.links_contradicted;
  }
  return explored;
}

template <typename Predicate>
int count(const HypothesisTree& tree, Predicate holds) {
  int count = 0;
  tree.for_each_map(
      [&](const Hypothesis&, const TopologicalMap& map) { count += holds(map) ? 1 : 0; });
  return count;
}

void expect_counts(const Explored& explored, const Json& expected) {
  const HypothesisTree& tree = explored.tree;
  EXPECT_EQ(tree.node_count(), expected["tree_nodes"]);
  EXPECT_EQ(tree.maps_built(), expected["maps_built"]);
  EXPECT_EQ(explored.links_contradicted, expected["view_mismatches"]);
  EXPECT_EQ(tree.fringe().size(), expected["final_maps"]);
  EXPECT_EQ(explored.leaves_per_step, expected["leaves_per_step"].get<std::vector<int>>());
  const auto is_closed = [](const TopologicalMap& map) { return map.has_no_lone_path(); };
  EXPECT_EQ(count(tree, is_closed), expected["closed_paper"]);
  EXPECT_EQ(count(tree, [](const TopologicalMap& map) { return map.is_closed(); }),
            expected["closed_no_pending"]);
  EXPECT_EQ(count(tree, is_region_consistent), expected["region_consistent_finals"]);
  EXPECT_EQ(
      count(tree,
            [&](const TopologicalMap& map) { return is_closed(map) && is_perpendicular(map); }),
      expected["perpendicular_closed_paper"]);
}

void expect_optimal(const HypothesisTree& tree, const Json& expected) {
  const std::vector<HypothesisId> optimal = tree.simplest_closed();
  if (expected.is_null()) {
    EXPECT_TRUE(optimal.empty());
    return;
  }
  ASSERT_EQ(optimal.size(), expected["count"]);
  EXPECT_EQ(tree.map(optimal.front()).path_count(), expected["paths"]);
  EXPECT_EQ(tree.map(optimal.front()).place_count(), expected["places"]);
}

void expect_vectors(const Json& file) {
  const std::map<std::string, Star> stars = stars_of(file);
  for (const Json& vector : file["vectors"]) {
    for (const bool planar : {false, true}) {
      SCOPED_TRACE(vector["name"].get<std::string>() + (planar ? ", planar" : ", not planar"));
      TopologyOptions options;
      options.planar = planar;
      const Explored explored = explore(vector, stars, options);
      const Json& expected = vector[planar ? "planar" : "nonplanar"];
      expect_counts(explored, expected);
      expect_optimal(explored.tree, expected["optimal"]);
    }
  }
}

TEST(TopologyVectors, EveryCountOfEveryExplorationAgrees) {
  CAIRN_NEED_DATA("topology/vectors.json");
  expect_vectors(recorded_json("topology/vectors.json"));
}

TEST(OfficeExperiment, CountsOfAllConsistentMapsAgree) {
  CAIRN_NEED_DATA("topology/office.json");
  expect_vectors(recorded_json("topology/office.json"));
}

// "The topological mapper finds 83 possible configurations [...]; 4 minimal models. If we assume
// planarity [...] there are only 46 consistent configurations [...] and a single minimal model."
// The minimal ones are those without triangles among the maps of fewest paths and places.
TEST(OfficeExperiment, RegionConsistencyAsAnAxiomGives83MapsAnd46InThePlane) {
  CAIRN_NEED_DATA("topology/office.json");
  const Json file = recorded_json("topology/office.json");
  const std::map<std::string, Star> stars = stars_of(file);
  for (const Json& vector : file["vectors"]) {
    for (const bool planar : {false, true}) {
      SCOPED_TRACE(vector["name"].get<std::string>() + (planar ? ", planar" : ", not planar"));
      TopologyOptions options;
      options.planar = planar;
      options.region_consistent = true;
      options.preference = Preference::kSimplest;
      const Explored explored = explore(vector, stars, options);
      const Json& expected = vector[planar ? "planar" : "nonplanar"];
      EXPECT_EQ(explored.tree.fringe().size(), planar ? 46U : 83U);
      EXPECT_EQ(explored.leaves_per_step,
                expected["region_leaves_per_step"].get<std::vector<int>>());
      const TopologicalMap best = explored.tree.map(explored.tree.best().id);
      EXPECT_EQ(best.path_count(), expected["minimal_region"]["paths"]);
      EXPECT_EQ(best.place_count(), expected["minimal_region"]["places"]);
      const auto is_minimal = [&](const TopologicalMap& map) {
        return map.path_count() == best.path_count() && map.place_count() == best.place_count();
      };
      EXPECT_EQ(count(explored.tree, is_minimal), expected["minimal_region"]["count"]);
      EXPECT_EQ(
          count(explored.tree,
                [&](const TopologicalMap& map) { return is_minimal(map) && !has_triangle(map); }),
          planar ? 1 : 4);
    }
  }
}

}  // namespace
}  // namespace cairn::test
