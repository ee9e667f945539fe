#pragma once
// The signatures of all message types: our own and the foreign ones we accept. A test encodes a
// sample of each type, so that a signature that does not fit its .lcm file is noticed.

#include <string_view>

#include "wire/wire_check.hpp"

// Declared, not included: a file that decodes one type does not pay for all of them.
namespace cairn_lcm {
class assert_request_t;
class assertion_report_t;
class assertion_t;
class assertions_t;
class delta_request_t;
class event_request_t;
class explain_request_t;
class explained_step_t;
class explanation_t;
class frame_change_t;
class gateway_t;
class grid_map_t;
class hypotheses_t;
class hypothesis_map_t;
class laser_scan_t;
class map_delta_t;
class name_request_t;
class odometry_t;
class opening_t;
class perceived_place_t;
class perception_request_t;
class perception_t;
class place_event_t;
class place_ref_t;
class place_t;
class plan_request_t;
class plan_t;
class pose_t;
class result_t;
class rpc_header_t;
class segment_t;
class snapshot_chunk_t;
class snapshot_request_t;
class sonar_ring_t;
class status_t;
class tile_t;
class topology_t;
class trajectory_t;
class visit_places_t;
}  // namespace cairn_lcm
namespace bot_core {
class planar_lidar_t;
class pose_t;
}  // namespace bot_core
namespace mbot_lcm_msgs {
class lidar_t;
class pose2D_t;
}  // namespace mbot_lcm_msgs
namespace vulcan_lcm {
class laser_3dof_t;
class laser_t;
class odometry_t;
}  // namespace vulcan_lcm

