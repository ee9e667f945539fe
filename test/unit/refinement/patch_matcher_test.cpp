#include "refinement/patch_matcher.hpp"

#include <cmath>

#include <gmock/gmock.h>

#include "unit/refinement/two_laps.hpp"

namespace cairn {
namespace {

using test::TwoLaps;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::vector<Pose2> at_keys(const KeyScans& keys, const std::vector<Pose2>& poses) {
  std::vector<Pose2> chosen;
  for (const auto& key : keys) {
    chosen.push_back(poses[key->number]);
  }
  return chosen;
}

PatchMatchOptions for_a_small_room() {
  PatchMatchOptions options;
  options.apart_m = 8.0;
  return options;
}

TEST(PatchMatcher, LaysTheSecondLapOnTheFirst) {
  const TwoLaps laps;
  PatchMatcher matcher(for_a_small_room());
  const std::vector<PatchMatch> matches =
      matcher.match(laps.keys, at_keys(laps.keys, laps.believed));
  ASSERT_GT(matches.size(), laps.keys.size() / 3);
  for (const PatchMatch& match : matches) {
    const KeyScan& patch = *laps.keys[static_cast<std::size_t>(match.patch)];
    const KeyScan& key = *laps.keys[static_cast<std::size_t>(match.key)];
    EXPECT_GE(std::abs(patch.travel_m - key.travel_m), 8.0);
    const Pose2 truly = laps.truth[patch.number].inverse() * laps.truth[key.number];
    EXPECT_LT((match.T_patch_key.mean.translation() - truly.translation()).norm(), 0.03);
    EXPECT_LT(std::abs(turn_between(match.T_patch_key.mean.theta(), truly.theta())), 0.01);
    EXPECT_TRUE(is_positive_definite(match.T_patch_key.covariance));
  }
}

TEST(PatchMatcher, OneLapHasNothingToBeLaidOn) {
  const TwoLaps lap(1, 40);
  PatchMatcher matcher(for_a_small_room());
  EXPECT_THAT(matcher.match(lap.keys, at_keys(lap.keys, lap.believed)), IsEmpty());
}

TEST(PatchMatcher, WhatIsRememberedIsWhatWouldBeMatchedAgain) {
  const TwoLaps laps;
  PatchMatcher fresh(for_a_small_room());
  PatchMatcher used(for_a_small_room());
  const std::vector<Pose2> at = at_keys(laps.keys, laps.believed);
  std::vector<Pose2> elsewhere = at_keys(laps.keys, laps.truth);
  static_cast<void>(used.match(laps.keys, elsewhere));
  const std::vector<PatchMatch> again = used.match(laps.keys, at);
  const std::vector<PatchMatch> first = fresh.match(laps.keys, at);
  ASSERT_EQ(again.size(), first.size());
  for (std::size_t i = 0; i < first.size(); ++i) {
    EXPECT_EQ(again[i].T_patch_key.mean, first[i].T_patch_key.mean);
    EXPECT_EQ(again[i].T_patch_key.covariance, first[i].T_patch_key.covariance);
  }
  const std::int64_t made = used.matches_made();
  static_cast<void>(used.match(laps.keys, at));
  EXPECT_EQ(used.matches_made(), made);
}

TEST(PatchMatcher, ALongerWayMatchesAnewOnlyWhatIsNew) {
  const TwoLaps shorter(1, 140);
  const TwoLaps longer(1, 150);
  PatchMatcher grown(for_a_small_room());
  static_cast<void>(grown.match(shorter.keys, at_keys(shorter.keys, shorter.believed)));
  grown.forget_unused();
  const std::int64_t before = grown.matches_made();
  static_cast<void>(grown.match(longer.keys, at_keys(longer.keys, longer.believed)));
  EXPECT_LT(grown.matches_made() - before, before / 3);
}

TEST(PatchMatcher, WhatWasNotAskedForIsForgotten) {
  const TwoLaps laps;
  PatchMatcher matcher(for_a_small_room());
  const std::vector<Pose2> at = at_keys(laps.keys, laps.believed);
  static_cast<void>(matcher.match(laps.keys, at));
  matcher.forget_unused();
  matcher.forget_unused();
  const std::int64_t before = matcher.matches_made();
  static_cast<void>(matcher.match(laps.keys, at));
  EXPECT_EQ(matcher.matches_made(), 2 * before);
}

TEST(PatchMatchOptions, NamesWhatIsOutOfRange) {
  PatchMatchOptions options;
  options.near_m = std::nan("");
  options.passes = 0;
  const Status status = validate(options);
  ASSERT_FALSE(status.ok());
  EXPECT_THAT(status.error().message, HasSubstr("near_m"));
  EXPECT_THAT(status.error().message, HasSubstr("passes"));
}

}  // namespace
}  // namespace cairn
