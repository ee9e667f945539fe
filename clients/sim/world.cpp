#include "clients/sim/world.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace cairn::sim {
namespace {

constexpr double kCheckEvery_m = 0.02;

std::string printed(Point point) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "(%.2f m, %.2f m)", point.x_m, point.y_m);
  return text.data();
}

}  // namespace

const Tour& tour_named(const World& world, const std::string& name) {
  std::string names;
  for (const Tour& tour : world.tours) {
    if (tour.name == name || (name.empty() && world.tours.size() == 1)) {
      return tour;
    }
    names += " " + tour.name;
  }
  if (names.empty()) {
    throw BadWorld("the world has no tour");
  }
  throw BadWorld((name.empty() ? "name a tour" : "there is no tour " + name) +
                 "; there are:" + names);
}

std::vector<Point> path_of(const World& world, const Tour& tour) {
  std::vector<Point> path;
  if (world.start && distance_m(world.start->at, tour.waypoints.front().at) > 0.0) {
    path.push_back(world.start->at);
  }
  for (const NamedPoint& waypoint : tour.waypoints) {
    path.push_back(waypoint.at);
  }
  return path;
}

Pose start_of(const World& world, const Tour& tour) {
  if (world.start) {
    return *world.start;
  }
  return {tour.waypoints[0].at, bearing_rad(tour.waypoints[0].at, tour.waypoints[1].at)};
}

std::optional<std::string> obstacle_on(const FloorPlan& plan, Point from, Point to) {
  // The ends first: where both are on the floor, the leg is no longer than the plan.
  const auto is_blocked = [&plan](Point here) {
    return clearance_m(plan, here, kRobotRadius_m) < kRobotRadius_m;
  };
  for (const Point end : {from, to}) {
    if (is_blocked(end)) {
      return "a wall is less than 0.25 m from " + printed(end);
    }
  }
  const int steps = static_cast<int>(std::ceil(distance_m(from, to) / kCheckEvery_m));
  for (int step = 1; step < steps; ++step) {
    const double share = static_cast<double>(step) / steps;
    const Point here = {from.x_m + share * (to.x_m - from.x_m),
                        from.y_m + share * (to.y_m - from.y_m)};
    if (is_blocked(here)) {
      return "a wall is less than 0.25 m from " + printed(here);
    }
  }
  return std::nullopt;
}

}  // namespace cairn::sim
