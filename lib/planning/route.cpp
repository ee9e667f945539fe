#include "planning/route.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>
#include <queue>

#include "geometry/angle.hpp"

namespace cairn {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();
constexpr double kStraightBelow_rad = kPi / 8.0;
constexpr double kBackAbove_rad = 7.0 * kPi / 8.0;

std::size_t at(int index) {
  return static_cast<std::size_t>(index);
}

std::string text_of(double length_m) {
  std::array<char, 32> text{};
  static_cast<void>(std::snprintf(text.data(), text.size(), "%.1f m", length_m));
  return text.data();
}

/// @param turn_rad counterclockwise, as the traveller turns
std::string turn_of(double turn_rad) {
  if (std::abs(turn_rad) < kStraightBelow_rad) {
    return "go straight on";
  }
  if (std::abs(turn_rad) > kBackAbove_rad) {
    return "turn back";
  }
  const std::string side = turn_rad > 0.0 ? "left" : "right";
  return std::abs(turn_rad) < kPi / 3.0 ? "bear " + side : "turn " + side;
}

}  // namespace

Result<RoutePlanner> RoutePlanner::of(RouteMap map) {
  const auto is_known = [&](const PlaceGateway& end) {
    return end.place >= 0 && at(end.place) < map.gateway_bearings_rad.size() && end.gateway >= 0 &&
           at(end.gateway) < map.gateway_bearings_rad[at(end.place)].size();
  };
  for (std::size_t i = 0; i < map.segments.size(); ++i) {
    const RouteSegment& segment = map.segments[i];
    if (!is_known(segment.a) || !is_known(segment.b)) {
      return Error{ErrorCode::kInvalidValue,
                   "route map: segment " + std::to_string(i) + " names a missing gateway"};
    }
    if (!(segment.length_m >= 0.0 && std::isfinite(segment.length_m))) {
      return Error{ErrorCode::kInvalidValue, "route map: the length of segment " +
                                                 std::to_string(i) +
                                                 " must be finite and not negative"};
    }
  }
  RoutePlanner planner(std::move(map));
  planner.index_exits();
  return planner;
}

void RoutePlanner::index_exits() {
  first_exit_.assign(map_.gateway_bearings_rad.size() + 1, 0);
  for (const RouteSegment& segment : map_.segments) {
    ++first_exit_[at(segment.a.place) + 1];
    ++first_exit_[at(segment.b.place) + 1];
  }
  for (std::size_t place = 1; place < first_exit_.size(); ++place) {
    first_exit_[place] += first_exit_[place - 1];
  }
  exits_.resize(2 * map_.segments.size());
  std::vector<int> next(first_exit_.begin(), first_exit_.end() - 1);
  for (std::size_t i = 0; i < map_.segments.size(); ++i) {
    exits_[at(next[at(map_.segments[i].a.place)]++)] = {static_cast<int>(i), true};
    exits_[at(next[at(map_.segments[i].b.place)]++)] = {static_cast<int>(i), false};
  }
}

Status RoutePlanner::validate_ends(const std::vector<RouteEnd>& ends,
                                   const std::string& name) const {
  if (ends.empty()) {
    return Error{ErrorCode::kInvalidValue, "route: no " + name + " place"};
  }
  for (const RouteEnd& end : ends) {
    if (end.place < 0 || at(end.place) >= map_.gateway_bearings_rad.size()) {
      return Error{ErrorCode::kInvalidValue,
                   "route: unknown " + name + " place " + std::to_string(end.place)};
    }
    if (!(end.extra_m >= 0.0 && std::isfinite(end.extra_m))) {
      return Error{ErrorCode::kInvalidValue,
                   "route: the extra length at the " + name + " must be finite and not negative"};
    }
  }
  return {};
}

Result<Route> RoutePlanner::find_route(const std::vector<RouteEnd>& starts,
                                       const std::vector<RouteEnd>& goals,
                                       const std::vector<PlaceGateway>& closed) const {
  if (const Status sound = validate_ends(starts, "start"); !sound) {
    return sound.error();
  }
  if (const Status sound = validate_ends(goals, "goal"); !sound) {
    return sound.error();
  }
  std::optional<Route> route = shortest_route(starts, goals, closed);
  if (route) {
    return *std::move(route);
  }
  const bool is_closed_off = !closed.empty() && shortest_route(starts, goals, {}).has_value();
  return Error{ErrorCode::kNotFound,
               "route: no way from place " + std::to_string(starts.front().place) + " to place " +
                   std::to_string(goals.front().place) +
                   (is_closed_off ? " but through closed gateways" : " is known")};
}

