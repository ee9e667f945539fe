#include "refinement/key_scan.hpp"

#include <gtest/gtest.h>

#include "unit/refinement/two_laps.hpp"

namespace cairn {
namespace {

TEST(KeyScanChooser, TakesTheFirstScanAndThenOneForSoMuchMotion) {
  const test::TwoLaps laps;
  ASSERT_GT(laps.keys.size(), 10U);
  EXPECT_EQ(laps.keys.front()->number, 0U);
  for (std::size_t k = 1; k < laps.keys.size(); ++k) {
    const double driven_m = laps.keys[k]->travel_m - laps.keys[k - 1]->travel_m;
    EXPECT_GT(driven_m, KeyScanChooser::kEvery_m - 1e-9);
    EXPECT_LT(driven_m, KeyScanChooser::kEvery_m + 0.25);
  }
}

TEST(KeyScanChooser, ARobotThatTurnsOnTheSpotGetsKeyScansToo) {
  KeyScanChooser chooser;
  const auto scan = std::make_shared<const LaserScan>();
  for (int i = 0; i < 21; ++i) {
    chooser.add(scan, {Pose2(0, 0, 0.1), 1e-6 * Matrix3d::Identity()});
  }
  EXPECT_EQ(chooser.key_scans().size(), 3U);
  EXPECT_DOUBLE_EQ(chooser.key_scans().back()->travel_m, 0.0);
}

TEST(KeyScanChooser, AScanThatIsNotToBeTrustedStandsForNoOthers) {
  KeyScanChooser chooser;
  const auto scan = std::make_shared<const LaserScan>();
  const auto blind = std::make_shared<const LaserScan>();
  const GaussianPose step{Pose2(1.0, 0, 0), 1e-6 * Matrix3d::Identity()};
  chooser.add(scan, step);
  chooser.add(blind, step, false);
  chooser.add(scan, step);
  ASSERT_EQ(chooser.key_scans().size(), 2U);
  EXPECT_EQ(chooser.key_scans().back()->number, 2U);
  EXPECT_DOUBLE_EQ(chooser.key_scans().back()->T_before_this.mean.x(), 2.0);
}

TEST(KeyScanChooser, CompoundsTheMotionBetweenKeyScans) {
  const test::TwoLaps laps;
  Pose2 T_first_key;
  for (std::size_t k = 1; k < laps.keys.size(); ++k) {
    T_first_key = T_first_key * laps.keys[k]->T_before_this.mean;
    const Pose2 believed = laps.believed.front().inverse() * laps.believed[laps.keys[k]->number];
    EXPECT_NEAR((T_first_key.translation() - believed.translation()).norm(), 0.0, 1e-9);
    EXPECT_TRUE(is_positive_definite(laps.keys[k]->T_before_this.covariance));
  }
}

TEST(KeyScanChooser, ALongerWayHasTheSameKeyScansAtItsBeginning) {
  const test::TwoLaps shorter(1, 100);
  const test::TwoLaps longer(1, 150);
  ASSERT_LT(shorter.keys.size(), longer.keys.size());
  for (std::size_t k = 0; k < shorter.keys.size(); ++k) {
    EXPECT_EQ(shorter.keys[k]->number, longer.keys[k]->number);
  }
}

}  // namespace
}  // namespace cairn
