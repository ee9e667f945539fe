#include "wire/wire_check.hpp"

#include <limits>
#include <random>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/message_samples.hpp"
#include "wire/signatures.hpp"

namespace cairn::wire {
namespace {

constexpr std::size_t kMaxBytes = 1 << 20;

#if defined(__SANITIZE_ADDRESS__)
constexpr int kMutations = 200'000;
#else
constexpr int kMutations = 20'000;
#endif

using Types = ::testing::Types<cairn_lcm::assert_request_t,
                               cairn_lcm::assertion_report_t,
                               cairn_lcm::assertion_t,
                               cairn_lcm::assertions_t,
                               cairn_lcm::delta_request_t,
                               cairn_lcm::event_request_t,
                               cairn_lcm::explain_request_t,
                               cairn_lcm::explained_step_t,
                               cairn_lcm::explanation_t,
                               cairn_lcm::frame_change_t,
                               cairn_lcm::gateway_t,
                               cairn_lcm::grid_map_t,
                               cairn_lcm::hypotheses_t,
                               cairn_lcm::hypothesis_map_t,
                               cairn_lcm::laser_scan_t,
                               cairn_lcm::map_delta_t,
                               cairn_lcm::name_request_t,
                               cairn_lcm::odometry_t,
                               cairn_lcm::opening_t,
                               cairn_lcm::perceived_place_t,
                               cairn_lcm::perception_request_t,
                               cairn_lcm::perception_t,
                               cairn_lcm::place_event_t,
                               cairn_lcm::place_ref_t,
                               cairn_lcm::place_t,
                               cairn_lcm::plan_request_t,
                               cairn_lcm::plan_t,
                               cairn_lcm::pose_t,
                               cairn_lcm::result_t,
                               cairn_lcm::rpc_header_t,
                               cairn_lcm::segment_t,
                               cairn_lcm::snapshot_chunk_t,
                               cairn_lcm::snapshot_request_t,
                               cairn_lcm::sonar_ring_t,
                               cairn_lcm::status_t,
                               cairn_lcm::tile_t,
                               cairn_lcm::topology_t,
                               cairn_lcm::trajectory_t,
                               cairn_lcm::visit_places_t,
                               bot_core::planar_lidar_t,
                               bot_core::pose_t,
                               mbot_lcm_msgs::lidar_t,
                               mbot_lcm_msgs::pose2D_t,
                               vulcan_lcm::laser_t,
                               vulcan_lcm::laser_3dof_t,
                               vulcan_lcm::odometry_t>;

template <class T>
class EveryMessage : public ::testing::Test {};
TYPED_TEST_SUITE(EveryMessage, Types);

TYPED_TEST(EveryMessage, PassesTheSignatureOfItsType) {
  const TypeParam message = test::sample<TypeParam>();
  const Bytes bytes = encode(message);
  const auto decoded = decode<TypeParam>(bytes, kMaxBytes);
  ASSERT_TRUE(decoded.ok()) << to_string(decoded.error());
  EXPECT_EQ(encode(*decoded), bytes);
}

TYPED_TEST(EveryMessage, IsRefusedWhereverItIsCut) {
  const Bytes bytes = encode(test::sample<TypeParam>());
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    EXPECT_FALSE(decode<TypeParam>(bytes.data(), size, kMaxBytes).ok()) << size;
  }
}

TYPED_TEST(EveryMessage, IsRefusedWithStrayBytesBehindIt) {
  Bytes bytes = encode(test::sample<TypeParam>());
  bytes.push_back(0);
  const auto decoded = decode<TypeParam>(bytes, kMaxBytes);
  ASSERT_FALSE(decoded.ok());
  EXPECT_EQ(decoded.error(), DecodeError::kTrailingBytes);
}

/// Counts and lengths that break a decoder that trusts them.
constexpr std::uint32_t kHostile[] = {0xFFFFFFFF, 0x80000000,  0x7FFFFFFF, 0x40000001, 0x40000000,
                                      0x20000000, 100'000'000, 65'536,     3,          0};

void put(std::uint32_t value, std::size_t at, Bytes* bytes) {
  for (std::size_t i = 0; i < 4 && at + i < bytes->size(); ++i) {
    (*bytes)[at + i] = static_cast<std::uint8_t>(value >> (8 * (3 - i)));
  }
}

void mutate(std::mt19937& random, Bytes* bytes) {
  const auto below = [&random](std::size_t bound) { return random() % bound; };
  for (std::size_t changes = 1 + below(3); changes > 0 && !bytes->empty(); --changes) {
    // The fingerprint stays, or nothing behind it would be looked at.
    const std::size_t at = bytes->size() > 8 ? 8 + below(bytes->size() - 8) : 0;
    switch (below(5)) {
      case 0:
      case 1:
        put(kHostile[below(std::size(kHostile))], at, bytes);
        break;
      case 2:
        (*bytes)[at] = static_cast<std::uint8_t>(random());
        break;
      case 3:
        bytes->resize(at);
        break;
      default:
        bytes->insert(bytes->begin() + static_cast<std::ptrdiff_t>(at), below(40), 0);
    }
  }
}

TYPED_TEST(EveryMessage, SurvivesAnyMutation) {
  const Bytes sound = encode(test::sample<TypeParam>());
  std::mt19937 random(1);
  int accepted = 0;
  for (int i = 0; i < kMutations; ++i) {
    Bytes bytes = sound;
    mutate(random, &bytes);
    const auto decoded = decode<TypeParam>(bytes, kMaxBytes);
    if (decoded) {
      ++accepted;
      ASSERT_EQ(static_cast<std::size_t>(decoded->getEncodedSize()), bytes.size());
    }
  }
  EXPECT_GT(accepted, 0) << "mutations must reach the decoder";
}

Bytes body(const std::vector<std::uint32_t>& words) {
  Bytes bytes(4 * words.size());
  for (std::size_t i = 0; i < words.size(); ++i) {
    put(words[i], 4 * i, &bytes);
  }
  return bytes;
}

bool passes(const char* signature, const Bytes& bytes) {
  return !Signature(signature).check(bytes.data(), bytes.size()).has_value();
}

TEST(Signature, CountsMustBePaidFor) {
  EXPECT_TRUE(passes("i f[0]", body({2, 0, 0})));
  EXPECT_FALSE(passes("i f[0]", body({3, 0, 0})));
  EXPECT_FALSE(passes("i f[0]", body({0xFFFFFFFF, 0, 0})));
  EXPECT_FALSE(passes("i f[0]", body({0x40000002, 0, 0})));
}

TEST(Signature, RowsOfAnEmptyMatrixMustBePaidFor) {
  EXPECT_FALSE(passes("i i d[0][1]", body({100'000'000, 0})));
  EXPECT_TRUE(passes("i i d[0][1]", body({0, 100})));
}

TEST(Signature, StringsEndInNul) {
  EXPECT_TRUE(passes("s", {0, 0, 0, 2, 'a', 0}));
  EXPECT_FALSE(passes("s", {0, 0, 0, 2, 'a', 'b'}));
  EXPECT_FALSE(passes("s", {0, 0, 0, 0}));
  EXPECT_FALSE(passes("s", {0xFF, 0xFF, 0xFF, 0xFB, 'a', 0}));
}

TEST(Signature, NestedMessagesAreCountedBeforeTheyAreWalked) {
  EXPECT_TRUE(passes("i {i i}[0]", body({1, 7, 8})));
  EXPECT_FALSE(passes("i {i i}[0]", body({100'000'000, 7, 8})));
}

TEST(SignatureDeathTest, ATextThatIsNoSignatureIsABug) {
  EXPECT_DEATH(Signature("q x"), "bad message signature");
  EXPECT_DEATH(Signature("q f[1]"), "bad message signature");
  EXPECT_DEATH(Signature("f f[0]"), "bad message signature");
}

TEST(Decode, RefusesWhatTheChannelDoesNotAllow) {
  const Bytes bytes = encode(test::sample<cairn_lcm::laser_scan_t>());
  const auto decoded = decode<cairn_lcm::laser_scan_t>(bytes, bytes.size() - 1);
  ASSERT_FALSE(decoded.ok());
  EXPECT_EQ(decoded.error(), DecodeError::kTooBig);
}

TEST(Decode, RefusesAnotherType) {
  const Bytes bytes = encode(test::sample<cairn_lcm::laser_scan_t>());
  const auto decoded = decode<cairn_lcm::odometry_t>(bytes, kMaxBytes);
  ASSERT_FALSE(decoded.ok());
  EXPECT_EQ(decoded.error(), DecodeError::kWrongType);
}

}  // namespace
}  // namespace cairn::wire
