#include "topology/deferred.hpp"

#include <algorithm>
#include <numeric>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cairn::test {
namespace {

using ::testing::ElementsAre;

Leaf leaf_number(int number) {
  Leaf leaf;
  leaf.place_count = number;
  return leaf;
}

Rank rank_of(double log_posterior, int age = 0) {
  Rank rank;
  rank.log_posterior = log_posterior;
  rank.age = age;
  return rank;
}

TEST(DeferredLeaves, GiveTheBestFirst) {
  DeferredLeaves waiting(Preference::kPosterior);
  std::mt19937 random(3);
  std::vector<int> order(100);
  std::iota(order.begin(), order.end(), 0);
  std::shuffle(order.begin(), order.end(), random);
  for (const int number : order) {
    waiting.add(leaf_number(number), rank_of(-number));
  }
  for (int number = 0; number < 100; ++number) {
    EXPECT_EQ(waiting.best_rank().log_posterior, -number);
    EXPECT_EQ(waiting.take_best().place_count, number);
  }
  EXPECT_TRUE(waiting.empty());
}

TEST(DeferredLeaves, GiveTheOlderOfEquals) {
  DeferredLeaves waiting(Preference::kPosterior);
  waiting.add(leaf_number(1), rank_of(0.0, 7));
  waiting.add(leaf_number(2), rank_of(0.0, 5));
  EXPECT_EQ(waiting.take_best().place_count, 2);
}

TEST(DeferredLeaves, LoseTheWorseHalf) {
  DeferredLeaves waiting(Preference::kPosterior);
  for (const int number : {4, 0, 3, 1, 2}) {
    waiting.add(leaf_number(number), rank_of(-number));
  }
  std::vector<int> worst;
  for (const Leaf& leaf : waiting.take_worst_half()) {
    worst.push_back(leaf.place_count);
  }
  std::sort(worst.begin(), worst.end());
  EXPECT_THAT(worst, ElementsAre(2, 3, 4));
  EXPECT_EQ(waiting.take_best().place_count, 0);
  EXPECT_EQ(waiting.take_worst_half().size(), 1U);
  EXPECT_TRUE(waiting.empty());
}

TEST(DeferredLeaves, TakeMemoryForThoseThatWaitOnly) {
  DeferredLeaves waiting(Preference::kPosterior);
  EXPECT_EQ(waiting.bytes(), 0U);
  for (int number = 0; number < 64; ++number) {
    waiting.add(leaf_number(number), rank_of(-number));
  }
  const std::size_t full = waiting.bytes();
  EXPECT_EQ(waiting.take_worst_half().size(), 32U);
  EXPECT_EQ(waiting.bytes(), full / 2);
  EXPECT_EQ(waiting.take_all().size(), 32U);
  EXPECT_EQ(waiting.count(), 0U);
}

TEST(Rank, IsByPosteriorOrBySimplicityFirst) {
  Rank likely = rank_of(-1.0);
  likely.path_count = 5;
  Rank simple = rank_of(-2.0);
  simple.path_count = 4;
  EXPECT_TRUE(comes_before(likely, simple, Preference::kPosterior));
  EXPECT_TRUE(comes_before(simple, likely, Preference::kSimplest));
  simple.contradictions = 1;
  EXPECT_FALSE(comes_before(simple, likely, Preference::kSimplest));
  EXPECT_FALSE(comes_before(simple, simple, Preference::kSimplest));
}

}  // namespace
}  // namespace cairn::test
