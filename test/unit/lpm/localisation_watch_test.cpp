// When the robot is lost, when it is found, and what is said of it.

#include "lpm/localisation_watch.hpp"

#include <gmock/gmock.h>

namespace cairn {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

using State = LocalisationState;
using Cause = LocalisationCause;

LocalFix matched_fix() {
  LocalFix fix;
  fix.is_matched = true;
  fix.note = FixNote::kMatched;
  fix.covariance = 1e-4 * Matrix3d::Identity();
  fix.motion.covariance = 1e-4 * Matrix3d::Identity();
  return fix;
}

/// Dead reckoning that adds a variance of 0.04 m^2 per step.
LocalFix refused_fix(FixNote note) {
  LocalFix fix = matched_fix();
  fix.is_matched = false;
  fix.note = note;
  fix.motion.covariance = Eigen::Vector3d(0.04, 0.04, 1e-4).asDiagonal();
  return fix;
}

LocalFix faulty_fix(MotionFault fault) {
  LocalFix fix = matched_fix();
  fix.fault = fault;
  return fix;
}

class LocalisationWatchTest : public testing::Test {
 protected:
  void observe(const LocalFix& fix, int times = 1, bool has_odometry = true) {
    for (int i = 0; i < times; ++i) {
      watch_.observe(fix, has_odometry);
    }
  }
  [[nodiscard]] State state() const { return watch_.health().state; }
  [[nodiscard]] std::string reason() const { return reason_of(watch_.health(), options_); }

