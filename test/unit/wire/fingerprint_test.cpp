#include <cstdint>

#include <gtest/gtest.h>

#include "support/message_samples.hpp"

namespace cairn {
namespace {

struct Golden {
  const char* name;
  std::int64_t (*fingerprint)();
  std::uint64_t expected;
};

#define CAIRN_GOLDEN(type, expected) \
  Golden {                           \
#type, &type::getHash, expected  \
  }

// A change here is a change of the wire: old clients and old logs will not be understood.
TEST(Fingerprints, AreWhatTheyWere) {
  const Golden all[] = {
      CAIRN_GOLDEN(cairn_lcm::assert_request_t, 0xbd7e94219113e8ed),
      CAIRN_GOLDEN(cairn_lcm::assertion_report_t, 0xea29d587a4a88e9a),
      CAIRN_GOLDEN(cairn_lcm::assertion_t, 0xee184910c286016e),
      CAIRN_GOLDEN(cairn_lcm::assertions_t, 0xccddc48880e15098),
      CAIRN_GOLDEN(cairn_lcm::delta_request_t, 0x93a64af66f90dd59),
      CAIRN_GOLDEN(cairn_lcm::event_request_t, 0x8fe3e2df393e1cd8),
      CAIRN_GOLDEN(cairn_lcm::explain_request_t, 0xa07cf0bbe7cf5d26),
      CAIRN_GOLDEN(cairn_lcm::explained_step_t, 0x19723ba63c8fa6ff),
      CAIRN_GOLDEN(cairn_lcm::explanation_t, 0x9ac6b07bcf47fbe9),
      CAIRN_GOLDEN(cairn_lcm::frame_change_t, 0x3d1101dbc2588bbe),
      CAIRN_GOLDEN(cairn_lcm::gateway_t, 0x20f62b28d3e48028),
      CAIRN_GOLDEN(cairn_lcm::grid_map_t, 0x3a6cf0c65d54c034),
      CAIRN_GOLDEN(cairn_lcm::hypotheses_t, 0x7b54f4611fdcfcb5),
      CAIRN_GOLDEN(cairn_lcm::hypothesis_map_t, 0xbfd46283c70936ce),
      CAIRN_GOLDEN(cairn_lcm::laser_scan_t, 0x22067aeecbe2b983),
      CAIRN_GOLDEN(cairn_lcm::map_delta_t, 0x9439777c492dff7f),
      CAIRN_GOLDEN(cairn_lcm::name_request_t, 0xcf95b9ea3e2c9f7a),
      CAIRN_GOLDEN(cairn_lcm::odometry_t, 0x1ab2679132ee7bc1),
      CAIRN_GOLDEN(cairn_lcm::opening_t, 0xb9f3f3229f2501bb),
      CAIRN_GOLDEN(cairn_lcm::perceived_place_t, 0x063059a640b946c9),
      CAIRN_GOLDEN(cairn_lcm::perception_request_t, 0x982b121f3517bc45),
      CAIRN_GOLDEN(cairn_lcm::perception_t, 0xca297bc8e5e3a9ff),
      CAIRN_GOLDEN(cairn_lcm::place_event_t, 0x2fa5e4157d00aca3),
      CAIRN_GOLDEN(cairn_lcm::place_ref_t, 0xb66ad4c6ca7d18bb),
      CAIRN_GOLDEN(cairn_lcm::place_t, 0xce4b584ff1e653cb),
      CAIRN_GOLDEN(cairn_lcm::plan_request_t, 0x923d4c5eb485232e),
      CAIRN_GOLDEN(cairn_lcm::plan_t, 0x0b59d9787fd38089),
      CAIRN_GOLDEN(cairn_lcm::pose_t, 0x99a81d002d846c9b),
      CAIRN_GOLDEN(cairn_lcm::result_t, 0x859f913621bdc739),
      CAIRN_GOLDEN(cairn_lcm::rpc_header_t, 0x835f8bae3c230091),
      CAIRN_GOLDEN(cairn_lcm::segment_t, 0x99d64436130b5d8a),
      CAIRN_GOLDEN(cairn_lcm::snapshot_chunk_t, 0xcd10c34fbddc8dc6),
      CAIRN_GOLDEN(cairn_lcm::snapshot_request_t, 0x259f38a386c07927),
      CAIRN_GOLDEN(cairn_lcm::sonar_ring_t, 0x2e090798c624ed21),
      CAIRN_GOLDEN(cairn_lcm::status_t, 0x78a9e401a68b407e),
      CAIRN_GOLDEN(cairn_lcm::tile_t, 0xb87e5a344b6a8dfb),
      CAIRN_GOLDEN(cairn_lcm::topology_t, 0x5b420a8eee10c6d1),
      CAIRN_GOLDEN(cairn_lcm::trajectory_t, 0xa38319762c318f14),
      CAIRN_GOLDEN(cairn_lcm::visit_places_t, 0x83f45af9cc639abc),
  };
  for (const Golden& type : all) {
    EXPECT_EQ(static_cast<std::uint64_t>(type.fingerprint()), type.expected) << type.name;
  }
}

// The values other projects' programs send.
TEST(Fingerprints, ForeignTypesAreThoseOfTheirOwners) {
  const Golden all[] = {
      CAIRN_GOLDEN(bot_core::planar_lidar_t, 0xe3d17423180b5e8d),
      CAIRN_GOLDEN(bot_core::pose_t, 0x2e16efb052b0105e),
      CAIRN_GOLDEN(mbot_lcm_msgs::lidar_t, 0x89dc5b879a5056cf),
      CAIRN_GOLDEN(mbot_lcm_msgs::pose2D_t, 0x1f317af1246276ac),
      CAIRN_GOLDEN(vulcan_lcm::laser_t, 0x4efe2c87327fbc24),
      CAIRN_GOLDEN(vulcan_lcm::laser_3dof_t, 0x034dfce3a3433d1a),
      CAIRN_GOLDEN(vulcan_lcm::odometry_t, 0x0c094f6ff71567ed),
  };
  for (const Golden& type : all) {
    EXPECT_EQ(static_cast<std::uint64_t>(type.fingerprint()), type.expected) << type.name;
  }
}

#undef CAIRN_GOLDEN

}  // namespace
}  // namespace cairn
