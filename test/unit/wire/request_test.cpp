#include "wire/request.hpp"

#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cairn::wire {
namespace {

using ::testing::ElementsAre;
using Step = RequestRetry::Step;

constexpr std::int64_t kMillisecond = 1'000;

/// Times of sending in milliseconds, until it gives up.
std::vector<std::int64_t> sends(RequestRetry* retry, std::int64_t* gave_up_ms) {
  std::vector<std::int64_t> times;
  for (std::int64_t t = 0; t < 60'000; ++t) {
    const Step step = retry->step(t * kMillisecond);
    if (step == Step::kSend) {
      times.push_back(t);
    } else if (step == Step::kGiveUp) {
      *gave_up_ms = t;
      return times;
    }
  }
  return times;
}

TEST(RequestRetry, WaitsLongerEachTimeAndGivesUpAfterSixTries) {
  RequestRetry retry;
  std::int64_t gave_up_ms = 0;
  EXPECT_THAT(sends(&retry, &gave_up_ms), ElementsAre(0, 250, 625, 1188, 2032, 3298));
  EXPECT_EQ(gave_up_ms, 5197);
}

TEST(RequestRetry, AnAcceptedRequestGetsItsTriesBack) {
  RequestRetry retry;
  for (int i = 0; i < 6; ++i) {
    (void)retry.step(i * 2'000'000);
  }
  retry.accepted(11'000'000);
  EXPECT_EQ(retry.step(12'999'999), Step::kWait);
  EXPECT_EQ(retry.step(13'000'000), Step::kSend);
}

TEST(RequestRetry, ABusyServerIsAskedAgainWhenItSays) {
  RequestRetry retry({.tries = 1});
  EXPECT_EQ(retry.step(0), Step::kSend);
  retry.busy(0, 700 * kMillisecond);
  EXPECT_EQ(retry.step(699 * kMillisecond), Step::kWait);
}

TEST(ResultCache, GivesARepeatedRequestItsStoredResult) {
  ResultCache cache;
  EXPECT_EQ(cache.find(1, 1), nullptr);
  cache.store(1, 1, {"CAIRN_RESULT", {1}});
  ASSERT_NE(cache.find(1, 1), nullptr);
  EXPECT_THAT(cache.find(1, 1)->bytes, ElementsAre(1));
  EXPECT_EQ(cache.find(1, 2), nullptr);
  EXPECT_EQ(cache.find(2, 1), nullptr);
}

TEST(ResultCache, TheFinalResultTakesThePlaceOfAccepted) {
  ResultCache cache;
  cache.store(1, 1, {"CAIRN_RESULT", {1}});
  cache.store(1, 1, {"CAIRN_PLAN", {2}});
  EXPECT_EQ(cache.find(1, 1)->channel, "CAIRN_PLAN");
}

TEST(ResultCache, KeepsTheLastSixteenOfAClient) {
  ResultCache cache;
  for (std::int32_t request = 1; request <= 17; ++request) {
    cache.store(1, request, {});
  }
  EXPECT_EQ(cache.find(1, 1), nullptr);
  EXPECT_NE(cache.find(1, 2), nullptr);
}

TEST(ResultCache, ForgetsTheClientThatWasSilentLongest) {
  ResultCache cache;
  for (std::int64_t client = 1; client <= 64; ++client) {
    cache.store(client, 1, {});
  }
  cache.store(1, 2, {});
  cache.store(65, 1, {});
  EXPECT_NE(cache.find(1, 1), nullptr);
  EXPECT_EQ(cache.find(2, 1), nullptr);
}

}  // namespace
}  // namespace cairn::wire
