#include "bench/lab/trajectory_errors.hpp"

#include <gmock/gmock.h>

namespace cairn::lab {
namespace {

using ::testing::SizeIs;

/// A robot on a line, 1 m a second.
std::vector<TrackedPose> on_a_line(int seconds) {
  std::vector<TrackedPose> track;
  for (int i = 0; i <= seconds; ++i) {
    track.push_back({1.0 * i, Pose2(i, 0.0, 0.0), 1.0 * i});
  }
  return track;
}

TEST(TravelShares, HalfOfAnErrorFallsToTheTravelOfEachEnd) {
  const std::vector<Relation> relations = {
      {1.0, 2.0, Pose2(1.0, 0.3, 0.0)},    // both ends before the first visit
      {2.0, 12.0, Pose2(10.0, 0.1, 0.0)},  // one end in the second travel
      {3.0, 4.0, Pose2(1.0, 0.0, 0.0)}};
  const std::vector<TravelShare> shares =
      shares_of_travels(relations, on_a_line(20), {{0, 0.0}, {1, 10.0}, {2, 15.0}});
  ASSERT_THAT(shares, SizeIs(3));
  EXPECT_EQ(shares[0].visit, 0);
  EXPECT_EQ(shares[0].relations, 5);
  EXPECT_NEAR(shares[0].share, 0.35 / 0.4, 1e-9);
  EXPECT_NEAR(shares[0].mean_m, (2 * 0.3 + 0.1) / 5, 1e-9);
  EXPECT_EQ(shares[1].visit, 1);
  EXPECT_EQ(shares[1].relations, 1);
  EXPECT_NEAR(shares[1].share, 0.05 / 0.4, 1e-9);
  EXPECT_EQ(shares[2].relations, 0);
  EXPECT_EQ(shares[2].share, 0.0);
}

TEST(TravelShares, RelationsWithoutPosesAreLeftOut) {
  const std::vector<TravelShare> shares =
      shares_of_travels({{1.0, 99.0, Pose2()}, {50.0, 1.0, Pose2()}}, on_a_line(5), {{0, 0.0}});
  ASSERT_THAT(shares, SizeIs(1));
  EXPECT_EQ(shares[0].relations, 0);
  EXPECT_EQ(shares[0].share, 0.0);
}

}  // namespace
}  // namespace cairn::lab
