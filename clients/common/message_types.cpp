#include "clients/common/message_types.hpp"

#include <cstdio>
#include <map>

#include <bot_core/planar_lidar_t.hpp>
#include <bot_core/pose_t.hpp>
#include <cairn_lcm/assert_request_t.hpp>
#include <cairn_lcm/assertion_report_t.hpp>
#include <cairn_lcm/delta_request_t.hpp>
#include <cairn_lcm/event_request_t.hpp>
#include <cairn_lcm/explain_request_t.hpp>
#include <cairn_lcm/explanation_t.hpp>
#include <cairn_lcm/frame_change_t.hpp>
#include <cairn_lcm/hypotheses_t.hpp>
#include <cairn_lcm/laser_scan_t.hpp>
#include <cairn_lcm/map_delta_t.hpp>
#include <cairn_lcm/odometry_t.hpp>
#include <cairn_lcm/perception_request_t.hpp>
#include <cairn_lcm/perception_t.hpp>
#include <cairn_lcm/place_event_t.hpp>
#include <cairn_lcm/plan_request_t.hpp>
#include <cairn_lcm/plan_t.hpp>
#include <cairn_lcm/pose_t.hpp>
#include <cairn_lcm/snapshot_chunk_t.hpp>
#include <cairn_lcm/snapshot_request_t.hpp>
#include <cairn_lcm/sonar_ring_t.hpp>
#include <cairn_lcm/status_t.hpp>
#include <cairn_lcm/topology_t.hpp>
#include <mbot_lcm_msgs/lidar_t.hpp>
#include <mbot_lcm_msgs/pose2D_t.hpp>
#include <vulcan_lcm/laser_3dof_t.hpp>
#include <vulcan_lcm/laser_t.hpp>
#include <vulcan_lcm/odometry_t.hpp>

#include "wire/wire_check.hpp"

namespace cairn::clients {
namespace {

using Names = std::map<std::uint64_t, std::string>;

template <typename... Messages>
void add(Names* names, const std::string& package) {
  (names->emplace(static_cast<std::uint64_t>(Messages::getHash()),
                  package + "." + Messages::getTypeName()),
   ...);
}

Names known_names() {
  Names names;
  add<cairn_lcm::assert_request_t, cairn_lcm::assertion_report_t, cairn_lcm::explain_request_t,
      cairn_lcm::explanation_t, cairn_lcm::delta_request_t, cairn_lcm::event_request_t,
      cairn_lcm::frame_change_t, cairn_lcm::hypotheses_t, cairn_lcm::laser_scan_t,
      cairn_lcm::map_delta_t, cairn_lcm::odometry_t, cairn_lcm::perception_request_t,
      cairn_lcm::perception_t, cairn_lcm::place_event_t, cairn_lcm::plan_request_t,
      cairn_lcm::plan_t, cairn_lcm::pose_t, cairn_lcm::result_t, cairn_lcm::snapshot_chunk_t,
      cairn_lcm::snapshot_request_t, cairn_lcm::sonar_ring_t, cairn_lcm::status_t,
      cairn_lcm::topology_t>(&names, "cairn_lcm");
  add<bot_core::planar_lidar_t, bot_core::pose_t>(&names, "bot_core");
  add<mbot_lcm_msgs::lidar_t, mbot_lcm_msgs::pose2D_t>(&names, "mbot_lcm_msgs");
  add<vulcan_lcm::laser_3dof_t, vulcan_lcm::laser_t, vulcan_lcm::odometry_t>(&names, "vulcan_lcm");
  return names;
}

}  // namespace

std::string message_type_of(const std::vector<std::uint8_t>& bytes) {
  static const Names names = known_names();
  if (bytes.size() < 8) {
    return "no message";
  }
  const std::uint64_t fingerprint = wire::fingerprint_of(bytes.data(), bytes.size());
  const auto name = names.find(fingerprint);
  if (name != names.end()) {
    return name->second;
  }
  char text[24];
  std::snprintf(text, sizeof text, "0x%016llx", static_cast<unsigned long long>(fingerprint));
  return text;
}

}  // namespace cairn::clients
