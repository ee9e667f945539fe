#include "refinement/trajectory_refiner.hpp"

#include <gmock/gmock.h>

#include "unit/refinement/two_laps.hpp"

namespace cairn {
namespace {

using test::TwoLaps;
using ::testing::HasSubstr;

TrajectoryRefinementOptions for_a_small_room() {
  TrajectoryRefinementOptions options;
  options.matching.apart_m = 8.0;
  return options;
}

class RefinedLaps : public ::testing::TestWithParam<unsigned> {};

TEST_P(RefinedLaps, LieOnEachOther) {
  const TwoLaps laps(GetParam());
  TrajectoryRefiner refiner(for_a_small_room());
  const Result<RefinedTrajectory> refined = refiner.refine(laps.believed, laps.keys, {});
  ASSERT_TRUE(refined) << refined.error().message;
  EXPECT_LT(laps.laps_apart_m(refined->T_global_robot), 0.02);
  EXPECT_GT(laps.laps_apart_m(laps.believed), 2 * laps.laps_apart_m(refined->T_global_robot));
  EXPECT_LT(laps.error_m(refined->T_global_robot), laps.error_m(laps.believed));
  EXPECT_EQ(refined->let_go, 0);
}

TEST_P(RefinedLaps, DependOnNothingButWhatIsGiven) {
  const TwoLaps laps(GetParam());
  const TwoLaps others(GetParam() + 100);
  TrajectoryRefiner used(for_a_small_room());
  TrajectoryRefiner fresh(for_a_small_room());
  static_cast<void>(used.refine(laps.truth, laps.keys, {}));
  const Result<RefinedTrajectory> again = used.refine(laps.believed, laps.keys, {});
  const Result<RefinedTrajectory> first = fresh.refine(laps.believed, laps.keys, {});
  ASSERT_TRUE(again && first);
  EXPECT_EQ(again->T_global_robot, first->T_global_robot);
}

INSTANTIATE_TEST_SUITE_P(Seeds, RefinedLaps, ::testing::Values(1U, 2U, 3U, 4U));

TEST(TrajectoryRefiner, AWayWithoutAnotherPassageStaysAsItIs) {
  const TwoLaps lap(1, 40);
  TrajectoryRefiner refiner(for_a_small_room());
  const Result<RefinedTrajectory> refined = refiner.refine(lap.believed, lap.keys, {});
  ASSERT_TRUE(refined);
  EXPECT_EQ(refined->matches, 0);
  for (std::size_t i = 0; i < lap.believed.size(); ++i) {
    EXPECT_NEAR((refined->T_global_robot[i].translation() - lap.believed[i].translation()).norm(),
                0.0, 1e-6);
  }
}

TEST(TrajectoryRefiner, DoesNothingWhereItIsSwitchedOff) {
  const TwoLaps laps;
  TrajectoryRefinementOptions options = for_a_small_room();
  options.enabled = false;
  TrajectoryRefiner refiner(options);
  EXPECT_EQ(refiner.refine(laps.believed, laps.keys, {})->T_global_robot, laps.believed);
}

TEST(TrajectoryRefiner, TakesNothingAndOneScan) {
  TrajectoryRefiner refiner;
  EXPECT_TRUE(refiner.refine({}, {}, {})->T_global_robot.empty());
  const TwoLaps one(1, 1);
  EXPECT_EQ(refiner.refine(one.believed, one.keys, {})->T_global_robot, one.believed);
}

TEST(TrajectoryRefiner, BringsTogetherWhatTheLayoutSaysIsOnePlace) {
  const TwoLaps lap(1, 60);
  const SamePlace same{
      1, 58, {lap.truth[1].inverse() * lap.truth[58], 1e-6 * Matrix3d::Identity()}};
  TrajectoryRefinementOptions options;  // Nothing is so far apart that it would be matched.
  TrajectoryRefiner refiner(options);
  const Result<RefinedTrajectory> refined = refiner.refine(lap.believed, lap.keys, {same});
  ASSERT_TRUE(refined);
  const auto off_m = [&](const std::vector<Pose2>& poses) {
    return ((poses[1].inverse() * poses[58]).translation() - same.T_scan_other.mean.translation())
        .norm();
  };
  EXPECT_LT(off_m(refined->T_global_robot), 0.5 * off_m(lap.believed));
}

TEST(TrajectoryRefiner, LetsGoOfWhatContradictsAllElse) {
  const TwoLaps laps;
  const SamePlace wrong{10, 100, {Pose2(3.0, 2.0, 1.0), 1e-4 * Matrix3d::Identity()}};
  TrajectoryRefiner refiner(for_a_small_room());
  const Result<RefinedTrajectory> refined = refiner.refine(laps.believed, laps.keys, {wrong});
  ASSERT_TRUE(refined);
  EXPECT_LT(laps.laps_apart_m(refined->T_global_robot), 0.05);
}

TEST(TrajectoryRefiner, TheSecondLapIsSurerForTheFirst) {
  const TwoLaps laps;
  TrajectoryRefiner with_matches(for_a_small_room());
  TrajectoryRefinementOptions options;
  options.matching.apart_m = 1000.0;  // Nothing is matched.
  TrajectoryRefiner without_matches(options);
  const Result<RefinedTrajectory> sure = with_matches.refine(laps.believed, laps.keys, {});
  const Result<RefinedTrajectory> unsure = without_matches.refine(laps.believed, laps.keys, {});
  ASSERT_TRUE(sure && unsure);
  ASSERT_EQ(sure->key_covariances.size(), laps.keys.size());
  EXPECT_EQ(sure->key_covariances.front(), Matrix3d::Zero());
  for (std::size_t k = 1; k < laps.keys.size(); ++k) {
    EXPECT_TRUE(is_positive_definite(sure->key_covariances[k])) << k;
  }
  EXPECT_LT(sure->key_covariances.back().trace(), 0.5 * unsure->key_covariances.back().trace());
}

TEST(TrajectoryRefiner, TheFirstPoseStaysWhereItIs) {
  const TwoLaps laps;
  TrajectoryRefiner refiner(for_a_small_room());
  const Result<RefinedTrajectory> refined = refiner.refine(laps.believed, laps.keys, {});
  ASSERT_TRUE(refined);
  EXPECT_NEAR(
      (refined->T_global_robot.front().translation() - laps.believed.front().translation()).norm(),
      0.0, 1e-9);
}

TEST(TrajectoryRefinementOptions, NamesWhatIsOutOfRange) {
  TrajectoryRefinementOptions options;
  options.rounds = 0;
  EXPECT_THAT(validate(options).error().message, HasSubstr("rounds"));
  options.matching.min_score = 2.0;
  EXPECT_THAT(validate(options).error().message, HasSubstr("min_score"));
}

}  // namespace
}  // namespace cairn
