#include "clients/common/perceived_place.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "clients/common/failure.hpp"

namespace cairn::clients {
namespace {

using cairn_lcm::opening_t;
using cairn_lcm::perceived_place_t;

struct Ray {
  double x_m = 0.0;
  double y_m = 0.0;
  double bearing_rad = 0.0;
};

/// A curve that leaves its first end backward and comes into its last one forward: in by one
/// gateway, out by the other.
std::vector<PlacePoint> curve(const Ray& from, const Ray& to) {
  const double reach_m = 0.4 * std::hypot(to.x_m - from.x_m, to.y_m - from.y_m);
  const std::array<double, 4> x{from.x_m, from.x_m - reach_m * std::cos(from.bearing_rad),
                                to.x_m - reach_m * std::cos(to.bearing_rad), to.x_m};
  const std::array<double, 4> y{from.y_m, from.y_m - reach_m * std::sin(from.bearing_rad),
                                to.y_m - reach_m * std::sin(to.bearing_rad), to.y_m};
  std::vector<PlacePoint> points;
  constexpr int kSteps = 24;
  for (int i = 0; i <= kSteps; ++i) {
    const double t = static_cast<double>(i) / kSteps;
    const double s = 1.0 - t;
    const std::array<double, 4> w{s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t};
    points.push_back({w[0] * x[0] + w[1] * x[1] + w[2] * x[2] + w[3] * x[3],
                      w[0] * y[0] + w[1] * y[1] + w[2] * y[2] + w[3] * y[3]});
  }
  return points;
}

const opening_t* gateway_of(const perceived_place_t& place, std::int32_t number) {
  const auto found =
      std::find_if(place.openings.begin(), place.openings.end(),
                   [&](const opening_t& one) { return number >= 0 && one.gateway == number; });
  return found == place.openings.end() ? nullptr : &*found;
}

bool is_finite(const perceived_place_t& place) {
  double sum = place.cell_m + place.origin_x_m + place.origin_y_m + place.distinctiveness_share;
  for (const opening_t& opening : place.openings) {
    sum += opening.x_m + opening.y_m + opening.bearing_rad + opening.width_m;
  }
  return std::isfinite(sum) && std::abs(sum) < 1e9;
}

}  // namespace

void check_perceived_place(const perceived_place_t& place) {
  constexpr std::int32_t kMostCells = 4'096;
  const bool is_grid_sound = place.width >= 0 && place.height >= 0 && place.width <= kMostCells &&
                             place.height <= kMostCells && place.cell_m > 0.0 &&
                             place.cells.size() == static_cast<std::size_t>(place.width) *
                                                       static_cast<std::size_t>(place.height);
  std::size_t points = 0;
  bool is_axis_sound = true;
  for (const std::int32_t count : place.axis_line_points) {
    is_axis_sound = is_axis_sound && count >= 0;
    points += static_cast<std::size_t>(std::max(0, count));
  }
  is_axis_sound = is_axis_sound && points == place.axis_x_m.size();
  if (!is_grid_sound || !is_axis_sound || !is_finite(place)) {
    throw Failure(ExitCode::kBadData, "what was seen at visit " + std::to_string(place.visit) +
                                          " has numbers that do not fit together");
  }
}

std::string opening_label(const perceived_place_t& place, std::size_t i) {
  if (place.openings[i].gateway >= 0) {
    return std::to_string(place.openings[i].gateway);
  }
  const auto before =
      std::count_if(place.openings.begin(), place.openings.begin() + static_cast<std::ptrdiff_t>(i),
                    [](const opening_t& one) { return one.gateway < 0; });
  return std::string(1, static_cast<char>('a' + before % 26));
}

std::vector<PlacePoint> fragment_course(const perceived_place_t& place, std::size_t i) {
  const opening_t* const from = gateway_of(place, place.fragment_from[i]);
  const opening_t* const through = gateway_of(place, place.fragment_through[i]);
  if (from == nullptr) {
    return {};
  }
  const Ray start{from->x_m, from->y_m, from->bearing_rad};
  if (through != nullptr) {
    return curve(start, {through->x_m, through->y_m, through->bearing_rad});
  }
  constexpr double kShare = 0.65;  // Of the way to the middle of the place, its origin.
  const double x_m = (1.0 - kShare) * start.x_m;
  const double y_m = (1.0 - kShare) * start.y_m;
  return curve(start, {x_m, y_m, std::atan2(y_m - start.y_m, x_m - start.x_m)});
}

}  // namespace cairn::clients
