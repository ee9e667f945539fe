#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "geometry/angle.hpp"
#include "support/message_samples.hpp"
#include "transport/inlets.hpp"
#include "wire/signatures.hpp"

namespace cairn {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;
using Outcome = Inlets::Outcome;

class InletsTest : public ::testing::Test {
 protected:
  template <class Message>
  Outcome dispatch(const std::string& channel,
                   const Message& message,
                   std::optional<TimePoint> now = std::nullopt) {
    const wire::Bytes bytes = wire::encode(message);
    return inlets_.dispatch(channel, bytes.data(), bytes.size(), now);
  }
  const ChannelCounters& counters(const std::string& channel) {
    return inlets_.counters().find(channel)->second;
  }

  std::vector<LaserScan> scans_;
  std::vector<OdometrySample> odometry_;
  std::vector<SonarRing> rings_;
  Inlets inlets_{InletOptions{},
                 {[this](LaserScan scan) { scans_.push_back(std::move(scan)); },
                  [this](OdometrySample sample) { odometry_.push_back(sample); },
                  [this](SonarRing ring) { rings_.push_back(std::move(ring)); }}};
};

TEST_F(InletsTest, MessagesGoWhereTheirChannelBelongs) {
  EXPECT_EQ(dispatch("LASER", test::sample<cairn_lcm::laser_scan_t>()), Outcome::kAccepted);
  EXPECT_EQ(dispatch("LIDAR", test::sample<mbot_lcm_msgs::lidar_t>()), Outcome::kAccepted);
  cairn_lcm::odometry_t odometry{};
  odometry.utime = 1;
  EXPECT_EQ(dispatch("ODOMETRY", odometry), Outcome::kAccepted);
  EXPECT_EQ(dispatch("SONAR", test::sample<cairn_lcm::sonar_ring_t>()), Outcome::kAccepted);
  EXPECT_THAT(scans_, SizeIs(2));
  EXPECT_THAT(odometry_, SizeIs(1));
  EXPECT_THAT(rings_, SizeIs(1));
  EXPECT_EQ(counters("LASER").accepted, 1);
  EXPECT_THAT(inlets_.take_remarks(), IsEmpty());
}

TEST_F(InletsTest, OtherChannelsAreNotOurs) {
  EXPECT_EQ(dispatch("CAMERA", test::sample<cairn_lcm::laser_scan_t>()), Outcome::kNotOurs);
  EXPECT_THAT(scans_, IsEmpty());
}

TEST_F(InletsTest, BadMessagesAreCountedByWhatIsWrong) {
  const wire::Bytes garbage = {0xDE, 0xAD, 0xBE, 0xEF};
  EXPECT_EQ(inlets_.dispatch("LASER", garbage.data(), garbage.size()), Outcome::kMalformed);
  auto scan = test::sample<cairn_lcm::laser_scan_t>();
  scan.utime = -1;
  EXPECT_EQ(dispatch("LASER", scan), Outcome::kRefused);
  EXPECT_EQ(dispatch("LASER", test::sample<cairn_lcm::pose_t>()), Outcome::kUnknownType);
  EXPECT_EQ(counters("LASER").malformed, 1);
  EXPECT_EQ(counters("LASER").refused, 1);
  EXPECT_EQ(counters("LASER").unknown_type, 1);
  EXPECT_EQ(counters("LASER").accepted, 0);
  EXPECT_THAT(counters("LASER").last_refusal, HasSubstr("unknown type"));
}

TEST_F(InletsTest, AnUnknownTypeIsNamedOnce) {
  for (int i = 0; i < 5; ++i) {
    dispatch("LASER", test::sample<cairn_lcm::pose_t>());
  }
  EXPECT_THAT(inlets_.take_remarks(), ElementsAre(HasSubstr("LASER: message of unknown type 0x")));
  dispatch("LASER", test::sample<cairn_lcm::pose_t>());
  EXPECT_THAT(inlets_.take_remarks(), IsEmpty());
}

TEST_F(InletsTest, ASenderThatMakesUpTypesDoesNotFillTheMemory) {
  for (std::uint32_t i = 0; i < 10'000; ++i) {
    wire::Bytes bytes(16, 0xAB);
    for (std::size_t k = 0; k < 4; ++k) {
      bytes[k] = static_cast<std::uint8_t>(i >> (8 * k));
    }
    inlets_.dispatch("LASER", bytes.data(), bytes.size());
  }
  EXPECT_LE(inlets_.take_remarks().size(), 100U);
  EXPECT_EQ(counters("LASER").unknown_type, 10'000);
}

TEST_F(InletsTest, StampsAheadOfTheClockAreRefusedOnlyWhenThereIsAClock) {
  auto scan = test::sample<cairn_lcm::laser_scan_t>();
  scan.utime = 10'000'000;
  EXPECT_EQ(dispatch("LASER", scan, time_of_utime(8'999'999)), Outcome::kRefused);
  EXPECT_EQ(counters("LASER").in_future, 1);
  EXPECT_EQ(dispatch("LASER", scan, time_of_utime(9'000'000)), Outcome::kAccepted);
  EXPECT_EQ(dispatch("LASER", scan), Outcome::kAccepted);
}

/// A scan of so many beams over so many degrees.
cairn_lcm::laser_scan_t scan_of_shape(int beams, double degrees) {
  auto scan = test::sample<cairn_lcm::laser_scan_t>();
  scan.num_ranges = beams;
  scan.ranges_m.assign(static_cast<std::size_t>(beams), 2.0F);
  const double view_rad = degrees * kPi / 180.0;
  scan.first_bearing_rad = -view_rad / 2.0;
  scan.bearing_step_rad = view_rad / (beams - 1);
  return scan;
}

TEST_F(InletsTest, ALaserWhoseBeamsChangeInTheMidstOfWorkIsToldOfOnce) {
  for (int i = 0; i < 50; ++i) {
    dispatch("LASER", scan_of_shape(181, 180.0));
  }
  EXPECT_THAT(inlets_.take_remarks(), IsEmpty());
  for (int i = 0; i < 50; ++i) {
    EXPECT_EQ(dispatch("LASER", scan_of_shape(541, 270.0)), Outcome::kAccepted);
  }
  EXPECT_THAT(inlets_.take_remarks(),
              ElementsAre(HasSubstr("LASER: the laser now gives 541 beams over 270 degrees, it "
                                    "gave 181 beams over 180 degrees")));
  EXPECT_EQ(counters("LASER").laser_changes, 1);
}

TEST_F(InletsTest, ALaserThatHasGoneBlindOnOneSideIsToldOf) {
  cairn_lcm::laser_scan_t scan = scan_of_shape(181, 180.0);
  for (int i = 0; i < 20; ++i) {
    dispatch("LASER", scan);
  }
  std::fill(scan.ranges_m.begin(), scan.ranges_m.begin() + 90,
            std::numeric_limits<float>::quiet_NaN());
  for (int i = 0; i < 20; ++i) {
    dispatch("LASER", scan);
  }
  EXPECT_THAT(inlets_.take_remarks(), ElementsAre(HasSubstr("181 beams over 90 degrees")));
}

TEST_F(InletsTest, ALaserWithACoverOnOneHalfIsToldOf) {
  cairn_lcm::laser_scan_t scan = scan_of_shape(181, 180.0);
  for (int i = 0; i < 20; ++i) {
    dispatch("LASER", scan);
  }
  std::fill(scan.ranges_m.begin() + 91, scan.ranges_m.end(), 0.12F);
  for (int i = 0; i < 20; ++i) {
    dispatch("LASER", scan);
  }
  EXPECT_THAT(inlets_.take_remarks(), ElementsAre(HasSubstr("see what covers it")));
}

TEST_F(InletsTest, OneAbsurdReadingIsNoReturnAndTheScanStays) {
  auto scan = scan_of_shape(181, 180.0);
  scan.max_range_m = 0.0;
  scan.ranges_m[7] = 1e30F;
  EXPECT_EQ(dispatch("LASER", scan), Outcome::kAccepted);
  ASSERT_THAT(scans_, SizeIs(1));
  EXPECT_TRUE(std::isinf(scans_.front().ranges_m[7]));
  EXPECT_NEAR(scans_.front().max_range_m, 2.0, 0.1);
}

TEST_F(InletsTest, AScanWithoutAnyReadingSaysSo) {
  auto scan = scan_of_shape(181, 180.0);
  scan.max_range_m = 0.0;
  std::fill(scan.ranges_m.begin(), scan.ranges_m.end(), 0.0F);
  EXPECT_EQ(dispatch("LASER", scan), Outcome::kRefused);
  EXPECT_THAT(inlets_.take_remarks(), ElementsAre(HasSubstr("no range says anything")));
}

TEST_F(InletsTest, ASpinningLaserWhoseScansAreNeverAlikeIsNoNews) {
  for (int i = 0; i < 200; ++i) {
    dispatch("LASER", scan_of_shape(i % 3 == 0 ? 250 : 330 + i % 40, 352.0 + i % 7));
  }
  EXPECT_THAT(inlets_.take_remarks(), IsEmpty());
  EXPECT_EQ(counters("LASER").laser_changes, 0);
}

TEST_F(InletsTest, ALaserThatChangesForeverDoesNotFillTheLog) {
  for (int i = 0; i < 2'000; ++i) {
    dispatch("LASER", scan_of_shape((i / 20) % 2 == 0 ? 181 : 361, 180.0));
  }
  EXPECT_LE(inlets_.take_remarks().size(), 20U);
  EXPECT_EQ(counters("LASER").laser_changes, 99);
}

TEST_F(InletsTest, TheLiveBusTakesTheSameWay) {
  wire::Expected<std::unique_ptr<wire::Bus>> bus = wire::Bus::open("memq://");
  ASSERT_TRUE(bus.ok());
  ASSERT_TRUE(inlets_.subscribe(**bus, [] { return time_of_utime(2'000'000); }).ok());
  (*bus)->publish("LASER", test::sample<cairn_lcm::laser_scan_t>());
  (*bus)->publish("CAMERA", test::sample<cairn_lcm::laser_scan_t>());
  (*bus)->publish("LASER", wire::Bytes{1, 2, 3});
  while ((*bus)->handle(0) > 0) {
  }
  EXPECT_THAT(scans_, SizeIs(1));
  EXPECT_EQ(counters("LASER").malformed, 1);
  EXPECT_EQ((*bus)->failed_handlers(), 0U);
}

TEST(InletOptions, ChannelsAreNamedOnceOnly) {
  InletOptions options;
  EXPECT_TRUE(validate(options).ok());
  options.odometry_channels.emplace_back("LASER");
  EXPECT_THAT(validate(options).error().message, HasSubstr("once only"));
  options = {};
  options.lasers.clear();
  EXPECT_THAT(validate(options).error().message, HasSubstr("at least one"));
}

}  // namespace
}  // namespace cairn
