#include "runtime/planner.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "planning/route.hpp"

namespace cairn {
namespace {

using Code = cairn_lcm::result_t;

const char* name_of(std::int32_t code) {
  switch (code) {
    case Code::OK:
      return "OK";
    case Code::ACCEPTED:
      return "ACCEPTED";
    case Code::BAD_REQUEST:
      return "BAD_REQUEST";
    case Code::NOT_FOUND:
      return "NOT_FOUND";
    case Code::TOO_OLD:
      return "TOO_OLD";
    case Code::BUSY:
      return "BUSY";
    default:
      return "FAILED";
  }
}

std::int32_t code_of(const Error& error) {
  switch (error.code) {
    case ErrorCode::kInvalidValue:
    case ErrorCode::kContradiction:
      return Code::BAD_REQUEST;
    case ErrorCode::kNotFound:
      return Code::NOT_FOUND;
    default:
      return Code::FAILED;
  }
}

/// Where a plan begins or ends: in the frame of the map, and at which place.
struct End {
  Vector2d p_global = Vector2d::Zero();
  int place = -1;
  bool is_place = false;
};

End end_at_place(const MapState& state, std::int64_t place) {
  const auto index = static_cast<std::size_t>(place);
  return {state.places[index].T_global_place.mean.translation(), static_cast<int>(place), true};
}

End end_at(const MapState& state, const Vector2d& p_global) {
  End end{p_global, -1, false};
  double least_m = std::numeric_limits<double>::infinity();
  for (const MappedPlace& place : state.places) {
    const double distance_m = (place.T_global_place.mean.translation() - p_global).norm();
    if (distance_m < least_m) {
      least_m = distance_m;
      end.place = place.id;
    }
  }
  return end;
}

Error no_such_place(std::int64_t place, const MapState& state) {
  return {ErrorCode::kNotFound,
          "there is no place " + std::to_string(place) + "; the map has " +
              (state.places.empty() ? "none yet"
                                    : "places 0 to " + std::to_string(state.places.size() - 1))};
}

bool has_place(const MapState& state, std::int64_t place) {
  return place >= 0 && place < static_cast<std::int64_t>(state.places.size());
}

Result<End> start_of(const cairn_lcm::plan_request_t& request, const MapState& state) {
  if (request.from_place >= 0) {
    if (!has_place(state, request.from_place)) {
      return no_such_place(request.from_place, state);
    }
    return end_at_place(state, request.from_place);
  }
  if (state.trajectory.empty()) {
    return Error{ErrorCode::kNotFound, "the robot's pose is not known: no scan has come yet"};
  }
  return end_at(state, state.trajectory.back().T_global_robot.translation());
}

Result<End> goal_of(const cairn_lcm::plan_request_t& request, const MapState& state) {
  if (!request.goal_name.empty()) {
    const auto named =
        std::find_if(state.places.begin(), state.places.end(),
                     [&](const MappedPlace& place) { return place.name == request.goal_name; });
    if (named == state.places.end()) {
      return Error{ErrorCode::kNotFound, "no place is called '" + request.goal_name + "'"};
    }
    return end_at_place(state, named->id);
  }
  if (request.goal_place >= 0) {
    if (!has_place(state, request.goal_place)) {
      return no_such_place(request.goal_place, state);
    }
    return end_at_place(state, request.goal_place);
  }
  if (!std::isfinite(request.goal_x_m) || !std::isfinite(request.goal_y_m)) {
    return Error{ErrorCode::kInvalidValue, "the goal's coordinates must be finite, in metres"};
  }
  return end_at(state, {request.goal_x_m, request.goal_y_m});
}

RouteMap route_map_of(const MapState& state) {
  RouteMap map;
  for (const MappedPlace& place : state.places) {
    std::vector<double>& bearings = map.gateway_bearings_rad.emplace_back();
    for (const MappedGateway& gateway : place.gateways) {
      bearings.push_back(gateway.perceived.outward_bearing_rad);
    }
  }
  for (const MappedSegment& segment : state.segments) {
    map.segments.push_back({{segment.from_place, segment.from_gateway},
                            {segment.to_place, segment.to_gateway},
                            segment.length_m});
  }
  return map;
}

/// Points along the route: where the robot drove when it travelled its segments.
std::vector<Vector2d> way_along(const Route& route,
                                const MapState& state,
                                const End& start,
                                const End& goal) {
  std::vector<Vector2d> way{start.p_global};
  for (const RouteLeg& leg : route.legs) {
    const MappedSegment& segment = state.segments[static_cast<std::size_t>(leg.segment)];
    std::vector<Vector2d> driven;
    for (std::size_t i = segment.first_scan; i <= segment.last_scan; ++i) {
      driven.push_back(state.trajectory[i].T_global_robot.translation());
    }
    if ((driven.front() - way.back()).norm() > (driven.back() - way.back()).norm()) {
      std::reverse(driven.begin(), driven.end());
    }
    way.insert(way.end(), driven.begin(), driven.end());
  }
  way.push_back(goal.p_global);
  return way;
}

Result<Route> route_between(const End& start,
                            const End& goal,
                            const MapState& state,
                            std::vector<std::string>* steps) {
  const Result<RoutePlanner> planner = RoutePlanner::of(route_map_of(state));
  if (!planner) {
    return planner.error();
  }
  Result<Route> route = planner->find_route({{start.place, 0.0}}, {{goal.place, 0.0}});
  if (route) {
    *steps = planner->instructions(*route);
  }
  return route;
}

Result<MetricPath> path_between(const End& start,
                                const End& goal,
                                std::optional<double> heading_rad,
                                const std::vector<Vector2d>& way,
                                const GlobalMap& map,
                                PathOptions options) {
  const Result<OccupancyGrid> grid = map.to_grid();
  if (!grid) {
    return grid.error();
  }
  if (goal.is_place) {
    // A place is a neighbourhood: any spot close to its origin is there.
    options.goal_tolerance_m = std::max(options.goal_tolerance_m, 1.0);
  }
  if (start.is_place) {
    options.start_tolerance_m = std::max(options.start_tolerance_m, 1.0);
  }
  return PathPlanner(*grid, options).find_path(start.p_global, {goal.p_global, heading_rad}, way);
}

void put(const MetricPath& path, cairn_lcm::plan_t* plan) {
  plan->length_m = path.length_m;
  for (const Pose2& waypoint : path.T_global_waypoint) {
    plan->x_m.push_back(waypoint.x());
    plan->y_m.push_back(waypoint.y());
    plan->theta_rad.push_back(waypoint.theta());
  }
  plan->num_poses = static_cast<int>(plan->x_m.size());
}

}  // namespace

cairn_lcm::result_t to_result(const cairn_lcm::rpc_header_t& request, const Status& status) {
  cairn_lcm::result_t result{};
  result.header = request;
  result.code = status ? std::int32_t{Code::OK} : code_of(status.error());
  result.code_name = name_of(result.code);
  result.reason = status ? "" : status.error().message;
  return result;
}

cairn_lcm::plan_t refusal(const cairn_lcm::rpc_header_t& request,
                          const Sender& sender,
                          std::int32_t code,
                          const std::string& reason) {
  cairn_lcm::plan_t plan{};
  plan.result.header = request;
  plan.result.header.boot_id = sender.boot_id;
  plan.result.code = code;
  plan.result.code_name = name_of(code);
  plan.result.retry_after_ms = code == Code::BUSY ? 200 : 0;
  plan.result.reason = reason;
  plan.map_id = sender.map_id;
  return plan;
}

cairn_lcm::plan_t answer(const cairn_lcm::plan_request_t& request,
                         const MapState& state,
                         const GlobalMap& map,
                         const PathOptions& options,
                         const Sender& sender) {
  const auto refused = [&](const Error& error) {
    return refusal(request.header, sender, code_of(error), error.message);
  };
  const Result<End> start = start_of(request, state);
  if (!start) {
    return refused(start.error());
  }
  const Result<End> goal = goal_of(request, state);
  if (!goal) {
    return refused(goal.error());
  }
  cairn_lcm::plan_t plan = refusal(request.header, sender, Code::OK, "");
  plan.map_revision = state.topology_revision;
  plan.hypothesis_id = state.hypothesis;
  std::vector<Vector2d> way;
  if (start->place >= 0 && goal->place >= 0 && start->place != goal->place) {
    const Result<Route> route = route_between(*start, *goal, state, &plan.steps);
    if (!route) {
      return refused(route.error());
    }
    plan.places.assign(route->places.begin(), route->places.end());
    way = way_along(*route, state, *start, *goal);
  }
  const std::optional<double> heading_rad =
      std::isfinite(request.goal_theta_rad) && request.goal_place < 0 && request.goal_name.empty()
          ? std::optional(request.goal_theta_rad)
          : std::nullopt;
  const Result<MetricPath> path = path_between(*start, *goal, heading_rad, way, map, options);
  if (!path) {
    return refused(path.error());
  }
  plan.num_places = static_cast<int>(plan.places.size());
  plan.num_steps = static_cast<int>(plan.steps.size());
  put(*path, &plan);
  return plan;
}

}  // namespace cairn