std::optional<Route> RoutePlanner::shortest_route(const std::vector<RouteEnd>& starts,
                                                  const std::vector<RouteEnd>& goals,
                                                  const std::vector<PlaceGateway>& closed) const {
  const std::size_t place_count = map_.gateway_bearings_rad.size();
  std::vector<double> reached_m(place_count, kFar);
  std::vector<int> arrived_by(place_count, -1);  // Exit that led here; -1 at a start.
  std::vector<double> goal_m(place_count, kFar);
  for (const RouteEnd& goal : goals) {
    goal_m[at(goal.place)] = std::min(goal_m[at(goal.place)], goal.extra_m);
  }
  using Open = std::pair<double, int>;
  std::priority_queue<Open, std::vector<Open>, std::greater<>> open;
  for (const RouteEnd& start : starts) {
    if (start.extra_m < reached_m[at(start.place)]) {
      reached_m[at(start.place)] = start.extra_m;
      open.emplace(start.extra_m, start.place);
    }
  }
  const auto is_closed = [&](const PlaceGateway& gateway) {
    return std::find(closed.begin(), closed.end(), gateway) != closed.end();
  };
  double best_m = kFar;
  int best_goal = -1;
  while (!open.empty() && open.top().first < best_m) {
    const auto [length_m, place] = open.top();
    open.pop();
    if (length_m > reached_m[at(place)]) {
      continue;
    }
    if (length_m + goal_m[at(place)] < best_m) {
      best_m = length_m + goal_m[at(place)];
      best_goal = place;
    }
    for (int i = first_exit_[at(place)]; i < first_exit_[at(place) + 1]; ++i) {
      const RouteLeg leg = leg_of(exits_[at(i)]);
      const double candidate_m = length_m + leg.length_m;
      if (candidate_m < reached_m[at(leg.arrival.place)] && !is_closed(leg.departure) &&
          !is_closed(leg.arrival)) {
        reached_m[at(leg.arrival.place)] = candidate_m;
        arrived_by[at(leg.arrival.place)] = i;
        open.emplace(candidate_m, leg.arrival.place);
      }
    }
  }
  if (best_goal < 0) {
    return std::nullopt;
  }
  return route_to(best_goal, best_m, arrived_by);
}

Route RoutePlanner::route_to(int goal, double length_m, const std::vector<int>& arrived_by) const {
  Route route;
  route.length_m = length_m;
  route.places.push_back(goal);
  for (int place = goal; arrived_by[at(place)] >= 0; place = route.places.back()) {
    route.legs.push_back(leg_of(exits_[at(arrived_by[at(place)])]));
    route.places.push_back(route.legs.back().departure.place);
  }
  std::reverse(route.places.begin(), route.places.end());
  std::reverse(route.legs.begin(), route.legs.end());
  return route;
}

RouteLeg RoutePlanner::leg_of(Exit exit) const {
  const RouteSegment& segment = map_.segments[at(exit.segment)];
  return exit.from_a ? RouteLeg{segment.a, segment.b, segment.length_m, exit.segment}
                     : RouteLeg{segment.b, segment.a, segment.length_m, exit.segment};
}

std::vector<std::string> RoutePlanner::instructions(const Route& route) const {
  std::vector<std::string> lines;
  for (std::size_t i = 0; i < route.legs.size(); ++i) {
    const RouteLeg& leg = route.legs[i];
    std::string line = "at place " + std::to_string(leg.departure.place) + ": ";
    if (i > 0) {
      const std::vector<double>& bearings_rad = map_.gateway_bearings_rad[at(leg.departure.place)];
      // Who comes in through a gateway looks against its outward bearing.
      const double looking_rad = bearings_rad[at(route.legs[i - 1].arrival.gateway)] + kPi;
      line += turn_of(turn_between(looking_rad, bearings_rad[at(leg.departure.gateway)])) + ", ";
    }
    line += "leave by gateway " + std::to_string(leg.departure.gateway) + " and travel " +
            text_of(leg.length_m) + " to place " + std::to_string(leg.arrival.place);
    lines.push_back(line);
  }
  lines.push_back("arrive at place " + std::to_string(route.places.back()));
  return lines;
}

}  // namespace cairn
