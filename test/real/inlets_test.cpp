#include "transport/inlets.hpp"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/recorded_data.hpp"
#include "wire/log_reader.hpp"

namespace cairn {
namespace {

/// Replays a recorded log through the inlets. @return messages they did not accept
std::int64_t refusals_in(const std::string& file, const InletOptions& options, int* num_scans) {
  const auto count = [num_scans](const LaserScan&) { ++*num_scans; };
  Inlets inlets(options, {count, [](const OdometrySample&) {}, [](const SonarRing&) {}});
  wire::Expected<wire::LogReader> log = wire::LogReader::open(test::recorded_data(file).string());
  EXPECT_TRUE(log.ok()) << log.error();
  std::int64_t refusals = 0;
  while (const std::optional<wire::LogMessage> message = log->next()) {
    const auto outcome =
        inlets.dispatch(message->channel, message->bytes.data(), message->bytes.size());
    refusals +=
        outcome == Inlets::Outcome::kAccepted || outcome == Inlets::Outcome::kNotOurs ? 0 : 1;
  }
  for (const std::string& remark : inlets.take_remarks()) {
    ADD_FAILURE() << file << ": " << remark;
  }
  return refusals;
}

TEST(RecordedInputs, EveryRecordedScanAndOdometryIsAccepted) {
  InletOptions options;
  options.lasers.emplace_back().channel = "RPLIDAR_LASER";
  for (const char* const file :
       {"carmen/intel/intel.clf", "carmen/fr079/fr079.clf", "carmen/aces/aces.clf",
        "carmen/csail/csail.clf", "carmen/seattle/seattle.clf", "laser/cmu_wean/robotdata1.clf",
        "laser/cmu_wean/robotdata5.clf", "laser/duke_loop5/loop5.clf", "laser/mines/exp1.clf",
        "lcm/mbot_convex.log", "lcm/mbot_drive_square_truth.log"}) {
    SCOPED_TRACE(file);
    CAIRN_NEED_DATA(file);
    int num_scans = 0;
    EXPECT_EQ(refusals_in(file, options, &num_scans), 0);
    EXPECT_GT(num_scans, 100);
  }
}

}  // namespace
}  // namespace cairn
