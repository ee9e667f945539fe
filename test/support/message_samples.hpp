#pragma once

#include <cstdint>
#include <string>

#include <bot_core/planar_lidar_t.hpp>
#include <bot_core/pose_t.hpp>
#include <cairn_lcm/assert_request_t.hpp>
#include <cairn_lcm/assertion_report_t.hpp>
#include <cairn_lcm/assertion_t.hpp>
#include <cairn_lcm/assertions_t.hpp>
#include <cairn_lcm/delta_request_t.hpp>
#include <cairn_lcm/event_request_t.hpp>
#include <cairn_lcm/explain_request_t.hpp>
#include <cairn_lcm/explained_step_t.hpp>
#include <cairn_lcm/explanation_t.hpp>
#include <cairn_lcm/frame_change_t.hpp>
#include <cairn_lcm/gateway_t.hpp>
#include <cairn_lcm/grid_map_t.hpp>
#include <cairn_lcm/hypotheses_t.hpp>
#include <cairn_lcm/hypothesis_map_t.hpp>
#include <cairn_lcm/laser_scan_t.hpp>
#include <cairn_lcm/map_delta_t.hpp>
#include <cairn_lcm/name_request_t.hpp>
#include <cairn_lcm/odometry_t.hpp>
#include <cairn_lcm/opening_t.hpp>
#include <cairn_lcm/perceived_place_t.hpp>
#include <cairn_lcm/perception_request_t.hpp>
#include <cairn_lcm/perception_t.hpp>
#include <cairn_lcm/place_event_t.hpp>
#include <cairn_lcm/place_ref_t.hpp>
#include <cairn_lcm/place_t.hpp>
#include <cairn_lcm/plan_request_t.hpp>
#include <cairn_lcm/plan_t.hpp>
#include <cairn_lcm/pose_t.hpp>
#include <cairn_lcm/result_t.hpp>
#include <cairn_lcm/rpc_header_t.hpp>
#include <cairn_lcm/segment_t.hpp>
#include <cairn_lcm/snapshot_chunk_t.hpp>
#include <cairn_lcm/snapshot_request_t.hpp>
#include <cairn_lcm/sonar_ring_t.hpp>
#include <cairn_lcm/status_t.hpp>
#include <cairn_lcm/tile_t.hpp>
#include <cairn_lcm/topology_t.hpp>
#include <cairn_lcm/trajectory_t.hpp>
#include <cairn_lcm/visit_places_t.hpp>
#include <mbot_lcm_msgs/lidar_t.hpp>
#include <mbot_lcm_msgs/pose2D_t.hpp>
#include <vulcan_lcm/laser_3dof_t.hpp>
#include <vulcan_lcm/laser_t.hpp>
#include <vulcan_lcm/odometry_t.hpp>

