#include "storage/journal_codec.hpp"

#include <limits>
#include <random>

#include <gmock/gmock.h>

#include "support/experience.hpp"

namespace cairn {
namespace {

using Row = std::vector<std::uint8_t>;

PerceivedScan sample_scan() {
  PerceivedScan scan = test::scan_at(3, Pose2(1.0, 2.0, 0.5), Pose2(0.1, 0.0, 0.01));
  scan.between = {{time_of_utime(1'250'000), Pose2(0.05, 0.0, 0.0)},
                  {scan.fix.time, Pose2(0.1, 0.0, 0.01)}};
  return scan;
}

Visit sample_visit() {
  return {test::corner_at({3.0, 4.0}), 17};
}

TEST(JournalCodec, GivesBackTheScanItTook) {
  const PerceivedScan scan = sample_scan();
  const Result<PerceivedScan> read = scan_of_row(to_row(scan));
  ASSERT_TRUE(read.ok()) << read.error().message;
  EXPECT_EQ(read->scan->ranges_m, scan.scan->ranges_m);
  EXPECT_EQ(read->scan->bearings_rad, scan.scan->bearings_rad);
  EXPECT_EQ(read->fix.T_lpm_robot, scan.fix.T_lpm_robot);
  EXPECT_EQ(read->fix.covariance, scan.fix.covariance);
  EXPECT_EQ(read->between.size(), 2U);
  EXPECT_EQ(to_row(*read), to_row(scan));
}

TEST(JournalCodec, KeepsInfiniteAndInvalidReadings) {
  PerceivedScan scan = sample_scan();
  LaserScan changed = *scan.scan;
  changed.ranges_m[0] = std::numeric_limits<float>::infinity();
  changed.ranges_m[1] = std::numeric_limits<float>::quiet_NaN();
  scan.scan = std::make_shared<const LaserScan>(changed);
  const Result<PerceivedScan> read = scan_of_row(to_row(scan));
  ASSERT_TRUE(read.ok());
  EXPECT_TRUE(std::isinf(read->scan->ranges_m[0]));
  EXPECT_TRUE(std::isnan(read->scan->ranges_m[1]));
}

TEST(JournalCodec, KeepsUnevenBearings) {
  PerceivedScan scan = sample_scan();
  LaserScan changed = *scan.scan;
  changed.bearings_rad[5] += 0.01F;
  scan.scan = std::make_shared<const LaserScan>(changed);
  EXPECT_EQ(scan_of_row(to_row(scan))->scan->bearings_rad, changed.bearings_rad);
}

TEST(JournalCodec, GivesBackTheVisitItTook) {
  const Visit visit = sample_visit();
  const Result<Visit> read = visit_of_row(to_row(visit));
  ASSERT_TRUE(read.ok()) << read.error().message;
  EXPECT_EQ(read->anchor_scan, 17U);
  EXPECT_EQ(read->perceived.neighbourhood.star, visit.perceived.neighbourhood.star);
  EXPECT_EQ(read->perceived.neighbourhood.others, visit.perceived.neighbourhood.others);
  ASSERT_EQ(read->perceived.neighbourhood.unsure.size(), 1U);
  EXPECT_EQ(read->perceived.neighbourhood.unsure[0].log_odds, -1.5);
  EXPECT_EQ(read->perceived.neighbourhood.unsure[0].gateway.width_m, 2.0);
  EXPECT_EQ(read->perceived.neighbourhood.fragments, visit.perceived.neighbourhood.fragments);
  EXPECT_EQ(read->perceived.lpm.cells(), visit.perceived.lpm.cells());
  EXPECT_EQ(to_row(*read), to_row(visit));
}

TEST(JournalCodec, RefusesAVisitThatNamesAMissingGateway) {
  Visit visit = sample_visit();
  visit.perceived.departure_gateway = 2;
  EXPECT_FALSE(visit_of_row(to_row(visit)).ok());
}

TEST(JournalCodec, RefusesAScanForAVisit) {
  EXPECT_EQ(visit_of_row(to_row(sample_scan())).error().code, ErrorCode::kMalformed);
}

TEST(JournalCodec, SurvivesAnyDamage) {
  const Row rows[] = {to_row(sample_scan()), to_row(sample_visit())};
  std::mt19937 random(7);
  for (int i = 0; i < 20'000; ++i) {
    Row row = rows[i % 2];
    const std::size_t at = random() % row.size();
    if (i % 5 == 0) {
      row.resize(at);
    } else {
      row[at] = static_cast<std::uint8_t>(random());
    }
    // Refused or read: never a crash, and what is read can be written.
    if (const Result<PerceivedScan> scan = scan_of_row(row)) {
      EXPECT_FALSE(to_row(*scan).empty());
    }
    if (const Result<Visit> visit = visit_of_row(row)) {
      EXPECT_FALSE(to_row(*visit).empty());
    }
  }
}

}  // namespace
}  // namespace cairn
