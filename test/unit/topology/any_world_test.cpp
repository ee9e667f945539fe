// Whatever a world shows, and in whatever mode: the maps of the tree stay sound, and every visit of
// every map has an explanation.

#include <algorithm>
#include <numeric>
#include <random>
#include <string>

#include <gtest/gtest.h>

#include "star/star_edits.hpp"
#include "support/lattice.hpp"
#include "support/random_star.hpp"
#include "topology/paths.hpp"
#include "traveller.hpp"

namespace cairn::test {
namespace {

/// A number that depends on the question alone.
double noise(SeenGateway known, SeenGateway now, unsigned seed) {
  std::seed_seq question{
      seed, static_cast<unsigned>(known.visit.value), static_cast<unsigned>(known.gateway),
      static_cast<unsigned>(now.visit.value), static_cast<unsigned>(now.gateway)};
  std::mt19937 random(question);
  return static_cast<double>(random() % 200) / 10.0 - 10.0;
}

/// Every combination of modes, by seed.
TopologyOptions options_of(unsigned seed) {
  TopologyOptions options;
  options.noisy_stars = seed % 4 != 0;
  options.planar = (seed / 2) % 3 != 0;
  options.log_penalty_handle = (seed / 3) % 2 == 0 ? 2.0 : 0.0;
  options.region_consistent = seed % 5 == 0;
  options.max_hypotheses = 1 + static_cast<int>(seed % 17);
  options.max_repair_steps = 200;
  options.max_revivals = static_cast<int>(seed % 40);
  options.preference = seed % 6 == 1 ? Preference::kSimplest : Preference::kPosterior;
  if (seed % 7 == 0) {
    options.max_places = 6;
  }
  return options;
}

/// Now and then another star, or a second reading without one of its gateways.
View misread(const View& view, std::mt19937& random) {
  View seen = view;
  const std::vector<Star> stars = {dead_end(), corridor(), corner(), tee(), crossing()};
  if (random() % 2 == 0) {
    seen.star = stars[random() % stars.size()];
    seen.arrival_gateway = random_below(gateway_count(seen.star), random);
  }
  const int gateways = gateway_count(seen.star);
  const int missing = (seen.arrival_gateway + 1) % gateways;
  if (gateways > 1 && random() % 3 == 0) {
    Reading reading{*without_gateway(seen.star, missing), {}, -1.0};
    for (int gateway = 0; gateway < gateways; ++gateway) {
      if (gateway != missing) {
        reading.gateways.push_back(gateway);
      }
    }
    seen.others = {reading};
  }
  return seen;
}

void expect_sound(const HypothesisTree& tree) {
  tree.for_each_map([&](const Hypothesis& leaf, const TopologicalMap& map) {
    ASSERT_EQ(map.place_count(), leaf.place_count);
    ASSERT_EQ(map.path_count(), leaf.path_count);
    ASSERT_EQ(map.path_count(), static_cast<int>(trace_paths(map).size()));
    ASSERT_EQ(map.visit_count(), tree.visit_count());
    for (VisitId visit{0}; visit.value < map.visit_count(); ++visit.value) {
      const VisitedPlace at = map.at_visit(visit);
      ASSERT_LT(at.place.value, map.place_count());
    }
  });
  double sum = 0.0;
  for (const double share : tree.probabilities()) {
    sum += share;
  }
  ASSERT_NEAR(sum, 1.0, 1e-9);
  ASSERT_LE(tree.settled_through().value, tree.visit_count() - 1);
}

/// One alternative is taken at every visit, and every other one has a fate.
void expect_explained(const HypothesisTree& tree, HypothesisId id) {
  for (VisitId visit{0}; visit.value < tree.visit_count(); ++visit.value) {
    const auto all = tree.explanation(id, visit);
    ASSERT_EQ(std::count_if(all.begin(), all.end(), [](const auto& one) { return one.is_taken; }),
              1)
        << "visit " << visit.value << ":\n"
        << std::accumulate(
               all.begin(), all.end(), std::string(),
               [](const std::string& text, const auto& one) { return text + one.sentence + "\n"; });
    for (const auto& one : all) {
      ASSERT_FALSE(one.sentence.empty());
    }
  }
}

TEST(AnyWorld, LeavesMapsSoundAndExplained) {
  for (unsigned seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const Lattice streets(3, 3);
    const Walk walk = streets.walk(0, streets.random_moves(0, 40, random));
    Evidence evidence;
    if (seed % 3 != 0) {
      evidence.same_place = [&](SeenGateway known, SeenGateway now) {
        return noise(known, now, seed);
      };
    }
    Traveller robot(walk.start.star, walk.start.arrival_gateway, options_of(seed), evidence);
    for (const Experienced& step : walk.steps) {
      View view = step.view;
      if (random() % 4 == 0) {
        view = misread(view, random);
      }
      view.visit = VisitId{robot.tree().visit_count()};
      auto report = robot.tree().extend(step.action, view);
      if (!report) {  // The misread star lacks the gateway by which the walk goes on.
        report = robot.tree().wake_up(view);
      }
      ASSERT_TRUE(report.ok()) << report.error().message;
      ASSERT_GT(report->leaves, 0);
      ASSERT_NO_FATAL_FAILURE(expect_sound(robot.tree()));
    }
    ASSERT_NO_FATAL_FAILURE(expect_explained(robot.tree(), robot.best().id));
    const std::vector<Hypothesis> fringe = robot.tree().fringe();
    if (fringe.size() > 1) {
      EXPECT_FALSE(robot.tree().parting(fringe[0].id, fringe[1].id).sentence.empty());
    }
  }
}

TEST(AnyWorld, GivesTheSameTreeTwice) {
  for (unsigned seed = 1; seed < 10; ++seed) {
    SCOPED_TRACE(seed);
    std::vector<std::vector<double>> posteriors;
    for (int again = 0; again < 2; ++again) {
      std::mt19937 random(seed);
      const Lattice streets(3, 3);
      const Walk walk = streets.walk(0, streets.random_moves(0, 25, random));
      Traveller robot(walk.start.star, walk.start.arrival_gateway, options_of(seed), always(1.0));
      for (const Experienced& step : walk.steps) {
        robot.travel(step.action.turn, step.view);
      }
      posteriors.emplace_back();
      for (const Hypothesis& leaf : robot.tree().fringe()) {
        posteriors.back().push_back(leaf.log_posterior());
        posteriors.back().push_back(leaf.id.value);
      }
    }
    EXPECT_EQ(posteriors[0], posteriors[1]);
  }
}

}  // namespace
}  // namespace cairn::test
