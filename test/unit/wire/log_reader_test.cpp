#include "wire/log_reader.hpp"

#include <fstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/files.hpp"
#include "support/message_samples.hpp"
#include "wire/log_writer.hpp"
#include "wire/signatures.hpp"

namespace cairn::wire {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Pair;
using ::testing::StartsWith;

class RecordedLog : public ::testing::Test {
 protected:
  void write(const std::string& content) { std::ofstream(file_, std::ios::binary) << content; }
  [[nodiscard]] std::string content() const { return test::content_of(file_); }
  std::vector<LogMessage> read_all() {
    std::vector<LogMessage> messages;
    Expected<LogReader> log = LogReader::open(file_);
    EXPECT_TRUE(log.ok()) << log.error();
    while (std::optional<LogMessage> message = log->next()) {
      messages.push_back(*std::move(message));
    }
    damage_ = log->damage().value_or("");
    skipped_ = log->skipped_lines();
    bytes_read_ = log->bytes_read();
    return messages;
  }
  void write_three_events() {
    Expected<LogWriter> log = LogWriter::open(file_);
    ASSERT_TRUE(log.ok()) << log.error();
    for (std::int64_t i = 1; i <= 3; ++i) {
      ASSERT_TRUE(log->write(i, "LASER", test::sample<cairn_lcm::laser_scan_t>()));
    }
    ASSERT_TRUE(log->close());
  }

  test::TemporaryFolder folder_;
  const std::string file_ = (folder_ / "a.log").string();
  std::string damage_;
  std::map<std::string, std::int64_t> skipped_;
  std::int64_t bytes_read_ = 0;
};

TEST_F(RecordedLog, EventsComeBackAsTheyWereWritten) {
  write_three_events();
  const std::vector<LogMessage> messages = read_all();
  ASSERT_EQ(messages.size(), 3U);
  EXPECT_EQ(messages[1].utime, 2);
  EXPECT_EQ(messages[1].channel, "LASER");
  EXPECT_EQ(messages[1].bytes, encode(test::sample<cairn_lcm::laser_scan_t>()));
  EXPECT_EQ(damage_, "");
  EXPECT_EQ(bytes_read_, static_cast<std::int64_t>(std::filesystem::file_size(file_)));
}

TEST_F(RecordedLog, AnEventLogCutShortGivesItsWholeEventsAndTheByte) {
  write_three_events();
  const std::string whole = content();
  const std::size_t event = whole.size() / 3;
  for (const std::size_t size : {whole.size() - 1, 2 * event + 1, 2 * event + 28}) {
    write(whole.substr(0, size));
    EXPECT_EQ(read_all().size(), 2U);
    EXPECT_THAT(damage_, StartsWith("byte " + std::to_string(2 * event)));
  }
}

TEST_F(RecordedLog, ADamagedEventLogIsNoFinishedOne) {
  write_three_events();
  const std::string whole = content();
  std::string damaged = whole;
  damaged.replace(whole.size() / 3, 50, std::string(50, '\0'));
  write(damaged);
  EXPECT_EQ(read_all().size(), 1U);
  EXPECT_THAT(damage_, HasSubstr("no event begins here"));
}

TEST_F(RecordedLog, AnEmptyOrForeignFileIsRefused) {
  write("");
  EXPECT_THAT(LogReader::open(file_).error(), HasSubstr("is empty"));
  write(std::string("\x89PNG\r\n", 6));
  EXPECT_THAT(LogReader::open(file_).error(), HasSubstr("neither"));
  EXPECT_THAT(LogReader::open("/nowhere/at.log").error(), HasSubstr("no such file"));
  EXPECT_THAT(LogReader::open("/").error(), HasSubstr("expected a file, got a folder"));
}

TEST_F(RecordedLog, ACarmenScanComesAfterItsOdometry) {
  write(
      "# comment\n"
      "PARAM robot 1\n"
      "ODOM 1 2 0.5 0 0 0 10.000001 host 0.1\n"
      "FLASER 2 3 4 9 9 9 5 6 0.25 10.5 host 0.2\n"
      "PARAM robot 2\n");
  const std::vector<LogMessage> messages = read_all();
  ASSERT_EQ(messages.size(), 3U);
  EXPECT_EQ(messages[0].utime, 10'000'001);
  const auto odometry = decode<cairn_lcm::odometry_t>(messages[1].bytes, 1000);
  ASSERT_TRUE(odometry.ok());
  EXPECT_EQ(odometry->utime, 10'500'000);
  EXPECT_EQ(odometry->x_m, 5.0);
  EXPECT_EQ(messages[2].channel, "LASER");
  const auto scan = decode<cairn_lcm::laser_scan_t>(messages[2].bytes, 1000);
  ASSERT_TRUE(scan.ok());
  EXPECT_EQ(scan->utime, 10'500'000);
  EXPECT_THAT(scan->ranges_m, ElementsAre(3.0F, 4.0F));
  EXPECT_THAT(skipped_, ElementsAre(Pair("PARAM", 2)));
  EXPECT_EQ(damage_, "");
}

TEST_F(RecordedLog, ALineThatIsCutIsNamedAndTheRestIsRead) {
  write(
      "ODOM 1 2 0.5 0 0 0 10 host 0.1\n"
      "ODOM 1 2 0.5 0 0\n"
      "ODOM 1 2 0.5 0 0 0 11 host 0.1\n"
      "ODOM 1 2 0.5 0 ");
  EXPECT_EQ(read_all().size(), 2U);
  EXPECT_THAT(damage_, StartsWith("line 2:"));
}

TEST_F(RecordedLog, ACarmenLogThatEndsWithinALineSaysSo) {
  write("ODOM 1 2 0.5 0 0 0 10 host 0.1\r\nODOM 1 2 0.5 0 ");
  EXPECT_EQ(read_all().size(), 1U);
  EXPECT_EQ(damage_, "line 2: the file ends within the line");
}

TEST_F(RecordedLog, ALineWithoutEndIsNotReadForEver) {
  write("ODOM " + std::string(3'000'000, '1'));
  EXPECT_EQ(read_all().size(), 0U);
  EXPECT_THAT(damage_, HasSubstr("longer than any line"));
}

}  // namespace
}  // namespace cairn::wire