  LocalisationOptions options_;
  LocalisationWatch watch_{options_};
};

TEST_F(LocalisationWatchTest, TracksFromTheFirstScanOn) {
  EXPECT_EQ(state(), State::kStarting);
  observe(matched_fix());
  EXPECT_EQ(state(), State::kTracking);
  EXPECT_THAT(reason(), IsEmpty());
  EXPECT_TRUE(watch_.may_map());
}

TEST_F(LocalisationWatchTest, AnErrorBeyondTheUpperBoundIsLostAndNothingIsMapped) {
  observe(matched_fix());
  observe(refused_fix(FixNote::kContradiction), 10);
  EXPECT_EQ(state(), State::kDegraded);
  EXPECT_TRUE(watch_.may_map());
  observe(refused_fix(FixNote::kContradiction), 16);
  EXPECT_GT(watch_.health().error_m, options_.error_max_m);
  EXPECT_EQ(state(), State::kLost);
  EXPECT_EQ(watch_.health().cause, Cause::kNotMatched);
  EXPECT_EQ(watch_.health().times_lost, 1);
  EXPECT_FALSE(watch_.may_map());
  EXPECT_FALSE(watch_.may_see_places());
  EXPECT_GT(watch_.health().scans_not_mapped, 0);
  EXPECT_THAT(reason(), HasSubstr("lost above 1.0 m"));
}

TEST_F(LocalisationWatchTest, ALostRobotIsFoundOnlyByMatchesInARow) {
  observe(matched_fix());
  observe(refused_fix(FixNote::kBlockedSensor), 40);
  ASSERT_TRUE(watch_.is_lost());
  EXPECT_EQ(watch_.health().cause, Cause::kBlockedSensor);
  observe(matched_fix(), options_.found_scans - 1);
  EXPECT_TRUE(watch_.is_lost()) << "though the error is small";
  observe(refused_fix(FixNote::kNoOverlap));
  observe(matched_fix(), options_.found_scans - 1);
  EXPECT_TRUE(watch_.is_lost());
  observe(matched_fix());
  EXPECT_FALSE(watch_.is_lost());
  EXPECT_EQ(state(), State::kDegraded) << "until it has gone well for a while";
  observe(matched_fix(), options_.calm_scans);
  EXPECT_EQ(state(), State::kTracking);
  EXPECT_EQ(watch_.health().times_lost, 1);
}

TEST_F(LocalisationWatchTest, BetweenTheBoundsNothingChanges) {
  LocalFix vague = refused_fix(FixNote::kMatched);
  vague.is_matched = true;
  vague.is_degenerate = true;
  observe(matched_fix());
  observe(vague, 10);
  EXPECT_EQ(state(), State::kDegraded);
  EXPECT_EQ(watch_.health().cause, Cause::kErrorGrown);
  EXPECT_FALSE(watch_.is_lost()) << "it was not";
  observe(vague, 30);
  EXPECT_TRUE(watch_.is_lost());
  vague.motion.covariance *= 0.0;
  observe(vague, 30);
  EXPECT_TRUE(watch_.is_lost()) << "matches that do not say where along the corridor find nobody";
}

TEST_F(LocalisationWatchTest, ACoveredLaserNeverAsksForANewMapButAStrangePlaceDoes) {
  observe(matched_fix());
  observe(refused_fix(FixNote::kBlockedSensor), 500);
  EXPECT_FALSE(watch_.needs_new_map());
  observe(refused_fix(FixNote::kContradiction), options_.new_map_scans - 1);
  EXPECT_FALSE(watch_.needs_new_map());
  observe(refused_fix(FixNote::kContradiction));
  EXPECT_TRUE(watch_.needs_new_map());
  watch_.started_new_map();
  EXPECT_FALSE(watch_.needs_new_map());
}

TEST_F(LocalisationWatchTest, InANewMapTheRobotIsLostUntilScansFitIt) {
  observe(matched_fix(), 20);
  observe(refused_fix(FixNote::kContradiction), 5);
  watch_.started_new_map();
  EXPECT_EQ(state(), State::kLost);
  EXPECT_EQ(watch_.health().cause, Cause::kNewMap);
  EXPECT_EQ(watch_.health().times_lost, 1);
  EXPECT_TRUE(watch_.may_map()) << "it must grow";
  EXPECT_FALSE(watch_.may_see_places());
  observe(matched_fix(), options_.found_scans);
  EXPECT_TRUE(watch_.may_see_places());
  observe(matched_fix(), options_.calm_scans);
  EXPECT_EQ(state(), State::kTracking);
}

TEST_F(LocalisationWatchTest, AFaultIsCountedWhenItBeginsAndHeldUntilItIsCalm) {
  observe(matched_fix());
  observe(faulty_fix(MotionFault::kSlip), 4);
  observe(matched_fix(), options_.calm_scans - 1);
  observe(faulty_fix(MotionFault::kSlip));
  EXPECT_EQ(watch_.health().count(MotionFault::kSlip), 1);
  EXPECT_EQ(state(), State::kDegraded);
  EXPECT_EQ(watch_.health().fault, MotionFault::kSlip);
  EXPECT_THAT(reason(), HasSubstr("slip"));
  observe(matched_fix(), options_.calm_scans);
  EXPECT_EQ(state(), State::kTracking);
  observe(faulty_fix(MotionFault::kSlip));
  EXPECT_EQ(watch_.health().count(MotionFault::kSlip), 2);
}

TEST_F(LocalisationWatchTest, AMatchThatIsWorseSinceABumpIsDoubtedAndInTheEndNeedsANewMap) {
  LocalFix good = matched_fix();
  good.score = 0.97;
  observe(good, 30);
  LocalFix so_so = good;
  so_so.score = 0.7;
  observe(so_so, 3);
  EXPECT_EQ(state(), State::kTracking) << "a worse score alone may be clutter";
  observe(good, 30);
  LocalFix bump = so_so;
  bump.fault = MotionFault::kBump;
  observe(bump);
  EXPECT_EQ(watch_.health().cause, Cause::kDoubt);
  EXPECT_FALSE(watch_.may_map());
  observe(so_so, options_.new_map_scans - 2);
  EXPECT_FALSE(watch_.needs_new_map());
  observe(so_so);
  EXPECT_TRUE(watch_.needs_new_map());
}

TEST_F(LocalisationWatchTest, AMatchThatIsAsGoodAsEverAfterABumpIsTrusted) {
  LocalFix good = matched_fix();
  good.score = 0.97;
  observe(good, 30);
  LocalFix bump = good;
  bump.fault = MotionFault::kBump;
  observe(bump);
  EXPECT_TRUE(watch_.may_map());
  bump.score = 0.7;
  observe(bump);
  EXPECT_FALSE(watch_.may_map());
  observe(good, options_.patience_scans);
  EXPECT_TRUE(watch_.may_map()) << "doubt ends with good matches";
}

TEST_F(LocalisationWatchTest, AWrongMountingOutlastsSmallerFaultsAndSaysWhatToCheck) {
  observe(matched_fix());
  observe(faulty_fix(MotionFault::kLaserReversed));
  observe(faulty_fix(MotionFault::kSlip));
  EXPECT_EQ(watch_.health().fault, MotionFault::kLaserReversed);
  EXPECT_THAT(reason(), HasSubstr("the laser looks backward: check the mounting pose"));
}

TEST_F(LocalisationWatchTest, EveryFaultHasANameAndAnAdvice) {
  for (std::size_t i = 1; i < LocalisationHealth::kFaults; ++i) {
    const auto fault = static_cast<MotionFault>(i);
    EXPECT_NE(to_string(fault), "unknown");
    EXPECT_GT(advice_for(fault).size(), 20U) << to_string(fault);
  }
  EXPECT_EQ(to_string(static_cast<MotionFault>(LocalisationHealth::kFaults)), "unknown")
      << "more faults than are counted";
}

TEST_F(LocalisationWatchTest, NoOdometryIsSaidAndForHowLong) {
  observe(matched_fix(), options_.patience_scans, false);
  EXPECT_EQ(state(), State::kDegraded);
  EXPECT_EQ(watch_.health().cause, Cause::kNoOdometry);
  EXPECT_FALSE(watch_.health().uses_odometry);
  watch_.heard_odometry(time_of_utime(0));
  for (int s = 0; s <= 90; ++s) {
    watch_.heard_scan(time_of_utime(1'000'000L * s));
  }
  EXPECT_NEAR(watch_.health().no_odometry_s, 90.0, 1e-9);
}

TEST_F(LocalisationWatchTest, NoScansIsSaidWhileOdometryGoesOn) {
  watch_.heard_scan(time_of_utime(0));
  observe(matched_fix());
  for (int i = 0; i <= 1200; ++i) {
    watch_.heard_odometry(time_of_utime(100'000L * i));
  }
  EXPECT_NEAR(watch_.health().no_scans_s, 120.0, 1e-9);
  EXPECT_EQ(state(), State::kDegraded);
  EXPECT_THAT(reason(), HasSubstr("no scan for 120.0 s"));
  watch_.heard_scan(time_of_utime(120'000'000L));
  observe(matched_fix(), options_.calm_scans);
  EXPECT_EQ(state(), State::kTracking);
}

TEST_F(LocalisationWatchTest, AClockThatStepsIsNoSilence) {
  watch_.heard_scan(time_of_utime(0));
  observe(matched_fix());
  watch_.heard_odometry(time_of_utime(1'000));
  watch_.heard_scan(time_of_utime(2'000));
  watch_.heard_odometry(time_of_utime(-7'200'000'000L));
  watch_.heard_odometry(time_of_utime(-7'199'990'000L));
  EXPECT_LT(watch_.health().no_scans_s, options_.silence_s);
  EXPECT_EQ(state(), State::kTracking);
}

TEST_F(LocalisationWatchTest, ChangesAreNewsOnceAndNumbersAreNot) {
  observe(matched_fix());
  observe(faulty_fix(MotionFault::kSlip));
  const LocalisationHealth before = watch_.health();
  observe(faulty_fix(MotionFault::kSlip));
  EXPECT_TRUE(is_alike(before, watch_.health()));
  observe(faulty_fix(MotionFault::kBump));
  EXPECT_FALSE(is_alike(before, watch_.health()));
}

TEST(LocalisationOptions, TheBoundsMustBeInTheirOrder) {
  LocalisationOptions options;
  options.error_min_m = 0.8;
  options.error_max_m = 0.5;
  EXPECT_FALSE(validate(options).ok());
  EXPECT_TRUE(validate(LocalisationOptions()).ok());
}

}  // namespace
}  // namespace cairn
