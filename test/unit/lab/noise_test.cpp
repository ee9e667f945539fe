#include "bench/lab/worlds/noise.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "bench/lab/worlds/random_exploration.hpp"
#include "bench/lab/worlds/random_world.hpp"
#include "star/isomorphism.hpp"

namespace cairn::lab {
namespace {

constexpr NoiseOptions kAlways{1.0, 1.0, 1.0};

Walk walk_of(unsigned seed) {
  RandomWalkOptions options;
  options.travels = 20;
  return random_walk(random_world({}, seed), options, seed);
}

int arrival_of(const Walk& walk, std::size_t visit) {
  const Exploration& exploration = walk.exploration;
  const int gateway =
      visit == 0 ? exploration.start_gateway : exploration.steps[visit - 1].arrival_gateway;
  return walk.visits[visit].gateways[static_cast<std::size_t>(gateway)];
}

int departure_of(const Walk& walk, std::size_t visit) {
  const Exploration& exploration = walk.exploration;
  const int gateway =
      visit == 0 ? exploration.start_gateway : exploration.steps[visit - 1].arrival_gateway;
  const int count = static_cast<int>(walk.visits[visit].gateways.size());
  const int departure = (gateway + exploration.steps[visit].turn) % count;
  return walk.visits[visit].gateways[static_cast<std::size_t>(departure)];
}

TEST(Noise, WithoutProbabilityChangesNothing) {
  const Walk walk = walk_of(3);
  const Walk same = with_noise(walk, {}, 5);
  ASSERT_EQ(same.exploration.steps.size(), walk.exploration.steps.size());
  for (std::size_t step = 0; step < walk.exploration.steps.size(); ++step) {
    EXPECT_EQ(same.exploration.steps[step].turn, walk.exploration.steps[step].turn);
    EXPECT_EQ(same.exploration.steps[step].star, walk.exploration.steps[step].star);
    EXPECT_EQ(same.visits[step].gateways, walk.visits[step].gateways);
  }
}

TEST(Noise, LeavesTheWayThroughTheWorldAsItIs) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    const Walk walk = walk_of(seed);
    for (const NoiseOptions& options :
         {kAlways, NoiseOptions{1, 0, 0}, NoiseOptions{0, 1, 0}, NoiseOptions{0, 0, 1}}) {
      const Walk noisy = with_noise(walk, options, seed);
      ASSERT_TRUE(validate(noisy.exploration));
      for (std::size_t visit = 0; visit < walk.visits.size(); ++visit) {
        EXPECT_EQ(noisy.visits[visit].place, walk.visits[visit].place);
        EXPECT_EQ(arrival_of(noisy, visit), arrival_of(walk, visit));
        if (visit < walk.exploration.steps.size()) {
          EXPECT_EQ(departure_of(noisy, visit), departure_of(walk, visit));
        }
      }
    }
  }
}

TEST(Noise, MisreadsToAnotherStarWithAsManyGateways) {
  const Walk walk = walk_of(4);
  const Walk noisy = with_noise(walk, {1.0, 0.0, 0.0}, 9);
  for (std::size_t step = 0; step < walk.exploration.steps.size(); ++step) {
    const Star& before = walk.exploration.steps[step].star;
    const Star& after = noisy.exploration.steps[step].star;
    EXPECT_EQ(gateway_count(after), gateway_count(before));
    EXPECT_EQ(noisy.visits[step + 1].is_misread, type_name(after) != type_name(before));
    // There is only one star with one gateway.
    EXPECT_EQ(noisy.visits[step + 1].is_misread, gateway_count(before) > 1);
  }
}

TEST(Noise, CountsGatewaysThatAreMissedAndInvented) {
  const Walk walk = walk_of(5);
  const Walk missed = with_noise(walk, {0.0, 1.0, 0.0}, 9);
  const Walk invented = with_noise(walk, {0.0, 0.0, 1.0}, 9);
  for (std::size_t visit = 0; visit < walk.visits.size(); ++visit) {
    const int count = static_cast<int>(walk.visits[visit].gateways.size());
    EXPECT_EQ(static_cast<int>(missed.visits[visit].gateways.size()),
              count - missed.visits[visit].missed);
    EXPECT_EQ(static_cast<int>(invented.visits[visit].gateways.size()), count + 1);
    EXPECT_EQ(invented.visits[visit].invented, 1);
  }
}

TEST(MatchEvidence, IsTheSameWheneverItIsAsked) {
  const Walk walk = walk_of(6);
  const MatchModel model;
  EXPECT_EQ(match_log_likelihood_ratio(walk, model, 2, 9, 1),
            match_log_likelihood_ratio(walk, model, 2, 9, 1));
  const int count = static_cast<int>(walk.visits[2].gateways.size());
  EXPECT_EQ(match_log_likelihood_ratio(walk, model, 2, 9, 1),
            match_log_likelihood_ratio(walk, model, 2, 9, 1 + count));
  EXPECT_NE(match_log_likelihood_ratio(walk, model, 2, 9, 1),
            match_log_likelihood_ratio(walk, {4.0, 2.83, 1}, 2, 9, 1));
}

TEST(MatchEvidence, HasTheMeanAndDeviationOfItsModel) {
  double sum = 0.0;
  double squares = 0.0;
  int count = 0;
  for (unsigned seed = 0; seed < 100; ++seed) {
    const Walk walk = walk_of(seed);
    for (int later = 1; later <= 20; ++later) {
      for (int earlier = 0; earlier < later; ++earlier) {
        const TrueVisit& a = walk.visits[static_cast<std::size_t>(earlier)];
        const TrueVisit& b = walk.visits[static_cast<std::size_t>(later)];
        // Gateways are numbered clockwise at both visits.
        const auto shift = static_cast<int>(
            std::find(a.gateways.begin(), a.gateways.end(), b.gateways[0]) - a.gateways.begin());
        const bool is_same = a.place == b.place;
        const double ratio =
            match_log_likelihood_ratio(walk, {4.0, 2.0, seed}, earlier, later, shift);
        const double off = ratio - (is_same ? 4.0 : -4.0);
        sum += off;
        squares += off * off;
        ++count;
      }
    }
  }
  EXPECT_NEAR(sum / count, 0.0, 0.05);
  EXPECT_NEAR(std::sqrt(squares / count), 2.0, 0.05);
}

}  // namespace
}  // namespace cairn::lab
