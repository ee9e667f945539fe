#include "service/recalled_readings.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include "base/validator.hpp"
#include "geometry/angle.hpp"
#include "place/gateway.hpp"
#include "star/isomorphism.hpp"
#include "star/star_edits.hpp"

namespace cairn {
namespace {

/// The maps lie on each other, so that gateways differ by where along their way they were read.
constexpr double kAside_m = 1.0;
constexpr double kAlong_m = 3.0;
constexpr double kSameDirection_rad = 0.7;
/// Of headings by dead reckoning and by gateways, before the maps are compared.
constexpr double kGatewaySigma_rad = 0.25;
constexpr double kReach_sigmas = 3.0;
/// A star that differs in its fragments alone differs, too.
constexpr double kLeastDifference = 0.3;

bool is_same(const Gateway& a, const Gateway& b) {
  const Vector2d apart = b.middle - a.middle;
  const double along_m = apart.dot(a.outward());
  const double aside_m = (apart - along_m * a.outward()).norm();
  return aside_m < kAside_m && std::abs(along_m) < kAlong_m &&
         std::abs(turn_between(a.outward_bearing_rad, b.outward_bearing_rad)) < kSameDirection_rad;
}

bool is_listed(const std::vector<int>& gateways, int gateway) {
  return std::find(gateways.begin(), gateways.end(), gateway) != gateways.end();
}

/// For each gateway of the known visit the nearest one of the visit that is the same; -1: none.
/// @param visit in the frame of the known one's place
std::vector<int> seen_gateways(const std::vector<Gateway>& known,
                               const std::vector<Gateway>& visit) {
  std::vector<int> seen;
  for (const Gateway& gateway : known) {
    int nearest = -1;
    double least_m = std::numeric_limits<double>::infinity();
    for (std::size_t v = 0; v < visit.size(); ++v) {
      const double away_m = (visit[v].middle - gateway.middle).norm();
      if (!is_listed(seen, static_cast<int>(v)) && is_same(gateway, visit[v]) && away_m < least_m) {
        least_m = away_m;
        nearest = static_cast<int>(v);
      }
    }
    seen.push_back(nearest);
  }
  return seen;
}

/// How far clockwise b is from a, around the place's origin, in [0, 2 pi).
double clockwise_rad(const Gateway& a, const Gateway& b) {
  const double turn_rad =
      std::atan2(a.middle.y(), a.middle.x()) - std::atan2(b.middle.y(), b.middle.x());
  return turn_rad < 0.0 ? turn_rad + 2.0 * std::numbers::pi : turn_rad;
}

/// A star with the gateways that it has, each at its place.
struct PlacedReading {
  Reading reading;
  std::vector<Gateway> gateways;  ///< Of reading.star, in the frame of the known visit's place.
};

/// Which number a gateway of the visit gets that the reading lacks: after the last one before it
/// that both visits saw, and after those of the known visit alone that come before it clockwise.
int number_of_additional(const PlacedReading& placed,
                         const std::vector<Gateway>& visit,
                         int added) {
  const int of_visit = static_cast<int>(visit.size());
  const std::vector<int>& named = placed.reading.gateways;
  std::size_t before = 0;
  for (int back = 1; back < of_visit; ++back) {
    const auto at = std::find(named.begin(), named.end(), (added - back + of_visit) % of_visit);
    if (at != named.end()) {
      before = static_cast<std::size_t>(at - named.begin());
      break;
    }
  }
  const Gateway& start = placed.gateways[before];
  const double turn_rad = clockwise_rad(start, visit[static_cast<std::size_t>(added)]);
  std::size_t number = before + 1;
  for (; number < before + named.size(); ++number) {
    const std::size_t next = number % named.size();
    if (named[next] >= 0 || clockwise_rad(start, placed.gateways[next]) > turn_rad) {
      break;
    }
  }
  return static_cast<int>(number > named.size() ? number - named.size() : number);
}

void add_gateway(const std::vector<Gateway>& visit, int added, PlacedReading* placed) {
  const int number = number_of_additional(*placed, visit, added);
  placed->reading.star = with_gateway(placed->reading.star, number);
  placed->reading.gateways.insert(placed->reading.gateways.begin() + number, added);
  placed->gateways.insert(placed->gateways.begin() + number,
                          visit[static_cast<std::size_t>(added)]);
}

/// Whether the two stars look the same to a robot that comes in by this gateway of the first one.
bool is_alike(const View& view, int reading, const Reading& other) {
  const std::optional<int> arrival = gateway_in(other, view.arrival_gateway);
  return arrival &&
         are_alike(star_of(view, reading), arrival_gateway_of(view, reading), other.star, *arrival);
}

struct Recalled {
  double log_likelihood_ratio = 0.0;
  Pose2 T_known_visit;
};

/// How the visit's map lies on the known one's, if they are of one place.
std::optional<Recalled> recalled_place(const Experience& experience,
                                       const VisitMatcher& matcher,
                                       VisitId known,
                                       VisitId visit,
                                       const RecallOptions& options) {
  const auto gateways = [&](VisitId id) -> const std::vector<Gateway>& {
    return experience.visits()[id.index()].perceived.neighbourhood.gateways;
  };
  const GaussianPose predicted = matcher.dead_reckoned(known, visit);
  const double reach_rad =
      kReach_sigmas * std::sqrt(predicted.covariance(2, 2) + kGatewaySigma_rad * kGatewaySigma_rad);
  std::optional<Recalled> best;
  for (std::size_t k = 0; k < gateways(known).size(); ++k) {
    for (std::size_t v = 0; v < gateways(visit).size(); ++v) {
      const double turn_rad = turn_between(gateways(visit)[v].outward_bearing_rad,
                                           gateways(known)[k].outward_bearing_rad);
      if (std::abs(turn_between(turn_rad, predicted.mean.theta())) > reach_rad) {
        continue;
      }
      const GatewayPair pair{static_cast<int>(k), static_cast<int>(v)};
      const double ratio = matcher.log_likelihood_ratio(known, visit, pair);
      if (ratio >= options.least_log_likelihood_ratio &&
          (!best || ratio > best->log_likelihood_ratio)) {
        best = {ratio, matcher.compare(known, visit, pair).T_known_visit.mean};
      }
    }
  }
  return best;
}

Reading reading_of(const PlaceNeighbourhood& then,
                   const PlaceVisit& now,
                   const Pose2& T_known_visit,
                   const RecallOptions& options) {
  std::vector<Gateway> here;
  for (const Gateway& gateway : now.neighbourhood.gateways) {
    here.push_back(transformed(T_known_visit, gateway));
  }
  PlacedReading placed{{then.star, seen_gateways(then.gateways, here)}, then.gateways};
  const auto seen = std::count_if(placed.reading.gateways.begin(), placed.reading.gateways.end(),
                                  [](int gateway) { return gateway >= 0; });
  const auto differences =
      static_cast<std::ptrdiff_t>(then.gateways.size() + here.size()) - 2 * seen;
  for (const int used : {now.arrival_gateway, now.departure_gateway}) {
    if (used >= 0 && !is_listed(placed.reading.gateways, used)) {
      add_gateway(here, used, &placed);
    }
  }
  placed.reading.log_likelihood = -options.log_penalty_difference *
                                  std::max(static_cast<double>(differences), kLeastDifference);
  placed.reading.is_recalled = true;
  return placed.reading;
}

/// The earlier visits that may have been to the place of this one, the likeliest first.
std::vector<VisitId> nearest_visits(const VisitMatcher& matcher, VisitId visit, int most) {
  std::vector<std::pair<double, VisitId>> near;
  for (VisitId known{0}; known < visit; ++known.value) {
    if (matcher.is_within_reach(known, visit)) {
      near.emplace_back(matcher.log_density(known, visit), known);
    }
  }
  std::stable_sort(near.begin(), near.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<VisitId> visits;
  for (std::size_t i = 0; i < near.size() && static_cast<int>(i) < most; ++i) {
    visits.push_back(near[i].second);
  }
  return visits;
}

}  // namespace

Status validate(const RecallOptions& options) {
  return Validator("recall")
      .within("least_log_likelihood_ratio", options.least_log_likelihood_ratio, 0.0, 100.0)
      .within("log_penalty_difference", options.log_penalty_difference, 0.0, 100.0)
      .within("max_visits", options.max_visits, 0, 1000)
      .status();
}

std::vector<Reading> recalled_readings(const Experience& experience,
                                       const VisitMatcher& matcher,
                                       const View& view,
                                       const RecallOptions& options) {
  const PlaceVisit& now = experience.visits()[view.visit.index()].perceived;
  std::vector<std::pair<double, Reading>> found;  // by what speaks for it
  for (const VisitId known : nearest_visits(matcher, view.visit, options.max_visits)) {
    const std::optional<Recalled> recalled =
        recalled_place(experience, matcher, known, view.visit, options);
    if (!recalled) {
      continue;
    }
    Reading reading = reading_of(experience.visits()[known.index()].perceived.neighbourhood, now,
                                 recalled->T_known_visit, options);
    // Where the order of the gateways differs the star cannot be this visit's.
    if (validate(reading, gateway_count(view.star), view.arrival_gateway)) {
      found.emplace_back(recalled->log_likelihood_ratio + reading.log_likelihood,
                         std::move(reading));
    }
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  View all = view;
  std::vector<Reading> recalled;
  for (auto& [support, reading] : found) {
    bool is_known = false;
    for (int own = 0; own < reading_count(all) && !is_known; ++own) {
      is_known = is_alike(all, own, reading);
    }
    if (!is_known && static_cast<std::size_t>(reading_count(all)) < kMostReadings) {
      all.others.push_back(reading);
      recalled.push_back(std::move(reading));
    }
  }
  return recalled;
}

}  // namespace cairn
