#include "clients/common/json.hpp"

#include <cmath>

namespace cairn::clients {
namespace {

using Json = nlohmann::ordered_json;

// JSON has no NaN and no infinity.
Json number(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

Json matrix(const double (&values)[9]) {
  Json array = Json::array();
  for (const double value : values) {
    array.push_back(number(value));
  }
  return array;
}

Json to_json(const cairn_lcm::gateway_t& gateway, int index) {
  return {{"gateway", index},
          {"x_m", number(gateway.x_m)},
          {"y_m", number(gateway.y_m)},
          {"bearing_rad", number(gateway.bearing_rad)},
          {"width_m", number(gateway.width_m)},
          {"is_pending", gateway.is_pending != 0},
          {"path_id", gateway.path_id}};
}

Json to_json(const cairn_lcm::place_t& place) {
  Json json = {{"id", place.id},
               {"name", place.name},
               {"x_m", number(place.x_m)},
               {"y_m", number(place.y_m)},
               {"theta_rad", number(place.theta_rad)},
               {"covariance_m2_rad2", matrix(place.covariance_m2_rad2)},
               {"star", place.star},
               {"num_visits", place.num_visits},
               {"gateways", Json::array()}};
  int index = 0;
  for (const cairn_lcm::gateway_t& gateway : place.gateways) {
    json["gateways"].push_back(to_json(gateway, index++));
  }
  return json;
}

Json to_json(const cairn_lcm::segment_t& segment) {
  return {{"from_place", segment.from_place},
          {"from_gateway", segment.from_gateway},
          {"to_place", segment.to_place},
          {"to_gateway", segment.to_gateway},
          {"num_travels", segment.num_travels},
          {"is_broken", segment.is_broken != 0},
          {"length_m", number(segment.length_m)},
          {"dx_m", number(segment.dx_m)},
          {"dy_m", number(segment.dy_m)},
          {"dtheta_rad", number(segment.dtheta_rad)},
          {"covariance_m2_rad2", matrix(segment.covariance_m2_rad2)},
          {"disagreement_sigmas", number(segment.disagreement_sigmas)},
          {"disagreeing_visit", segment.disagreeing_visit}};
}

Json counters_of(const cairn_lcm::status_t& status) {
  return {{"scans_received", status.scans_received},
          {"scans_mapped", status.scans_mapped},
          {"scans_dropped", status.scans_dropped},
          {"scans_refused", status.scans_refused},
          {"scans_out_of_order", status.scans_out_of_order},
          {"laser_changes", status.laser_changes},
          {"odometry_received", status.odometry_received},
          {"odometry_refused", status.odometry_refused},
          {"clock_steps", status.clock_steps},
          {"decode_errors", status.decode_errors},
          {"unknown_types", status.unknown_types},
          {"udp_drops", status.udp_drops},
          {"foreign_daemons", status.foreign_daemons},
          {"scan_age_ms", status.scan_age_ms},
          {"odometry_age_ms", status.odometry_age_ms},
          {"update_ms_p50", number(status.update_ms_p50)},
          {"update_ms_max", number(status.update_ms_max)},
          {"rss_mb", number(status.rss_mb)}};
}

Json localisation_of(const cairn_lcm::status_t& status) {
  return {{"state", status.localisation},
          {"state_name", status.localisation_name},
          {"cause", status.localisation_cause},
          {"reason", status.localisation_reason},
          {"error_m", number(status.localisation_error_m)},
          {"error_min_m", number(status.localisation_error_min_m)},
          {"error_max_m", number(status.localisation_error_max_m)},
          {"times_lost", status.times_lost},
          {"distinctiveness_share", number(status.distinctiveness_share)},
          {"local_map_restarts", status.local_map_restarts},
          {"scans_not_mapped", status.scans_not_mapped},
          {"is_using_odometry", status.is_using_odometry != 0},
          {"no_odometry_s", number(status.no_odometry_s)},
          {"no_scans_s", number(status.no_scans_s)},
          {"relocalisations", status.relocalisations},
          {"relocalised", status.relocalised},
          {"fault", status.fault},
          {"faults",
           {{"slips", status.slips},
            {"carryings", status.carryings},
            {"odometry_stalls", status.odometry_stalls},
            {"scan_stalls", status.scan_stalls},
            {"bumps", status.bumps},
            {"teleports", status.teleports},
            {"laser_reversals", status.laser_reversals},
            {"laser_inversions", status.laser_inversions}}}};
}

}  // namespace

Json to_json(const cairn_lcm::status_t& status) {
  Json json = {{"utime", status.utime},
               {"boot_id", status.boot_id},
               {"protocol_version", status.protocol_version},
               {"version", status.version},
               {"state", status.state},
               {"state_name", status.state_name},
               {"reason", status.reason},
               {"map_id", status.map_id},
               {"map_revision", status.map_revision},
               {"topology_revision", status.topology_revision},
               {"event_number", status.event_number},
               {"num_places", status.num_places},
               {"num_visits", status.num_visits},
               {"num_hypotheses", status.num_hypotheses},
               {"num_waiting", status.num_waiting},
               {"best_probability", number(status.best_probability)},
               {"is_localized", status.is_localized != 0},
               {"is_guarantee_kept", status.is_guarantee_kept != 0},
               {"guarantee_given_up_at", status.guarantee_given_up_at},
               {"blamed", status.blamed}};
  json["localisation"] = localisation_of(status);
  json.update(counters_of(status));
  return json;
}

Json to_json(const cairn_lcm::topology_t& topology) {
  Json json = {{"utime", topology.utime},
               {"boot_id", topology.boot_id},
               {"map_id", topology.map_id},
               {"revision", topology.revision},
               {"hypothesis_id", topology.hypothesis_id},
               {"probability", number(topology.probability)},
               {"at_place", topology.at_place},
               {"num_paths", topology.num_paths},
               {"places", Json::array()},
               {"segments", Json::array()}};
  for (const cairn_lcm::place_t& place : topology.places) {
    json["places"].push_back(to_json(place));
  }
  for (const cairn_lcm::segment_t& segment : topology.segments) {
    json["segments"].push_back(to_json(segment));
  }
  return json;
}

Json to_json(const cairn_lcm::hypotheses_t& hypotheses) {
  Json json = {{"utime", hypotheses.utime},
               {"boot_id", hypotheses.boot_id},
               {"map_id", hypotheses.map_id},
               {"revision", hypotheses.revision},
               {"num_visits", hypotheses.num_visits},
               {"num_live", hypotheses.num_live},
               {"num_waiting", hypotheses.num_waiting},
               {"num_refuted", hypotheses.num_refuted},
               {"guarantee_given_up_at", hypotheses.guarantee_given_up_at},
               {"guarantee_reason", hypotheses.guarantee_reason},
               {"blamed", hypotheses.blamed},
               {"hypotheses", Json::array()}};
  for (std::size_t i = 0; i < hypotheses.id.size(); ++i) {
    json["hypotheses"].push_back({{"id", hypotheses.id[i]},
                                  {"parent_id", hypotheses.parent_id[i]},
                                  {"log_posterior", number(hypotheses.log_posterior[i])},
                                  {"probability", number(hypotheses.probability[i])},
                                  {"num_places", hypotheses.num_places[i]},
                                  {"num_paths", hypotheses.num_paths[i]},
                                  {"num_closures", hypotheses.num_closures[i]},
                                  {"num_pending", hypotheses.num_pending[i]}});
  }
  return json;
}

Json to_json(const cairn_lcm::place_event_t& event) {
  return {{"utime", event.utime},
          {"boot_id", event.boot_id},
          {"event_number", event.event_number},
          {"kind", event.kind},
          {"kind_name", event.kind_name},
          {"visit_id", event.visit_id},
          {"place_id", event.place_id},
          {"reason", event.reason}};
}

Json to_json(const cairn_lcm::frame_change_t& change) {
  Json places = Json::array();
  for (std::size_t i = 0; i < change.place_id.size(); ++i) {
    places.push_back({{"place_id", change.place_id[i]},
                      {"dx_m", number(change.dx_m[i])},
                      {"dy_m", number(change.dy_m[i])},
                      {"dtheta_rad", number(change.dtheta_rad[i])}});
  }
  return {{"utime", change.utime},
          {"boot_id", change.boot_id},
          {"map_id", change.map_id},
          {"older_revision", change.older_revision},
          {"newer_revision", change.newer_revision},
          {"robot_dx_m", number(change.robot_dx_m)},
          {"robot_dy_m", number(change.robot_dy_m)},
          {"robot_dtheta_rad", number(change.robot_dtheta_rad)},
          {"largest_move_m", number(change.largest_move_m)},
          {"places", places}};
}

Json to_json(const cairn_lcm::pose_t& pose) {
  return {{"utime", pose.utime},
          {"boot_id", pose.boot_id},
          {"lpm_x_m", number(pose.lpm_x_m)},
          {"lpm_y_m", number(pose.lpm_y_m)},
          {"lpm_theta_rad", number(pose.lpm_theta_rad)},
          {"lpm_covariance_m2_rad2", matrix(pose.lpm_covariance_m2_rad2)},
          {"place_id", pose.place_id},
          {"place_x_m", number(pose.place_x_m)},
          {"place_y_m", number(pose.place_y_m)},
          {"place_theta_rad", number(pose.place_theta_rad)},
          {"place_covariance_m2_rad2", matrix(pose.place_covariance_m2_rad2)},
          {"is_global_known", pose.is_global_known != 0},
          {"global_x_m", number(pose.global_x_m)},
          {"global_y_m", number(pose.global_y_m)},
          {"global_theta_rad", number(pose.global_theta_rad)},
          {"global_covariance_m2_rad2", matrix(pose.global_covariance_m2_rad2)}};
}

Json to_json(const cairn_lcm::plan_t& plan) {
  Json json = {{"map_id", plan.map_id},
               {"map_revision", plan.map_revision},
               {"hypothesis_id", plan.hypothesis_id},
               {"length_m", number(plan.length_m)},
               {"places", plan.places},
               {"steps", plan.steps},
               {"poses", Json::array()}};
  for (std::size_t i = 0; i < plan.x_m.size(); ++i) {
    json["poses"].push_back({{"x_m", number(plan.x_m[i])},
                             {"y_m", number(plan.y_m[i])},
                             {"theta_rad", number(plan.theta_rad[i])}});
  }
  return json;
}

Json to_json(const cairn_lcm::assertion_report_t& report) {
  Json json = {{"map_id", report.map_id},
               {"assertion", report.assertion},
               {"hypothesis_id", report.hypothesis_id},
               {"before_log_posterior", number(report.before_log_posterior)},
               {"after_log_posterior", number(report.after_log_posterior)},
               {"sentence", report.sentence},
               {"num_moved", report.num_moved},
               {"moved", Json::array()}};
  for (std::size_t i = 0; i < report.visit.size(); ++i) {
    json["moved"].push_back({{"visit", report.visit[i]},
                             {"known_since_before", report.known_since_before[i]},
                             {"known_since_after", report.known_since_after[i]},
                             {"place", report.place[i]}});
  }
  return json;
}

Json to_json(const cairn_lcm::assertions_t& assertions) {
  Json json = {{"map_id", assertions.map_id},
               {"revision", assertions.revision},
               {"assertions", Json::array()}};
  for (const cairn_lcm::assertion_t& one : assertions.assertions) {
    json["assertions"].push_back({{"number", one.number},
                                  {"is_same", one.is_same != 0},
                                  {"visit_a", one.visit_a},
                                  {"visit_b", one.visit_b},
                                  {"place_a", one.place_a},
                                  {"place_b", one.place_b},
                                  {"is_in_force", one.is_in_force != 0},
                                  {"who", one.who},
                                  {"made_utime", one.made_utime},
                                  {"made_after_visits", one.made_after_visits},
                                  {"effect", one.effect},
                                  {"retracted_by", one.retracted_by},
                                  {"retracted_utime", one.retracted_utime},
                                  {"retracted_after_visits", one.retracted_after_visits},
                                  {"retraction_effect", one.retraction_effect}});
  }
  return json;
}

Json to_json(const cairn_lcm::explained_step_t& step) {
  Json json = {{"visit", step.visit},
               {"hypothesis_id", step.hypothesis_id},
               {"at_place", step.at_place},
               {"kind", step.kind_name},
               {"is_taken", step.is_taken != 0},
               {"refuted_by", step.refuted_by},
               {"from_place", step.from_place},
               {"from_gateway", step.from_gateway},
               {"to_place", step.to_place},
               {"to_gateway", step.to_gateway},
               {"log_likelihood", number(step.log_likelihood)},
               {"sentence", step.sentence}};
  if (step.is_fate_known != 0) {
    json["fate"] = {{"visit", step.fate_visit},
                    {"is_refuted", !std::isfinite(step.fate_log_odds)},
                    {"log_odds", number(step.fate_log_odds)}};
  }
  return json;
}

Json to_json(const cairn_lcm::explanation_t& explanation) {
  Json json = {{"map_id", explanation.map_id},
               {"hypothesis_id", explanation.hypothesis_id},
               {"visit", explanation.visit},
               {"log_odds", number(explanation.log_odds)},
               {"sentence", explanation.sentence},
               {"num_left_out", explanation.num_left_out},
               {"steps", Json::array()}};
  for (const cairn_lcm::explained_step_t& step : explanation.steps) {
    json["steps"].push_back(to_json(step));
  }
  return json;
}

std::string dumped(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace);
}

std::string dumped_line(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace cairn::clients
