#include "place/star_readings.hpp"

#include <algorithm>
#include <cmath>

#include "place/small_scale_star.hpp"

namespace cairn {
namespace {

constexpr std::size_t kMostUnsure = 2;

/// A choice among the unsure gateways.
struct Choice {
  std::vector<bool> is_taken;  ///< By unsure gateway.
  double log_likelihood = 0.0;
};

/// The likelier alternative everywhere, and all others that differ in the least sure ones.
std::vector<Choice> choices(const std::vector<UnsureGateway>& unsure) {
  std::vector<std::size_t> least_sure(unsure.size());
  for (std::size_t i = 0; i < unsure.size(); ++i) {
    least_sure[i] = i;
  }
  std::stable_sort(least_sure.begin(), least_sure.end(), [&](std::size_t a, std::size_t b) {
    return std::abs(unsure[a].log_odds) < std::abs(unsure[b].log_odds);
  });
  least_sure.resize(std::min(least_sure.size(), kMostUnsure));
  Choice likeliest;
  for (const UnsureGateway& one : unsure) {
    likeliest.is_taken.push_back(one.log_odds > 0.0);
  }
  std::vector<Choice> all;
  for (std::size_t flips = 0; flips < (std::size_t{1} << least_sure.size()); ++flips) {
    Choice choice = likeliest;
    for (std::size_t bit = 0; bit < least_sure.size(); ++bit) {
      if ((flips >> bit & 1U) != 0) {
        const std::size_t i = least_sure[bit];
        choice.is_taken[i] = !choice.is_taken[i];
        choice.log_likelihood -= std::abs(unsure[i].log_odds);
      }
    }
    all.push_back(std::move(choice));
  }
  std::stable_sort(all.begin() + 1, all.end(), [](const Choice& a, const Choice& b) {
    return a.log_likelihood > b.log_likelihood;
  });
  return all;
}

std::vector<Gateway> taken(const std::vector<Gateway>& gateways,
                           const std::vector<UnsureGateway>& unsure,
                           const Choice& choice,
                           const Vector2d& center) {
  std::vector<Gateway> all = gateways;
  for (std::size_t i = 0; i < unsure.size(); ++i) {
    if (choice.is_taken[i]) {
      all.push_back(unsure[i].gateway);
    }
  }
  sort_clockwise(center, &all);
  return all;
}

std::vector<int> numbers_in(const std::vector<Gateway>& first, const std::vector<Gateway>& other) {
  std::vector<int> numbers;
  for (const Gateway& gateway : other) {
    const auto found = std::find_if(first.begin(), first.end(), [&](const Gateway& g) {
      return g.basis_points == gateway.basis_points;
    });
    numbers.push_back(found == first.end() ? -1 : static_cast<int>(found - first.begin()));
  }
  return numbers;
}

}  // namespace

StarReadings read_stars(const Vector2d& center,
                        const std::vector<Gateway>& gateways,
                        const std::vector<UnsureGateway>& unsure,
                        const PlaceOptions& options) {
  StarReadings readings;
  for (const Choice& choice : choices(unsure)) {
    const std::vector<Gateway> all = taken(gateways, unsure, choice, center);
    if (all.empty() && !readings.gateways.empty()) {
      continue;
    }
    const std::vector<PathFragment> fragments =
        mutual_straight_continuations(all, options.continuation);
    Star star = small_scale_star(center, all, fragments, options.midline_below_m);
    if (readings.star.slots.empty()) {
      readings.gateways = all;
      readings.fragments = fragments;
      readings.star = std::move(star);
    } else {
      readings.others.push_back(
          {std::move(star), numbers_in(readings.gateways, all), choice.log_likelihood});
    }
  }
  return readings;
}

}  // namespace cairn
