#pragma once

#include <compare>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/result.hpp"

namespace cairn {

/// A gateway of a place, both by number.
struct PlaceGateway {
  int place = 0;
  int gateway = 0;
  friend auto operator<=>(const PlaceGateway&, const PlaceGateway&) = default;
};

/// A path segment: leaving one end's place by its gateway leads to the other's. Both ways.
struct RouteSegment {
  PlaceGateway a;
  PlaceGateway b;
  double length_m = 0.0;  ///< >= 0
};

/// A topological map as planning needs it. Places are numbered 0, 1, ...
struct RouteMap {
  /// By place, then by gateway: outward bearing in the place frame, counterclockwise from its x.
  std::vector<std::vector<double>> gateway_bearings_rad;
  std::vector<RouteSegment> segments;
};

/// A way in or out of the net of places: a place, and what it costs to get there. A robot between
/// two places has two of them.
struct RouteEnd {
  int place = 0;
  double extra_m = 0.0;  ///< From the robot to the place, or from the place to the goal. >= 0
};

/// One travel of a route.
struct RouteLeg {
  PlaceGateway departure;
  PlaceGateway arrival;
  double length_m = 0.0;
  int segment = 0;  ///< Index in RouteMap::segments.
};

struct Route {
  std::vector<int> places;     ///< In order; at least one.
  std::vector<RouteLeg> legs;  ///< One less than places.
  double length_m = 0.0;       ///< With what the ends add.
};

/// Shortest routes over one topological map.
///
/// Source: Kuipers et al., ICRA 2004, Sec. II (the route as travel and turn actions); Thrun and
/// Bücken, AAAI 1996 (planning on the topology instead of the grid).
class RoutePlanner {
 public:
  /// kInvalidValue for a segment that names a missing place or gateway, or has a bad length.
  [[nodiscard]] static Result<RoutePlanner> of(RouteMap map);

  /// The shortest route from any of `starts` to any of `goals` that leaves and enters through no
  /// closed gateway. Ties go to the lower numbers.
  ///
  /// Errors: kInvalidValue for no or unknown places; kNotFound where no route leads there, saying
  /// whether closed gateways are the reason.
  /// Cost: O(segments x log places).
  [[nodiscard]] Result<Route> find_route(const std::vector<RouteEnd>& starts,
                                         const std::vector<RouteEnd>& goals,
                                         const std::vector<PlaceGateway>& closed = {}) const;

  /// The route as instructions for a person or a robot, one line each: where to turn and how far to
  /// travel. Left and right are as seen by the traveller who arrived through the gateway before.
  [[nodiscard]] std::vector<std::string> instructions(const Route& route) const;

  [[nodiscard]] const RouteMap& map() const { return map_; }

 private:
  struct Exit {
    int segment = 0;
    bool from_a = true;
  };

  explicit RoutePlanner(RouteMap map) : map_(std::move(map)) {}

  void index_exits();
  [[nodiscard]] Status validate_ends(const std::vector<RouteEnd>& ends,
                                     const std::string& name) const;
  [[nodiscard]] std::optional<Route> shortest_route(const std::vector<RouteEnd>& starts,
                                                    const std::vector<RouteEnd>& goals,
                                                    const std::vector<PlaceGateway>& closed) const;
  [[nodiscard]] Route route_to(int goal, double length_m, const std::vector<int>& arrived_by) const;
  [[nodiscard]] RouteLeg leg_of(Exit exit) const;

  RouteMap map_;
  std::vector<int> first_exit_;  ///< By place: where its exits begin; one more at the end.
  std::vector<Exit> exits_;
};

}  // namespace cairn
