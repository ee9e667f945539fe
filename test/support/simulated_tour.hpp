#pragma once

#include <array>
#include <map>
#include <random>
#include <utility>
#include <vector>

#include "layout/place_layout.hpp"

namespace cairn::test {

/// A robot that wanders about a town of square blocks, to corners where it was not yet by
/// preference, and knows each place again. Places are numbered as they are first reached.
struct SimulatedTour {
  std::vector<Pose2> T_global_place;  ///< The truth.
  std::vector<TravelConstraint> travels;
};

struct TourOptions {
  int place_count = 100;
  unsigned seed = 0;
  double block_m = 10.0;
  double preference = 0.5;  ///< Probability of going to a new corner where there is one.
  double noise_m = 0.05;    ///< Standard deviations of a travel.
  double noise_rad = 0.01;
};

/// The tour until so many places are known.
inline SimulatedTour simulated_tour(const TourOptions& options) {
  std::mt19937 random(options.seed);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  using Corner = std::pair<int, int>;
  constexpr std::array<Corner, 4> kMoves = {{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
  std::map<Corner, int> places = {{{0, 0}, 0}};
  Corner at{0, 0};
  SimulatedTour tour{{Pose2()}, {}};
  Matrix3d covariance = Matrix3d::Zero();
  covariance.diagonal() << options.noise_m * options.noise_m, options.noise_m * options.noise_m,
      options.noise_rad * options.noise_rad;
  while (static_cast<int>(places.size()) < options.place_count) {
    std::vector<Corner> all;
    std::vector<Corner> fresh;
    for (const Corner& move : kMoves) {
      all.emplace_back(at.first + move.first, at.second + move.second);
      if (places.count(all.back()) == 0) {
        fresh.push_back(all.back());
      }
    }
    const bool goes_on = !fresh.empty() && uniform(random) < options.preference;
    const std::vector<Corner>& choices = goes_on ? fresh : all;
    const Corner next = choices[random() % choices.size()];
    const auto [place, is_new] = places.emplace(next, static_cast<int>(places.size()));
    if (is_new) {
      tour.T_global_place.emplace_back(options.block_m * next.first, options.block_m * next.second,
                                       3.0 * normal(random));
    }
    const int from = places.at(at);
    const Pose2 T_from_to = tour.T_global_place[static_cast<std::size_t>(from)].inverse() *
                            tour.T_global_place[static_cast<std::size_t>(place->second)];
    tour.travels.push_back({from,
                            place->second,
                            {Pose2(T_from_to.x() + options.noise_m * normal(random),
                                   T_from_to.y() + options.noise_m * normal(random),
                                   T_from_to.theta() + options.noise_rad * normal(random)),
                             covariance}});
    at = next;
  }
  return tour;
}

}  // namespace cairn::test
