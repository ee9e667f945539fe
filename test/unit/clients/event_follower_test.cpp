#include "clients/cairn/event_follower.hpp"

#include <algorithm>
#include <random>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cairn::clients {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

cairn_lcm::place_event_t event(std::int64_t number, std::int64_t boot = 1) {
  cairn_lcm::place_event_t e{};
  e.boot_id = boot;
  e.event_number = number;
  return e;
}

class EventFollowerTest : public ::testing::Test {
 protected:
  std::vector<std::int64_t> used_;
  std::vector<std::int64_t> asked_;
  std::vector<std::pair<std::int64_t, std::int64_t>> lost_;
  EventFollower follower_{
      [this](const cairn_lcm::place_event_t& e) { used_.push_back(e.event_number); },
      [this](std::int64_t have) { asked_.push_back(have); },
      [this](std::int64_t first, std::int64_t last) { lost_.emplace_back(first, last); }};
};

TEST_F(EventFollowerTest, AGapIsAskedForAndFilled) {
  follower_.on_event(event(5));
  follower_.on_event(event(7));
  for (std::int64_t now = 0; now < 300'000; now += 50'000) {
    follower_.tick(now);
  }
  EXPECT_THAT(used_, ElementsAre(5));
  EXPECT_THAT(asked_, ElementsAre(5));

  follower_.on_event(event(6));
  EXPECT_THAT(used_, ElementsAre(5, 6, 7));
}

TEST_F(EventFollowerTest, TheHeartbeatShowsThatTheLastEventWasLost) {
  follower_.on_status(1, 3);
  follower_.tick(0);
  follower_.tick(1'000'000);
  EXPECT_THAT(asked_, IsEmpty());

  follower_.on_status(1, 4);
  follower_.tick(2'000'000);
  follower_.tick(3'000'000);
  EXPECT_THAT(asked_, ElementsAre(3));
}

TEST_F(EventFollowerTest, AGapThatNobodyFillsIsGivenUpWithANote) {
  follower_.on_event(event(1));
  follower_.on_event(event(4));
  for (std::int64_t now = 0; now < 10'000'000; now += 50'000) {
    follower_.tick(now);
  }
  EXPECT_THAT(lost_, ElementsAre(std::make_pair(2, 3)));
  EXPECT_THAT(used_, ElementsAre(1, 4));
}

TEST_F(EventFollowerTest, ARestartedDaemonCountsAfresh) {
  follower_.on_event(event(8, 1));
  follower_.on_event(event(1, 2));
  follower_.on_event(event(2, 2));
  EXPECT_THAT(used_, ElementsAre(8, 1, 2));
}

TEST_F(EventFollowerTest, RepeatedAndReorderedEventsComeOnceAndInOrder) {
  for (unsigned seed = 0; seed < 50; ++seed) {
    used_.clear();
    const std::int64_t boot = 10 + seed;
    std::vector<std::int64_t> numbers{2, 3, 4, 5, 6, 7, 8, 2, 4, 8};
    std::shuffle(numbers.begin(), numbers.end(), std::mt19937(seed));
    follower_.on_event(event(1, boot));
    for (const std::int64_t number : numbers) {
      follower_.on_event(event(number, boot));
    }
    EXPECT_THAT(used_, ElementsAre(1, 2, 3, 4, 5, 6, 7, 8));
  }
}

}  // namespace
}  // namespace cairn::clients
