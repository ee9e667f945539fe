// What is promised of the tree of maps, on random explorations: every search counts what an obvious
// implementation counts, the true map is never lost, and what says that it loses nothing loses
// nothing.

#include <algorithm>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "bench/lab/counts.hpp"
#include "bench/lab/truth.hpp"
#include "bench/lab/vectors_file.hpp"
#include "bench/lab/worlds/random_exploration.hpp"
#include "exact_search/exact_search.hpp"
#include "support/obvious_tree.hpp"
#include "support/recorded_data.hpp"
#include "support/search_options.hpp"

namespace cairn::test {
namespace {

using lab::code_of_truth;
using lab::differences;
using lab::random_exploration;
using lab::to_json;
using lab::Walk;

std::vector<std::string> differences_between(const Exploration& exploration,
                                             const ObviousTreeOptions& options) {
  const MapCounts counts = enumerate(exploration, all_codes(options)).counts;
  return differences(to_json(counts_of(obvious_tree(exploration, options))), to_json(counts)).found;
}

std::multiset<std::string> codes_of(const std::vector<ObviousMap>& leaves) {
  std::multiset<std::string> codes;
  for (const ObviousMap& leaf : leaves) {
    codes.insert(obvious_code(leaf));
  }
  return codes;
}

const std::vector<std::string> kNone;

TEST(Guarantee, TheObviousTreeGivesThePublishedCounts) {
  CAIRN_NEED_DATA("topology/vectors.json");
  for (const char* name : {"topology/vectors.json", "topology/office.json"}) {
    const lab::VectorsFile file = lab::read_vectors(recorded_data(name));
    for (const lab::TestVector& vector : file.vectors) {
      for (const bool planar : {false, true}) {
        SCOPED_TRACE(vector.name + (planar ? ", planar" : ", nonplanar"));
        const lab::Json& expected = planar ? vector.planar : vector.nonplanar;
        if (expected["tree_nodes"] < 5000) {
          const ObviousTree tree =
              obvious_tree(vector.exploration, {planar, false, vector.max_places});
          EXPECT_EQ(differences(expected, to_json(counts_of(tree), file.names)).found, kNone);
        }
      }
    }
  }
}

TEST(Guarantee, EveryCountAndEverySimplestMapIsThatOfTheObviousTree) {
  for (unsigned seed = 0; seed < 1000; ++seed) {
    const Walk walk = random_exploration(seed, 1000);
    for (const bool planar : {false, true}) {
      SCOPED_TRACE("seed " + std::to_string(seed) + (planar ? ", planar" : ", nonplanar"));
      EXPECT_EQ(differences_between(walk.exploration, {planar, false, {}}), kNone);
    }
  }
}

TEST(Guarantee, TheObviousTreeAgreesOnBoundsAndOnTheRegionAxiom) {
  for (unsigned seed = 1000; seed < 1200; ++seed) {
    const Walk walk = random_exploration(seed, 1000);
    const std::set<int> places = [&walk] {
      std::set<int> met;
      for (const lab::TrueVisit& visit : walk.visits) {
        met.insert(visit.place);
      }
      return met;
    }();
    const int bound = std::max(1, static_cast<int>(places.size()) - 1 + static_cast<int>(seed % 3));
    for (const bool planar : {false, true}) {
      SCOPED_TRACE("seed " + std::to_string(seed) + (planar ? ", planar" : ", nonplanar"));
      EXPECT_EQ(differences_between(walk.exploration, {planar, false, bound}), kNone);
      EXPECT_EQ(differences_between(walk.exploration, {planar, true, {}}), kNone);
    }
  }
}

TEST(Guarantee, TheTrueMapIsAmongTheLeavesAndNoLeafIsThereTwice) {
  for (unsigned seed = 0; seed < 500; ++seed) {
    const Walk walk = random_exploration(seed, 1000);
    const std::string truth = code_of_truth(walk);
    for (const bool planar : {false, true}) {
      SCOPED_TRACE("seed " + std::to_string(seed) + (planar ? ", planar" : ", nonplanar"));
      const auto codes = codes_of(obvious_tree(walk.exploration, {planar, false, {}}).leaves);
      EXPECT_EQ(codes.count(truth), 1U);
      EXPECT_EQ(std::set<std::string>(codes.begin(), codes.end()).size(), codes.size());
    }
  }
}

TEST(Guarantee, PlanarLeavesAreSomeOfAllLeaves) {
  for (unsigned seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    const Walk walk = random_exploration(seed, 1000);
    const auto all = codes_of(obvious_tree(walk.exploration, {false, false, {}}).leaves);
    const auto planar = codes_of(obvious_tree(walk.exploration, {true, false, {}}).leaves);
    EXPECT_TRUE(std::includes(all.begin(), all.end(), planar.begin(), planar.end()));
  }
}

TEST(Guarantee, RegionConsistencyPrunedEarlyIsRegionConsistencyFilteredLate) {
  for (unsigned seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    const Walk walk = random_exploration(seed);
    for (const bool planar : {false, true}) {
      const MapCounts late = enumerate(walk.exploration, all_codes({planar, false, {}})).counts;
      const MapCounts early = enumerate(walk.exploration, all_codes({planar, true, {}})).counts;
      EXPECT_EQ(early.leaves_per_step, late.region_leaves_per_step);
      EXPECT_EQ(early.final_maps, late.region_consistent_finals);
    }
  }
}

TEST(Guarantee, LookAheadLosesNoClosedMap) {
  for (unsigned seed = 0; seed < 500; ++seed) {
    SCOPED_TRACE(seed);
    const Walk walk = random_exploration(seed);
    for (const bool planar : {false, true}) {
      ExactSearchOptions options = all_codes({planar, false, {}});
      const MapCounts all = enumerate(walk.exploration, options).counts;
      options.look_ahead = true;
      const MapCounts ahead = enumerate(walk.exploration, options).counts;
      EXPECT_EQ(ahead.closed_no_pending, all.closed_no_pending);
      EXPECT_EQ(to_json(ahead)["optimal"], to_json(all)["optimal"]);
      EXPECT_LE(ahead.tree_nodes, all.tree_nodes);
    }
  }
}

TEST(Guarantee, TheFirstClosedMapOfABestFirstSearchIsOneOfTheSimplest) {
  int closed = 0;
  for (unsigned seed = 0; seed < 500; ++seed) {
    const Walk walk = random_exploration(seed);
    for (const bool planar : {false, true}) {
      SCOPED_TRACE("seed " + std::to_string(seed) + (planar ? ", planar" : ", nonplanar"));
      const ExactSearchOptions options = all_codes({planar, true, {}});
      const MapCounts all = enumerate(walk.exploration, options).counts;
      const BestMap best = find_best(walk.exploration, options, SearchOrder::kPaths);
      ASSERT_EQ(best.map.has_value(), all.optimal.has_value());
      if (best.map) {
        ++closed;
        const std::vector<std::string>& codes = all.optimal->codes;
        EXPECT_NE(std::find(codes.begin(), codes.end(), best.code), codes.end()) << best.code;
        EXPECT_TRUE(best.is_proven);
      }
    }
  }
  EXPECT_GT(closed, 100);
}

TEST(Guarantee, TheFirstClosedMapByPlacesHasTheFewestPlaces) {
  for (unsigned seed = 0; seed < 500; ++seed) {
    SCOPED_TRACE(seed);
    const Walk walk = random_exploration(seed, 1000);
    std::optional<std::pair<int, int>> least;
    for (const ObviousMap& leaf : obvious_tree(walk.exploration, {true, false, {}}).leaves) {
      const std::pair size(static_cast<int>(leaf.places.size()),
                           static_cast<int>(places_of_paths(leaf).size()));
      if (is_closed(leaf) && (!least || size < *least)) {
        least = size;
      }
    }
    const BestMap best =
        find_best(walk.exploration, all_codes({true, false, {}}), SearchOrder::kPlaces);
    ASSERT_EQ(best.map.has_value(), least.has_value());
    if (best.map) {
      EXPECT_EQ(std::pair(best.map->place_count(), best.map->path_count()), *least);
      EXPECT_EQ(best.code, canonical_code(*best.map));
    }
  }
}

}  // namespace
}  // namespace cairn::test