namespace cairn::test {

/// A message with something in every array and string, so that its bytes show all of its type.
template <class T>
T sample() {
  return T{};  // Types of fixed size have nothing to fill.
}

template <>
inline cairn_lcm::grid_map_t sample() {
  cairn_lcm::grid_map_t message{};
  message.num_tiles = 2;
  message.tiles.resize(2);
  for (cairn_lcm::tile_t& tile : message.tiles) {
    tile.num_cells = 4;
    tile.cells = {0, 50, 100, 255};
  }
  return message;
}

template <>
inline cairn_lcm::tile_t sample() {
  return sample<cairn_lcm::grid_map_t>().tiles.front();
}

template <>
inline cairn_lcm::hypotheses_t sample() {
  cairn_lcm::hypotheses_t message{};
  message.guarantee_reason = "budget";
  message.blamed = "visit 7: misread star";
  message.num_hypotheses = 2;
  for (auto* const list : {&message.id, &message.parent_id}) {
    list->assign(2, 7);
  }
  for (auto* const list : {&message.log_posterior, &message.probability}) {
    list->assign(2, 0.5);
  }
  for (auto* const list :
       {&message.num_places, &message.num_paths, &message.num_closures, &message.num_pending}) {
    list->assign(2, 3);
  }
  return message;
}

template <>
inline cairn_lcm::laser_scan_t sample() {
  cairn_lcm::laser_scan_t message{};
  message.utime = 1'000'000;
  message.first_bearing_rad = -1.0;
  message.bearing_step_rad = 0.5;
  message.max_range_m = 10.0;
  message.ranges_m = {1.0F, 2.0F, 3.0F, 4.0F, 5.0F};
  message.num_ranges = 5;
  return message;
}

template <>
inline cairn_lcm::map_delta_t sample() {
  cairn_lcm::map_delta_t message{};
  message.data = {1, 2, 3};
  message.num_bytes = 3;
  return message;
}

template <>
inline cairn_lcm::frame_change_t sample() {
  cairn_lcm::frame_change_t message{};
  message.num_places = 2;
  message.place_id = {3, 4};
  message.dx_m = message.dy_m = message.dtheta_rad = {0.1, 0.2};
  return message;
}

template <>
inline cairn_lcm::place_event_t sample() {
  cairn_lcm::place_event_t message{};
  message.kind_name = "ENTERED";
  message.reason = "an island of reliability";
  return message;
}

template <>
inline cairn_lcm::place_t sample() {
  cairn_lcm::place_t message{};
  message.name = "kitchen";
  message.star = "((gw1 Pa1+))";
  message.gateways.resize(3);
  message.num_gateways = 3;
  return message;
}

template <>
inline cairn_lcm::name_request_t sample() {
  cairn_lcm::name_request_t message{};
  message.name = "kitchen";
  return message;
}

template <>
inline cairn_lcm::plan_request_t sample() {
  cairn_lcm::plan_request_t message{};
  message.goal_name = "kitchen";
  return message;
}

template <>
inline cairn_lcm::result_t sample() {
  cairn_lcm::result_t message{};
  message.code_name = "OK";
  message.reason = "none";
  return message;
}

template <>
inline cairn_lcm::plan_t sample() {
  cairn_lcm::plan_t message{};
  message.result = sample<cairn_lcm::result_t>();
  message.places = {1, 2};
  message.num_places = 2;
  message.steps = {"turn left", "", "arrive"};
  message.num_steps = 3;
  message.x_m = message.y_m = message.theta_rad = {0.0, 1.0};
  message.num_poses = 2;
  return message;
}

template <>
inline cairn_lcm::place_ref_t sample() {
  cairn_lcm::place_ref_t message{};
  message.name = "kitchen";
  return message;
}

template <>
inline cairn_lcm::assert_request_t sample() {
  cairn_lcm::assert_request_t message{};
  message.a = message.b = sample<cairn_lcm::place_ref_t>();
  message.who = "alice";
  return message;
}

template <>
inline cairn_lcm::assertion_report_t sample() {
  cairn_lcm::assertion_report_t message{};
  message.result = sample<cairn_lcm::result_t>();
  message.sentence = "2 visits are at other places now";
  message.num_moved = message.num_listed = 2;
  message.visit = message.known_since_before = message.known_since_after = message.place = {7, 9};
  return message;
}

template <>
inline cairn_lcm::assertion_t sample() {
  cairn_lcm::assertion_t message{};
  message.who = "alice";
  message.effect = "the best map stays as it was";
  message.retracted_by = "bob";
  message.retraction_effect = "the best map stays as it was";
  return message;
}

template <>
inline cairn_lcm::assertions_t sample() {
  cairn_lcm::assertions_t message{};
  message.assertions.assign(2, sample<cairn_lcm::assertion_t>());
  message.num_assertions = 2;
  return message;
}

template <>
inline cairn_lcm::explained_step_t sample() {
  cairn_lcm::explained_step_t message{};
  message.kind_name = "closure";
  message.refuted_by = "the view differs";
  message.sentence = "visit 7: closure: refuted: the view differs";
  return message;
}

template <>
inline cairn_lcm::explanation_t sample() {
  cairn_lcm::explanation_t message{};
  message.result = sample<cairn_lcm::result_t>();
  message.sentence = "hypotheses 1 and 2 part at visit 7";
  message.steps.assign(2, sample<cairn_lcm::explained_step_t>());
  message.num_steps = 2;
  return message;
}

template <>
inline cairn_lcm::opening_t sample() {
  cairn_lcm::opening_t message{};
  message.state_name = "rejected";
  message.reason = "blind alcove";
  return message;
}

template <>
inline cairn_lcm::perceived_place_t sample() {
  cairn_lcm::perceived_place_t message{};
  message.star = "((PF1+, (gw1,out), MIDLINE))";
  message.openings.assign(2, sample<cairn_lcm::opening_t>());
  message.num_openings = 2;
  message.fragment_from = message.fragment_through = {0, 1, 2};
  message.num_fragments = 3;
  message.axis_x_m = message.axis_y_m = {0.0F, 1.0F, 2.0F, 3.0F};
  message.num_axis_points = 4;
  message.axis_line_points = {4};
  message.num_axis_lines = 1;
  message.cell_m = 0.1;
  message.width = 3;
  message.height = 2;
  message.cells = {0, 100, 255, 0, 0, 0};
  message.num_cells = 6;
  return message;
}

template <>
inline cairn_lcm::perception_t sample() {
  cairn_lcm::perception_t message{};
  message.result = sample<cairn_lcm::result_t>();
  message.perceived = sample<cairn_lcm::perceived_place_t>();
  return message;
}

template <>
inline cairn_lcm::visit_places_t sample() {
  cairn_lcm::visit_places_t message{};
  message.place_id = {0, 1, 0};
  message.num_visits = 3;
  return message;
}

template <>
inline cairn_lcm::snapshot_chunk_t sample() {
  cairn_lcm::snapshot_chunk_t message{};
  message.data = {1, 2, 3, 4, 5};
  message.num_bytes = 5;
  return message;
}

template <>
inline cairn_lcm::snapshot_request_t sample() {
  cairn_lcm::snapshot_request_t message{};
  message.missing = {4, 5};
  message.num_missing = 2;
  return message;
}

template <>
inline cairn_lcm::sonar_ring_t sample() {
  cairn_lcm::sonar_ring_t message{};
  message.utime = 1'000'000;
  message.num_sensors = 3;
  message.x_m = message.y_m = message.bearing_rad = message.ranges_m = {0.1F, 0.2F, 0.3F};
  return message;
}

template <>
inline cairn_lcm::status_t sample() {
  cairn_lcm::status_t message{};
  message.version = "0.1.0";
  message.state_name = "MAPPING";
  message.reason = "none";
  message.blamed = "visit 7: misread star";
  message.localisation_name = "degraded";
  message.localisation_cause = "fault";
  message.localisation_reason = "slip: the wheels spin";
  message.fault = "slip";
  message.relocalised = "relocalised near place 3";
  return message;
}

template <>
inline cairn_lcm::topology_t sample() {
  cairn_lcm::topology_t message{};
  message.places.assign(2, sample<cairn_lcm::place_t>());
  message.num_places = 2;
  message.segments.resize(2);
  message.num_segments = 2;
  return message;
}

template <>
inline cairn_lcm::trajectory_t sample() {
  cairn_lcm::trajectory_t message{};
  message.num_poses = 2;
  message.pose_utime = {1, 2};
  message.x_m = message.y_m = message.theta_rad = {0.0, 1.0};
  message.num_key_poses = 1;
  message.key_utime = {1};
  message.num_covariance_entries = 6;
  message.covariance_m2_rad2 = {0.1, 0.0, 0.1, 0.0, 0.0, 0.1};
  return message;
}

template <>
inline cairn_lcm::hypothesis_map_t sample() {
  cairn_lcm::hypothesis_map_t message{};
  message.topology = sample<cairn_lcm::topology_t>();
  message.global_map = sample<cairn_lcm::grid_map_t>();
  message.trajectory = sample<cairn_lcm::trajectory_t>();
  message.visits = sample<cairn_lcm::visit_places_t>();
  return message;
}

template <>
inline bot_core::planar_lidar_t sample() {
  bot_core::planar_lidar_t message{};
  message.utime = 1'000'000;
  message.ranges = {1.0F, 2.0F, 3.0F};
  message.nranges = 3;
  message.intensities = {7.0F};
  message.nintensities = 1;
  message.rad0 = -0.5F;
  message.radstep = 0.5F;
  return message;
}

template <>
inline bot_core::pose_t sample() {
  bot_core::pose_t message{};
  message.utime = 1'000'000;
  message.orientation[0] = 1.0;
  return message;
}

template <>
inline mbot_lcm_msgs::lidar_t sample() {
  mbot_lcm_msgs::lidar_t message{};
  message.utime = 1'000'000;
  message.num_ranges = 3;
  message.ranges = {1.0F, 0.0F, 3.0F};
  message.thetas = {0.0F, 0.5F, 1.0F};
  message.times = {1'000'000, 1'050'000, 1'100'000};
  message.intensities = {1.0F, 1.0F, 1.0F};
  return message;
}

template <class Message>
Message vulcan_laser_sample() {
  Message message{};
  message.timestamp = 1'000'000;
  message.start_angle = -0.5F;
  message.angle_increment = 0.5F;
  message.num_ranges = 3;
  message.ranges = {1.0F, -2.0F, 9.0F};
  message.intensities = {1, 1, 1};
  message.max_range = 8.0F;
  message.offset_x = 0.3F;
  return message;
}

template <>
inline vulcan_lcm::laser_t sample() {
  return vulcan_laser_sample<vulcan_lcm::laser_t>();
}

template <>
inline vulcan_lcm::laser_3dof_t sample() {
  return vulcan_laser_sample<vulcan_lcm::laser_3dof_t>();
}

}  // namespace cairn::test
