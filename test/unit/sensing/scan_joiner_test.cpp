#include "sensing/scan_joiner.hpp"

#include <random>
#include <vector>

#include <gmock/gmock.h>

namespace cairn {
namespace {

using ::testing::ElementsAre;
using ::testing::SizeIs;

TimePoint at(double seconds) {
  return time_of_utime(1'000'000'000 + static_cast<std::int64_t>(std::llround(seconds * 1e6)));
}

OdometrySample odometry(double seconds, double x_m) {
  return {at(seconds), Pose2(x_m, 0.0, 0.0)};
}

LaserScan scan(double seconds, float range_m = 1.0F) {
  LaserScan scan;
  scan.time = at(seconds);
  scan.bearings_rad = {0.0F, 1.0F};
  scan.ranges_m = {range_m, 2.0F};
  scan.max_range_m = 10.0;
  return scan;
}

/// x of every joined scan; -1 for one without odometry.
std::vector<double> joined_x(ScanJoiner* joiner) {
  std::vector<double> xs;
  while (const auto joined = joiner->next()) {
    xs.push_back(joined->T_odom_robot ? joined->T_odom_robot->x() : -1.0);
  }
  return xs;
}

LaserScan scan_of(int laser, double seconds, float range_m = 1.0F) {
  LaserScan one = scan(seconds, range_m);
  one.laser = laser;
  return one;
}

/// The laser of every joined scan.
std::vector<int> joined_lasers(ScanJoiner* joiner) {
  std::vector<int> lasers;
  while (const auto joined = joiner->next()) {
    lasers.push_back(joined->scan.laser);
  }
  return lasers;
}

TEST(ScanJoiner, TwoLasersOfOneStampTakeTheSameSampleAtOnce) {
  ScanJoiner joiner;
  joiner.add(odometry(1.0, 5.0));
  joiner.add(scan_of(0, 1.0));
  joiner.add(scan_of(1, 1.0));
  EXPECT_THAT(joined_x(&joiner), ElementsAre(5.0, 5.0));
  EXPECT_EQ(joiner.counters().out_of_order, 0U);
  EXPECT_EQ(joiner.counters().duplicates, 0U);
}

TEST(ScanJoiner, ALaserThatLagsBehindAnotherDoesNotWaitAndIsNotOutOfOrder) {
  ScanJoiner joiner;
  joiner.add(odometry(1.0, 1.0));
  joiner.add(odometry(1.2, 3.0));
  joiner.add(scan_of(0, 1.15));
  joiner.add(scan_of(1, 1.05));
  EXPECT_THAT(joined_x(&joiner),
              ElementsAre(::testing::DoubleNear(2.5, 1e-9), ::testing::DoubleNear(1.5, 1e-9)));
  EXPECT_EQ(joiner.counters().out_of_order, 0U);
}

TEST(ScanJoiner, ScansOfTwoLasersThatWaitTogetherComeOutInTheOrderOfTheirStamps) {
  ScanJoiner joiner;
  joiner.add(odometry(1.0, 1.0));
  joiner.add(scan_of(0, 1.15));
  joiner.add(scan_of(1, 1.05));
  joiner.add(scan_of(1, 1.10));
  joiner.add(odometry(1.2, 3.0));
  EXPECT_THAT(joined_lasers(&joiner), ElementsAre(1, 1, 0));
}

TEST(ScanJoiner, AClockStepThatTwoLasersSeeCountsOnce) {
  ScanJoiner joiner;
  for (const double start_s : {0.0, 8000.0}) {
    for (int i = 0; i < 10; ++i) {
      joiner.add(scan_of(0, start_s + 0.1 * i));
      joiner.add(scan_of(1, start_s + 0.1 * i));
    }
  }
  EXPECT_EQ(joiner.counters().clock_steps, 1U);
}

TEST(ScanJoiner, TellsHowFarOdometryWentSinceTheScanBefore) {
  ScanJoiner joiner;
  double time_s = 0.0;
  for (const double x_m : {0.0, 1.0, 0.0, 1.0, 400.0, 401.0}) {
    joiner.add(odometry(time_s++, x_m));
  }
  joiner.add(scan(5.0));
  joiner.add(odometry(6.0, 401.5));
  joiner.add(scan(6.0));
  EXPECT_DOUBLE_EQ(joiner.next()->odom_way_m, 3.0 + 2.0 + 1.0) << "back and forth; no jump counts";
  EXPECT_DOUBLE_EQ(joiner.next()->odom_way_m, 0.5);
}

TEST(ScanJoiner, PrefersTheSampleOfExactlyTheSameStamp) {
  ScanJoiner joiner;
  joiner.add(odometry(0.9, 9.0));
  joiner.add(odometry(1.0, 5.0));
  joiner.add(scan(1.0));
  EXPECT_THAT(joined_x(&joiner), ElementsAre(5.0));
}

TEST(ScanJoiner, InterpolatesBetweenTheSamplesAround) {
  ScanJoiner joiner;
  joiner.add(odometry(1.0, 1.0));
  joiner.add(scan(1.25));
  EXPECT_THAT(joined_x(&joiner), SizeIs(0)) << "waits for odometry";
  joiner.add(odometry(1.5, 3.0));
  EXPECT_THAT(joined_x(&joiner), ElementsAre(::testing::DoubleEq(2.0)));
}

TEST(ScanJoiner, InterpolatesHeadingsTheShortWayRound) {
  ScanJoiner joiner;
  joiner.add({at(1.0), Pose2(0.0, 0.0, 3.1)});
  joiner.add({at(2.0), Pose2(0.0, 0.0, -3.1)});
  joiner.add(scan(1.5));
  const auto joined = joiner.next();
  ASSERT_TRUE(joined && joined->T_odom_robot);
  EXPECT_NEAR(std::abs(joined->T_odom_robot->theta()), kPi, 1e-9);
}

TEST(ScanJoiner, ExtrapolatesWhenPatienceEnds) {
  ScanJoiner joiner;
  joiner.add(odometry(1.0, 1.0));
  joiner.add(odometry(1.1, 1.1));
  joiner.add(scan(1.2));
  EXPECT_THAT(joined_x(&joiner), SizeIs(0));
  joiner.add(scan(1.7, 3.0F));
  EXPECT_THAT(joined_x(&joiner), ElementsAre(::testing::DoubleNear(1.2, 1e-9)));
}

TEST(ScanJoiner, GoesOnWithoutOdometry) {
  ScanJoiner joiner;
  joiner.add(scan(1.0));
  joiner.add(scan(1.3, 2.0F));
  joiner.add(scan(1.6, 3.0F));
  EXPECT_THAT(joined_x(&joiner), ElementsAre(-1.0));
  joiner.flush();
  EXPECT_THAT(joined_x(&joiner), ElementsAre(-1.0, -1.0));
  EXPECT_EQ(joiner.counters().scans_without_odometry, 3U);
}

TEST(ScanJoiner, DropsExactDuplicatesOnly) {
  ScanJoiner joiner;
  joiner.add(odometry(1.0, 1.0));
  joiner.add(scan(1.0, 1.0F));
  joiner.add(scan(1.0, 1.0F));
  joiner.add(odometry(1.0, 2.0));
  joiner.add(scan(1.0, 1.5F));
  joiner.flush();
  EXPECT_THAT(joined_x(&joiner), ElementsAre(1.0, 2.0));
  EXPECT_EQ(joiner.counters().duplicates, 1U);
  EXPECT_EQ(joiner.counters().repeated, 1U);
  EXPECT_EQ(joiner.counters().out_of_order, 0U);
}

TEST(ScanJoiner, CountsStampsThatRepeatApartFromThoseThatStepBack) {
  ScanJoiner joiner;
  joiner.add(scan(10.0, 1.0F));
  joiner.add(scan(10.0, 2.0F));
  joiner.add(scan(10.0, 3.0F));
  joiner.add(scan(9.0, 4.0F));
  joiner.add(scan(9.0, 5.0F));
  EXPECT_EQ(joiner.counters().repeated, 3U);
  EXPECT_EQ(joiner.counters().out_of_order, 1U);
}

TEST(ScanJoiner, KeepsScansWhoseStampsStepBack) {
  ScanJoiner joiner;
  joiner.add(odometry(9.2, 1.0));
  joiner.add(odometry(10.0, 2.0));
  joiner.add(scan(10.0));
  joiner.add(odometry(9.2, 3.0));
  joiner.add(scan(9.2));
  joiner.add(odometry(10.0, 4.0));
  joiner.add(scan(10.0, 7.0F));
  EXPECT_THAT(joined_x(&joiner), ElementsAre(2.0, 3.0, 4.0));
  EXPECT_EQ(joiner.counters().out_of_order, 2U);
  EXPECT_EQ(joiner.counters().clock_steps, 0U);
}

TEST(ScanJoiner, StartsAfreshOnANewClock) {
  for (const double new_clock_s : {-100.0, 10'000.0}) {
    SCOPED_TRACE(new_clock_s);
    ScanJoiner joiner;
    joiner.add(odometry(0.0, 1.0));
    joiner.add(scan(0.0));
    joiner.add(odometry(new_clock_s, 2.0));
    joiner.add(scan(new_clock_s));
    for (int i = 1; i <= 3; ++i) {
      joiner.add(odometry(new_clock_s + 0.1 * i, 2.0 + i));
      joiner.add(scan(new_clock_s + 0.1 * i));
    }
    // The first two of the new clock might be strays and are dropped; the third proves it.
    EXPECT_THAT(joined_x(&joiner), ElementsAre(1.0, 4.0, 5.0));
    EXPECT_EQ(joiner.counters().clock_steps, 1U);
    EXPECT_EQ(joiner.counters().strays, 4U);
  }
}

TEST(ScanJoiner, DropsAStrayStampAndNothingElseChanges) {
  for (const double stray_s : {-100.0, 10'000.0, 9e12}) {
    SCOPED_TRACE(stray_s);
    ScanJoiner joiner;
    for (int i = 0; i < 6; ++i) {
      if (i == 3) {
        joiner.add(odometry(stray_s, 99.0));
        joiner.add(scan(stray_s, 5.0F));
      }
      joiner.add(odometry(0.1 * i, i));
      joiner.add(scan(0.1 * i));
    }
    EXPECT_THAT(joined_x(&joiner), ElementsAre(0.0, 1.0, 2.0, 3.0, 4.0, 5.0));
    EXPECT_EQ(joiner.counters().strays, 2U);
    EXPECT_EQ(joiner.counters().clock_steps, 0U);
  }
}

TEST(ScanJoiner, CountsGapsInOdometry) {
  ScanJoiner joiner;
  joiner.add(odometry(1.0, 1.0));
  joiner.add(odometry(3.0, 3.0));
  joiner.add(scan(2.0));
  EXPECT_THAT(joined_x(&joiner), ElementsAre(2.0));
  EXPECT_EQ(joiner.counters().gaps, 1U);
}

/// Feeds two streams in an order drawn by a seed; `may_lead` tells whether the scan with the number
/// may come before the sample with the number.
template <typename MayLead>
std::vector<double> interleaved(const std::vector<OdometrySample>& samples,
                                const std::vector<LaserScan>& scans,
                                unsigned seed,
                                const MayLead& may_lead) {
  std::mt19937 random(seed);
  ScanJoiner joiner;
  std::size_t o = 0;
  for (std::size_t s = 0; s < scans.size() || o < samples.size();) {
    const bool may = s < scans.size() && (o == samples.size() || may_lead(s, o));
    if (o == samples.size() || (may && random() % 3 == 0)) {
      joiner.add(scans[s++]);
    } else {
      joiner.add(samples[o++]);
    }
  }
  joiner.flush();
  return joined_x(&joiner);
}

TEST(ScanJoiner, GivesTheSameHoweverLongScansLagWhereStampsStepBack) {
  for (unsigned seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    std::vector<OdometrySample> samples;
    std::vector<LaserScan> scans;
    std::vector<std::size_t> own;
    double clock_s = 100.0;
    for (std::size_t i = 0; i < 60; ++i) {
      clock_s += random() % 12 == 0 ? -0.42 : 0.05;
      samples.push_back(odometry(clock_s, static_cast<double>(i)));
      if (random() % 3 == 0) {
        scans.push_back(scan(clock_s, static_cast<float>(i + 1)));
        own.push_back(i);
      }
    }
    const auto after_its_sample = [&](std::size_t s, std::size_t o) { return own[s] < o; };
    const std::vector<double> reference = interleaved(samples, scans, 0, after_its_sample);
    EXPECT_THAT(reference, SizeIs(scans.size()));
    for (unsigned other = 1; other < 5; ++other) {
      EXPECT_EQ(interleaved(samples, scans, other, after_its_sample), reference);
    }
  }
}

TEST(ScanJoiner, GivesTheSameHoweverTheStreamsInterleaveWhileStampsGrow) {
  for (unsigned seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    std::vector<OdometrySample> samples;
    std::vector<LaserScan> scans;
    for (int i = 0; i < 60; ++i) {
      samples.push_back(odometry(100.0 + 0.05 * i, i));
      if (i > 0 && i < 59 && random() % 3 == 0) {
        const double off_s = 0.005 * static_cast<double>(random() % 10);
        scans.push_back(scan(100.0 + 0.05 * i + off_s, static_cast<float>(i + 1)));
      }
    }
    const auto within_patience = [&](std::size_t s, std::size_t o) {
      return seconds_between(samples[o].time, scans[s].time) < 0.4;
    };
    const std::vector<double> reference = interleaved(samples, scans, 0, within_patience);
    EXPECT_THAT(reference, SizeIs(scans.size()));
    EXPECT_THAT(reference, ::testing::Each(::testing::Ge(0.0)));
    for (unsigned other = 1; other < 5; ++other) {
      EXPECT_EQ(interleaved(samples, scans, other, within_patience), reference);
    }
  }
}

TEST(ScanJoiner, BoundsWhatItHoldsUnderAFloodOfOneStamp) {
  ScanJoiner joiner;
  for (int i = 0; i < 3'000; ++i) {
    joiner.add(scan(1.0, static_cast<float>(i + 1)));
  }
  EXPECT_THAT(joined_x(&joiner), SizeIs(2'000));
}

}  // namespace
}  // namespace cairn
