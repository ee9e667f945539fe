#include "transport/map_messages.hpp"

#include <algorithm>

#include "sensing/time.hpp"

namespace cairn {
namespace {

void put(const Matrix3d& covariance, double* out) {
  for (int i = 0; i < 9; ++i) {
    out[i] = covariance(i / 3, i % 3);
  }
}

int count_of(std::size_t size) {
  return static_cast<int>(size);
}

cairn_lcm::gateway_t to_gateway(const MappedGateway& gateway) {
  cairn_lcm::gateway_t message{};
  message.x_m = gateway.perceived.middle.x();
  message.y_m = gateway.perceived.middle.y();
  message.bearing_rad = gateway.perceived.outward_bearing_rad;
  message.width_m = gateway.perceived.width_m;
  message.is_pending = gateway.is_pending ? 1 : 0;
  message.path_id = gateway.path;
  return message;
}

cairn_lcm::place_t to_place(const MappedPlace& place) {
  cairn_lcm::place_t message{};
  message.id = place.id;
  message.name = place.name;
  message.x_m = place.T_global_place.mean.x();
  message.y_m = place.T_global_place.mean.y();
  message.theta_rad = place.T_global_place.mean.theta();
  put(place.T_global_place.covariance, message.covariance_m2_rad2);
  message.star = place.star;
  message.num_visits = place.visit_count;
  std::transform(place.gateways.begin(), place.gateways.end(), std::back_inserter(message.gateways),
                 to_gateway);
  message.num_gateways = count_of(message.gateways.size());
  return message;
}

cairn_lcm::segment_t to_segment(const MappedSegment& segment) {
  cairn_lcm::segment_t message{};
  message.from_place = segment.from_place;
  message.from_gateway = segment.from_gateway;
  message.to_place = segment.to_place;
  message.to_gateway = segment.to_gateway;
  message.num_travels = segment.travel_count;
  message.is_broken = segment.is_broken ? 1 : 0;
  message.length_m = segment.length_m;
  message.dx_m = segment.T_from_to.mean.x();
  message.dy_m = segment.T_from_to.mean.y();
  message.dtheta_rad = segment.T_from_to.mean.theta();
  put(segment.T_from_to.covariance, message.covariance_m2_rad2);
  message.disagreement_sigmas = segment.disagreement_sigmas;
  message.disagreeing_visit = segment.disagreeing_visit;
  return message;
}

/// The place in whose neighbourhood a point lies: no farther from its origin than its gateways.
const MappedPlace* place_around(const MapState& state, const Vector2d& p_global) {
  const MappedPlace* nearest = nullptr;
  double least_m = 0.0;
  for (const MappedPlace& place : state.places) {
    const double distance_m = (place.T_global_place.mean.translation() - p_global).norm();
    double extent_m = 0.0;
    for (const MappedGateway& gateway : place.gateways) {
      extent_m = std::max(extent_m, gateway.perceived.middle.norm());
    }
    if (distance_m <= extent_m && (nearest == nullptr || distance_m < least_m)) {
      nearest = &place;
      least_m = distance_m;
    }
  }
  return nearest;
}

}  // namespace

cairn_lcm::topology_t to_topology(const MapState& state, const Sender& sender) {
  cairn_lcm::topology_t message{};
  message.utime = utime_of(state.time);
  message.boot_id = sender.boot_id;
  message.map_id = sender.map_id;
  message.revision = state.topology_revision;
  message.hypothesis_id = state.hypothesis;
  message.probability = state.probability;
  message.at_place = state.at_place;
  message.num_paths = state.path_count;
  std::transform(state.places.begin(), state.places.end(), std::back_inserter(message.places),
                 to_place);
  message.num_places = count_of(message.places.size());
  std::transform(state.segments.begin(), state.segments.end(), std::back_inserter(message.segments),
                 to_segment);
  message.num_segments = count_of(message.segments.size());
  return message;
}

cairn_lcm::hypotheses_t to_hypotheses(const MapState& state, const Sender& sender) {
  cairn_lcm::hypotheses_t message{};
  message.utime = utime_of(state.time);
  message.boot_id = sender.boot_id;
  message.map_id = sender.map_id;
  message.revision = state.topology_revision;
  message.num_visits = state.visit_count;
  message.num_live = state.live_count;
  message.num_waiting = state.waiting_count;
  message.num_refuted = state.refuted_count;
  message.guarantee_given_up_at = state.guarantee_given_up_at;
  message.guarantee_reason = state.guarantee_reason;
  message.blamed = state.blamed;
  for (const HypothesisSummary& one : state.hypotheses) {
    message.id.push_back(one.id);
    message.parent_id.push_back(one.parent);
    message.log_posterior.push_back(one.log_posterior);
    message.probability.push_back(one.probability);
    message.num_places.push_back(one.places);
    message.num_paths.push_back(one.paths);
    message.num_closures.push_back(one.closures);
    message.num_pending.push_back(one.pending);
  }
  message.num_hypotheses = count_of(message.id.size());
  return message;
}

cairn_lcm::assertions_t to_assertions(const MapState& state, const Sender& sender) {
  const auto place_of = [&state](VisitId visit) {
    return visit.index() < state.place_of_visit.size() ? state.place_of_visit[visit.index()] : -1;
  };
  cairn_lcm::assertions_t message{};
  message.utime = utime_of(state.time);
  message.boot_id = sender.boot_id;
  message.map_id = sender.map_id;
  message.revision = state.topology_revision;
  for (const AuditedAssertion& one : state.assertions) {
    cairn_lcm::assertion_t assertion{};
    assertion.number = one.said.number;
    assertion.is_same = one.said.is_same ? 1 : 0;
    assertion.visit_a = one.said.a.value;
    assertion.visit_b = one.said.b.value;
    assertion.place_a = place_of(one.said.a);
    assertion.place_b = place_of(one.said.b);
    assertion.is_in_force = one.retracted ? 0 : 1;
    assertion.who = one.said.who;
    assertion.made_utime = utime_of(one.made);
    assertion.made_after_visits = one.said.made_after_visits;
    assertion.effect = one.effect;
    assertion.retracted_by = one.said.retracted_by;
    assertion.retracted_utime = one.retracted ? utime_of(*one.retracted) : 0;
    assertion.retracted_after_visits = one.said.retracted_after_visits.value_or(-1);
    assertion.retraction_effect = one.retraction_effect;
    message.assertions.push_back(std::move(assertion));
  }
  message.num_assertions = count_of(message.assertions.size());
  return message;
}

cairn_lcm::trajectory_t to_trajectory(const MapState& state, const Sender& sender) {
  cairn_lcm::trajectory_t message{};
  message.utime = utime_of(state.time);
  message.map_id = sender.map_id;
  message.revision = state.topology_revision;
  for (const TimedPose& posed : state.poses) {
    message.pose_utime.push_back(utime_of(posed.time));
    message.x_m.push_back(posed.T_global_robot.x());
    message.y_m.push_back(posed.T_global_robot.y());
    message.theta_rad.push_back(posed.T_global_robot.theta());
  }
  message.num_poses = count_of(message.pose_utime.size());
  for (std::size_t k = 0; k < state.key_covariances.size(); ++k) {
    message.key_utime.push_back(utime_of(state.key_scans[k]->scan->time));
    const Matrix3d& c = state.key_covariances[k];
    for (const double entry : {c(0, 0), c(0, 1), c(1, 1), c(0, 2), c(1, 2), c(2, 2)}) {
      message.covariance_m2_rad2.push_back(entry);
    }
  }
  message.num_key_poses = count_of(message.key_utime.size());
  message.num_covariance_entries = count_of(message.covariance_m2_rad2.size());
  return message;
}

cairn_lcm::visit_places_t to_visit_places(const MapState& state, const Sender& sender) {
  cairn_lcm::visit_places_t message{};
  message.utime = utime_of(state.time);
  message.boot_id = sender.boot_id;
  message.map_id = sender.map_id;
  message.revision = state.topology_revision;
  message.place_id.assign(state.place_of_visit.begin(), state.place_of_visit.end());
  message.num_visits = count_of(message.place_id.size());
  return message;
}

cairn_lcm::pose_t to_pose(const LocalFix& fix,
                          const GaussianPose* T_global_robot,
                          const MapState* state,
                          const Sender& sender) {
  cairn_lcm::pose_t message{};
  message.utime = utime_of(fix.time);
  message.boot_id = sender.boot_id;
  message.lpm_x_m = fix.T_lpm_robot.x();
  message.lpm_y_m = fix.T_lpm_robot.y();
  message.lpm_theta_rad = fix.T_lpm_robot.theta();
  put(fix.covariance, message.lpm_covariance_m2_rad2);
  message.place_id = -1;
  if (T_global_robot == nullptr) {
    return message;
  }
  message.is_global_known = 1;
  message.global_x_m = T_global_robot->mean.x();
  message.global_y_m = T_global_robot->mean.y();
  message.global_theta_rad = T_global_robot->mean.theta();
  put(T_global_robot->covariance, message.global_covariance_m2_rad2);
  const MappedPlace* const place =
      state == nullptr ? nullptr : place_around(*state, T_global_robot->mean.translation());
  if (place != nullptr) {
    const GaussianPose T_place_robot =
        compounded(inverted({place->T_global_place.mean, Matrix3d::Zero()}), *T_global_robot);
    message.place_id = place->id;
    message.place_x_m = T_place_robot.mean.x();
    message.place_y_m = T_place_robot.mean.y();
    message.place_theta_rad = T_place_robot.mean.theta();
    put(T_place_robot.covariance, message.place_covariance_m2_rad2);
  }
  return message;
}

}  // namespace cairn
