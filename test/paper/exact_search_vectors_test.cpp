// The published vectors of explorations by enumeration: every count of every exploration, with and
// without planarity, the office experiment of Kuipers et al., ICRA 2004, Sec. IV, and explorations
// too large for trees that keep their leaves.

#include <map>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "exact_search/exact_search.hpp"
#include "support/explorations.hpp"
#include "support/topology_vectors.hpp"

namespace cairn::test {
namespace {

using ::testing::ElementsAreArray;
using Json = nlohmann::json;

Exploration exploration_of(const Json& vector, const std::map<std::string, Star>& stars) {
  Exploration exploration{stars.at(vector["start"]["star"]), vector["start"]["gate"], {}};
  for (const Json& step : vector["steps"]) {
    exploration.steps.push_back({step[0], stars.at(step[1]), step[2]});
  }
  return exploration;
}

/// Codes with the names that the file gives to stars.
std::vector<std::string> renamed(std::vector<std::string> codes,
                                 const std::map<std::string, Star>& stars) {
  for (const auto& [name, star] : stars) {
    const std::string ours = type_name(star);
    for (std::string& code : codes) {
      for (std::size_t at = 0; ours != name && (at = code.find(ours, at)) != std::string::npos;) {
        code.replace(at, ours.size(), name);
      }
    }
  }
  std::sort(codes.begin(), codes.end());
  return codes;
}

void expect_counts(const MapCounts& counts, const Json& expected) {
  EXPECT_EQ(counts.tree_nodes, expected["tree_nodes"]);
  EXPECT_EQ(counts.final_maps, expected["final_maps"]);
  const auto expect_if_given = [&](const std::string& field, std::int64_t count) {
    if (expected.contains(field)) {
      EXPECT_EQ(count, expected[field]) << field;
    }
  };
  expect_if_given("maps_built", counts.maps_built);
  expect_if_given("view_mismatches", counts.view_mismatches);
  expect_if_given("closed_paper", counts.closed_paper);
  expect_if_given("closed_no_pending", counts.closed_no_pending);
  expect_if_given("region_consistent_finals", counts.region_consistent_finals);
  expect_if_given("perpendicular_closed_paper", counts.perpendicular_closed_paper);
  if (expected.contains("leaves_per_step")) {
    EXPECT_THAT(counts.leaves_per_step,
                ElementsAreArray(expected["leaves_per_step"].get<std::vector<int>>()));
  }
  if (expected.contains("region_leaves_per_step")) {
    EXPECT_THAT(counts.region_leaves_per_step,
                ElementsAreArray(expected["region_leaves_per_step"].get<std::vector<int>>()));
  }
}

void expect_optimal(const MapCounts& counts,
                    const Json& expected,
                    const std::map<std::string, Star>& stars) {
  ASSERT_EQ(counts.optimal.has_value(), !expected.is_null());
  if (expected.is_null()) {
    return;
  }
  EXPECT_EQ(counts.optimal->count, expected["count"]);
  EXPECT_EQ(counts.optimal->paths, expected["paths"]);
  EXPECT_EQ(counts.optimal->places, expected["places"]);
  if (expected.contains("codes")) {
    EXPECT_EQ(renamed(counts.optimal->codes, stars),
              expected["codes"].get<std::vector<std::string>>());
  }
}

void expect_minimal(const MapCounts& counts,
                    const Json& expected,
                    const std::map<std::string, Star>& stars) {
  ASSERT_TRUE(counts.minimal_region.has_value());
  EXPECT_EQ(counts.minimal_region->count, expected["count"]);
  EXPECT_EQ(counts.minimal_region->paths, expected["paths"]);
  EXPECT_EQ(counts.minimal_region->places, expected["places"]);
  EXPECT_EQ(counts.minimal_region->count_without_triangles, expected["count_without_triangles"]);
  EXPECT_EQ(counts.minimal_region->count_fewest_order_atoms, expected["count_fewest_order_atoms"]);
  EXPECT_EQ(counts.minimal_region->paths_with_two_places, expected["paths_with_two_places"]);
  EXPECT_EQ(renamed(counts.minimal_region->codes, stars),
            expected["codes"].get<std::vector<std::string>>());
}

void expect_vectors(const Json& file) {
  const std::map<std::string, Star> stars = stars_of(file);
  for (const Json& vector : file["vectors"]) {
    for (const bool planar : {false, true}) {
      SCOPED_TRACE(vector["name"].get<std::string>() + (planar ? ", planar" : ", not planar"));
      ExactSearchOptions options;
      options.planar = planar;
      if (!vector["max_places"].is_null()) {
        options.max_places = vector["max_places"].get<int>();
      }
      const Enumeration found = enumerate(exploration_of(vector, stars), options);
      const Json& expected = vector[planar ? "planar" : "nonplanar"];
      EXPECT_TRUE(found.is_complete);
      expect_counts(found.counts, expected);
      expect_optimal(found.counts, expected["optimal"], stars);
      if (expected.contains("minimal_region")) {
        expect_minimal(found.counts, expected["minimal_region"], stars);
      }
    }
  }
}

TEST(ExactSearchVectors, EveryCountOfEveryExplorationAgrees) {
  CAIRN_NEED_DATA("topology/vectors.json");
  expect_vectors(recorded_json("topology/vectors.json"));
}

TEST(ExactSearchVectors, EveryCountOfTheOfficeExperimentAgrees) {
  CAIRN_NEED_DATA("topology/office.json");
  expect_vectors(recorded_json("topology/office.json"));
}

// Pruning early by a rule whose violations never heal leaves the maps that filtering late leaves.
TEST(ExactSearchVectors, RegionConsistencyAsAnAxiomLeavesTheMapsThatFilteringLeaves) {
  CAIRN_NEED_DATA("topology/office.json");
  const Json file = recorded_json("topology/office.json");
  for (const Json& vector : file["vectors"]) {
    for (const bool planar : {false, true}) {
      SCOPED_TRACE(vector["name"].get<std::string>() + (planar ? ", planar" : ", not planar"));
      ExactSearchOptions options;
      options.planar = planar;
      options.region_consistent = true;
      const MapCounts counts = enumerate(exploration_of(vector, stars_of(file)), options).counts;
      EXPECT_EQ(counts.leaves_per_step, counts.region_leaves_per_step);
      const Json& expected = vector[planar ? "planar" : "nonplanar"];
      EXPECT_THAT(counts.leaves_per_step,
                  ElementsAreArray(expected["region_leaves_per_step"].get<std::vector<int>>()));
    }
  }
}

// "4x5 snake, at most 20 places": rows, columns and bound stand in the name.
TEST(ExactSearchVectors, LargeExplorationsAgree) {
  CAIRN_NEED_DATA("topology/vectors.json");
  constexpr std::int64_t kMostNodes = 4'000'000;
  const Json file = recorded_json("topology/vectors.json");
  int compared = 0;
  for (const Json& row : file["large_counts"]) {
    if (!row.contains("tree_nodes") || row["tree_nodes"] > kMostNodes) {
      continue;
    }
    const auto name = row["grid"].get<std::string>();
    SCOPED_TRACE(name + ", " + row["mode"].get<std::string>());
    ExactSearchOptions options;
    options.planar = row["mode"] == "planar";
    const std::size_t bound = name.find("at most ");
    if (bound != std::string::npos) {
      options.max_places = std::stoi(name.substr(bound + 8));
    }
    const MapCounts counts = enumerate(snake(name[0] - '0', name[2] - '0'), options).counts;
    expect_counts(counts, row);
    expect_optimal(counts, row["optimal"], {});
    ++compared;
  }
  EXPECT_GE(compared, 6);
}

}  // namespace
}  // namespace cairn::test