namespace cairn::wire {

// A message within another is its signature in braces.
#define CAIRN_RPC_HEADER "{q q i q}"
#define CAIRN_RESULT "{" CAIRN_RPC_HEADER " i s i s}"
#define CAIRN_PLACE_REF "q q s"
#define CAIRN_ASSERTION "q i q q q q i s q q s s q q s"
#define CAIRN_STEP "q q q s i s q i q i d i q d s"
#define CAIRN_GATEWAY "d d d d i q"
#define CAIRN_PLACE "q s d d d d[=9] s i i {" CAIRN_GATEWAY "}[8]"
#define CAIRN_SEGMENT "q i q i i i d d d d d[=9] d q"
#define CAIRN_OPENING "d[=4] d d d d d d d d i i s s"
#define CAIRN_PERCEIVED                            \
  "q q q q i i d[=3] d[=3] d s i {" CAIRN_OPENING  \
  "}[10] i i[12] i[12] i f[15] f[15] i i[18] d d " \
  "d i i i b[25]"
#define CAIRN_TILE "i i i b[2]"
#define CAIRN_GRID_MAP "q q q d i i {" CAIRN_TILE "}[5]"
#define CAIRN_TOPOLOGY "q q q q q d q i i {" CAIRN_PLACE "}[8] i {" CAIRN_SEGMENT "}[10]"
#define CAIRN_TRAJECTORY "q q q i q[3] d[3] d[3] d[3] i q[8] i d[10]"
#define CAIRN_VISIT_PLACES "q q q q i q[4]"
#define CAIRN_SIGNATURE(type, text) \
  template <>                       \
  inline constexpr std::string_view kSignatureText<type> = text

CAIRN_SIGNATURE(cairn_lcm::assert_request_t,
                CAIRN_RPC_HEADER "i {" CAIRN_PLACE_REF "} {" CAIRN_PLACE_REF "} q s");
CAIRN_SIGNATURE(cairn_lcm::assertion_report_t, CAIRN_RESULT "q q q d d s i i q[8] q[8] q[8] q[8]");
CAIRN_SIGNATURE(cairn_lcm::assertion_t, CAIRN_ASSERTION);
CAIRN_SIGNATURE(cairn_lcm::assertions_t, "q q q q i {" CAIRN_ASSERTION "}[4]");
CAIRN_SIGNATURE(cairn_lcm::delta_request_t, CAIRN_RPC_HEADER "i q q");
CAIRN_SIGNATURE(cairn_lcm::event_request_t, CAIRN_RPC_HEADER "q");
CAIRN_SIGNATURE(cairn_lcm::explain_request_t, CAIRN_RPC_HEADER "i q q q");
CAIRN_SIGNATURE(cairn_lcm::explained_step_t, CAIRN_STEP);
CAIRN_SIGNATURE(cairn_lcm::explanation_t, CAIRN_RESULT "q i q q d s q i i {" CAIRN_STEP "}[9]");
CAIRN_SIGNATURE(cairn_lcm::frame_change_t, "q q q q q d d d d i q[9] d[9] d[9] d[9]");
CAIRN_SIGNATURE(cairn_lcm::gateway_t, CAIRN_GATEWAY);
CAIRN_SIGNATURE(cairn_lcm::grid_map_t, CAIRN_GRID_MAP);
CAIRN_SIGNATURE(cairn_lcm::hypotheses_t,
                "q q q q q q q q q s s i q[11] q[11] d[11] d[11] i[11] i[11] i[11] i[11]");
CAIRN_SIGNATURE(cairn_lcm::hypothesis_map_t,
                "q q q q q {" CAIRN_TOPOLOGY "} {" CAIRN_GRID_MAP "} {" CAIRN_TRAJECTORY
                "} {" CAIRN_VISIT_PLACES "}");
CAIRN_SIGNATURE(cairn_lcm::laser_scan_t, "q d d d d i f[5]");
CAIRN_SIGNATURE(cairn_lcm::map_delta_t, "q q q i q q d i i i i i b[11]");
CAIRN_SIGNATURE(cairn_lcm::name_request_t, CAIRN_RPC_HEADER "q s");
CAIRN_SIGNATURE(cairn_lcm::odometry_t, "q d d d");
CAIRN_SIGNATURE(cairn_lcm::opening_t, CAIRN_OPENING);
CAIRN_SIGNATURE(cairn_lcm::perceived_place_t, CAIRN_PERCEIVED);
CAIRN_SIGNATURE(cairn_lcm::perception_request_t, CAIRN_RPC_HEADER "q");
CAIRN_SIGNATURE(cairn_lcm::perception_t, CAIRN_RESULT "q {" CAIRN_PERCEIVED "}");
CAIRN_SIGNATURE(cairn_lcm::place_event_t, "q q q i s q q s");
CAIRN_SIGNATURE(cairn_lcm::place_ref_t, CAIRN_PLACE_REF);
CAIRN_SIGNATURE(cairn_lcm::place_t, CAIRN_PLACE);
CAIRN_SIGNATURE(cairn_lcm::plan_request_t, CAIRN_RPC_HEADER "q q s d d d");
CAIRN_SIGNATURE(cairn_lcm::plan_t, CAIRN_RESULT "q q q d i q[5] i s[7] i d[9] d[9] d[9]");
CAIRN_SIGNATURE(cairn_lcm::pose_t, "q q d d d d[=9] q d d d d[=9] i d d d d[=9]");
CAIRN_SIGNATURE(cairn_lcm::result_t, CAIRN_RPC_HEADER " i s i s");
CAIRN_SIGNATURE(cairn_lcm::rpc_header_t, "q q i q");
CAIRN_SIGNATURE(cairn_lcm::segment_t, CAIRN_SEGMENT);
CAIRN_SIGNATURE(cairn_lcm::snapshot_chunk_t, "q q i q q q q i i i i i i b[12]");
CAIRN_SIGNATURE(cairn_lcm::snapshot_request_t, CAIRN_RPC_HEADER "i q q q i i[5]");
CAIRN_SIGNATURE(cairn_lcm::sonar_ring_t, "q i f[1] f[1] f[1] f[1]");
CAIRN_SIGNATURE(cairn_lcm::status_t,
                "q q i s i s s  q q q q  i i i q d i i q s  "
                "i s s s d d d d q q q i f f s q q q q q q q q q s  "
                "q q q q q q q q q q q q q i i f f f");
CAIRN_SIGNATURE(cairn_lcm::tile_t, CAIRN_TILE);
CAIRN_SIGNATURE(cairn_lcm::topology_t, CAIRN_TOPOLOGY);
CAIRN_SIGNATURE(cairn_lcm::trajectory_t, CAIRN_TRAJECTORY);
CAIRN_SIGNATURE(cairn_lcm::visit_places_t, CAIRN_VISIT_PLACES);

CAIRN_SIGNATURE(bot_core::planar_lidar_t, "q i f[1] i f[3] f f");
CAIRN_SIGNATURE(bot_core::pose_t, "q d[=3] d[=3] d[=4] d[=3] d[=3]");
CAIRN_SIGNATURE(mbot_lcm_msgs::lidar_t, "q i f[1] f[1] q[1] f[1]");
CAIRN_SIGNATURE(mbot_lcm_msgs::pose2D_t, "q f f f");
CAIRN_SIGNATURE(vulcan_lcm::laser_3dof_t, "i q i f f h f[5] h[5] f f f f f");
CAIRN_SIGNATURE(vulcan_lcm::laser_t, "i q i f f h f[5] h[5] f f f f f f f f");
CAIRN_SIGNATURE(vulcan_lcm::odometry_t, "q i d d d d d");

#undef CAIRN_SIGNATURE
#undef CAIRN_VISIT_PLACES
#undef CAIRN_TRAJECTORY
#undef CAIRN_TOPOLOGY
#undef CAIRN_GRID_MAP
#undef CAIRN_TILE
#undef CAIRN_PERCEIVED
#undef CAIRN_OPENING
#undef CAIRN_SEGMENT
#undef CAIRN_PLACE
#undef CAIRN_GATEWAY
#undef CAIRN_STEP
#undef CAIRN_ASSERTION
#undef CAIRN_PLACE_REF
#undef CAIRN_RESULT
#undef CAIRN_RPC_HEADER

}  // namespace cairn::wire
