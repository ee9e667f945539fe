#include "layout/stale_places.hpp"

#include <cmath>
#include <utility>

namespace cairn {
namespace {

/// A travel is expanded anew where the heading of its departure has turned by more since,
constexpr double kStaleTurn_rad = 1e-4;
/// or where the expansion is off by more standard deviations.
constexpr double kStaleSigmas = 1e-4;
/// Beside places that are expanded anew, this share of both is enough: else the border creeps.
constexpr double kBorderShare = 0.5;

std::size_t at(int index) {
  return static_cast<std::size_t>(index);
}

/// A residual is linear in the places but for the heading of departure: as that turns, it is off by
/// the turn times what the way has changed, and by half its square times the way.
bool is_stale(const TravelResidual& travel,
              const Eigen::Vector3d& step_from,
              const Eigen::Vector3d& step_to,
              double share) {
  const double turn_rad = std::abs(step_from.z());
  if (turn_rad > share * kStaleTurn_rad) {
    return true;
  }
  const double change_m = (step_to - step_from).head<2>().norm();
  const double way_m = travel.measured.head<2>().norm();
  const double per_m = travel.whitening.topLeftCorner<2, 2>().norm();
  return per_m * turn_rad * (change_m + 0.5 * turn_rad * way_m) > share * kStaleSigmas;
}

}  // namespace

std::vector<int> stale_places(const LinearisedTravels& travels,
                              const PlaceVector& steps,
                              const std::vector<int>& changed) {
  std::vector<int> stale;
  std::vector<char> is_in(steps.size(), 0);
  const auto add = [&](int place) {
    if (place != 0 && std::exchange(is_in[at(place)], 1) == 0) {
      stale.push_back(place);
    }
  };
  for (const int place : changed) {
    travels.graph.for_each_travel_of(place, [&](int index) {
      const TravelResidual& travel = travels.graph.travel(index);
      if (travels.is_active[at(travel.from)] != 0 && travels.is_active[at(travel.to)] != 0 &&
          is_stale(travel, steps[at(travel.from)], steps[at(travel.to)], 1.0)) {
        add(travel.from);
        add(travel.to);
      }
    });
  }
  for (std::size_t i = 0; i < stale.size(); ++i) {
    travels.graph.for_each_travel_of(stale[i], [&](int index) {
      const TravelResidual& travel = travels.graph.travel(index);
      if (travel.to == stale[i] && travels.is_active[at(travel.from)] != 0 &&
          is_stale(travel, steps[at(travel.from)], Eigen::Vector3d::Zero(), kBorderShare)) {
        add(travel.from);
      }
    });
  }
  return stale;
}

}  // namespace cairn
