// Beyond the papers: stars are misread now and then, and matching LPMs is right only on average.
// The tree must still find the places of the world, with few too many.

#include <map>
#include <random>
#include <set>
#include <utility>

#include <gtest/gtest.h>

#include "support/lattice.hpp"
#include "topology/hypothesis_tree.hpp"

namespace cairn::test {
namespace {

double uniform(double low, double high, std::mt19937& random) {
  return low + (high - low) * static_cast<double>(random()) / 4294967295.0;
}

/// The star with every fragment taken to terminate.
Star misread(const Star& star) {
  const auto gateways = static_cast<std::size_t>(gateway_count(star));
  Star seen;
  for (std::size_t slot = 0; slot < 2 * gateways; ++slot) {
    const bool leaves = slot < gateways;
    seen.slots.push_back({leaves ? static_cast<int>(slot) : -1, (slot + gateways) % (2 * gateways),
                          leaves ? ControlLaw::kMidline : ControlLaw::kDeadEnd});
  }
  return seen;
}

/// What matching two visits' LPMs says: 8 for the same place and 8 against any other, give or take
/// 6; the same answer whenever it is asked.
class NoisyMatcher {
 public:
  NoisyMatcher(const Walk& walk, unsigned seed) : walk_(walk), seed_(seed) {}

  double operator()(SeenGateway known, SeenGateway now) {
    const auto question = std::pair(known, now);
    const auto answered = answers_.find(question);
    if (answered != answers_.end()) {
      return answered->second;
    }
    // Misread stars keep their gateways, so those of one place have the same numbers.
    const bool is_same =
        walk_.truth[known.visit.index()].first == walk_.truth[now.visit.index()].first &&
        known.gateway == now.gateway;
    std::seed_seq seed{seed_, static_cast<unsigned>(known.visit.value),
                       static_cast<unsigned>(now.visit.value), static_cast<unsigned>(known.gateway),
                       static_cast<unsigned>(now.gateway)};
    std::mt19937 random(seed);
    return answers_[question] = (is_same ? 8.0 : -8.0) + uniform(-6.0, 6.0, random);
  }

 private:
  const Walk& walk_;
  unsigned seed_;
  std::map<std::pair<SeenGateway, SeenGateway>, double> answers_;
};

int wrong_visits(const TopologicalMap& map, const Walk& walk) {
  std::map<PlaceId, int> true_place_of;
  int wrong = 0;
  for (std::size_t visit = 0; visit < walk.truth.size(); ++visit) {
    const PlaceId place = map.at_visit({static_cast<std::int32_t>(visit)}).place;
    const int truth = walk.truth[visit].first;
    wrong += true_place_of.try_emplace(place, truth).first->second == truth ? 0 : 1;
  }
  return wrong;
}

TEST(HypothesisNoise, MisreadStarsCostFewPlacesAndNoFalseClosures) {
  for (unsigned seed = 0; seed < 3; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    Lattice streets(6, 6);
    streets.remove_street(static_cast<int>(random() % 30), 2);
    const Walk walk = streets.walk(0, streets.random_moves(0, 150, random));
    NoisyMatcher matcher(walk, seed);
    Evidence evidence;
    evidence.same_place = [&](SeenGateway known, SeenGateway now) { return matcher(known, now); };
    TopologyOptions options;
    options.noisy_stars = true;
    HypothesisTree tree(options, evidence);
    ASSERT_TRUE(tree.start(walk.start).ok());
    std::set<int> true_places = {walk.truth.front().first};
    int misreadings = 0;
    for (const Experienced& step : walk.steps) {
      View view = step.view;
      if (random() % 33 == 0) {
        view.star = misread(view.star);
        ++misreadings;
      }
      ASSERT_TRUE(tree.extend(step.action, view).ok());
      true_places.insert(walk.truth[view.visit.index()].first);
    }
    const TopologicalMap best = tree.map(tree.best().id);
    EXPECT_EQ(wrong_visits(best, walk), 0);
    EXPECT_GE(best.place_count(), static_cast<int>(true_places.size()));
    EXPECT_LE(best.place_count(), static_cast<int>(true_places.size()) + misreadings);
  }
}

}  // namespace
}  // namespace cairn::test
