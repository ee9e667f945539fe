#include "service/visit_matcher.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>
#include <optional>

namespace cairn {
namespace {

/// Where the robot is said to be at a place, it is within this of its centre.
constexpr double kLeastWide_m = 1.0;
constexpr double kAnyHeading_rad = 10.0;
constexpr std::size_t kMostReckoned = 64;

template <class Ways>
std::vector<TravelConstraint> constraints_of(const Ways& ways) {
  std::vector<TravelConstraint> constraints;
  std::transform(ways.begin(), ways.end(), std::back_inserter(constraints),
                 [](const auto& way) { return way.constraint; });
  return constraints;
}

}  // namespace

std::vector<GatewayPair> VisitMatcher::pairs(VisitId known, VisitId visit, GatewayPair pair) const {
  const std::vector<Visit>& visits = experience_.visits();
  const auto gateways = [&](VisitId id) -> const std::vector<Gateway>& {
    return visits[id.index()].perceived.neighbourhood.gateways;
  };
  return paired_gateways(gateways(known), gateways(visit), pair);
}

const Recognition& VisitMatcher::compare(VisitId known, VisitId visit, GatewayPair pair) const {
  const std::vector<GatewayPair> all = pairs(known, visit, pair);
  const auto key = std::make_tuple(known, visit, all.front());  // Of all pairs that mean the same.
  const auto found = compared_.find(key);
  if (found != compared_.end()) {
    return found->second;
  }
  const std::vector<Visit>& visits = experience_.visits();
  const Pose2 T_known_visit =
      aligned_by_gateways(visits[known.index()].perceived, visits[visit.index()].perceived, all);
  return compared_.emplace(key, recognize(map_of(known), map_of(visit), T_known_visit, options_))
      .first->second;
}

const MatchableMap& VisitMatcher::map_of(VisitId visit) const {
  const auto found = ready_.find(visit);
  if (found != ready_.end()) {
    found->second.used = ++uses_;
    return found->second.map;
  }
  // The last one stays: it is about to be compared with this one.
  while (bytes_ready_ > kMaxBytesReady && ready_.size() > 1) {
    const auto oldest = std::min_element(
        ready_.begin(), ready_.end(),
        [](const auto& a, const auto& b) { return a.second.used < b.second.used; });
    bytes_ready_ -= oldest->second.map.memory_bytes();
    ready_.erase(oldest);
  }
  const OccupancyGrid& lpm = experience_.visits()[visit.index()].perceived.lpm;
  const MatchableMap& map =
      ready_.emplace(visit, ReadyMap{MatchableMap(lpm, options_), ++uses_}).first->second.map;
  bytes_ready_ += map.memory_bytes();
  return map;
}

GaussianPose VisitMatcher::dead_reckoned(VisitId known, VisitId visit) const {
  const auto found = dead_reckoned_.find(visit);
  if (found != dead_reckoned_.end()) {
    return found->second[known.index()];
  }
  std::vector<GaussianPose> T_earlier_visit(visit.index() + 1);
  for (std::size_t earlier = visit.index(); earlier > 0; --earlier) {
    T_earlier_visit[earlier - 1] =
        compounded(experience_.travels()[earlier - 1].T_from_to, T_earlier_visit[earlier]);
  }
  // Mostly it is the last visits that are asked about.
  if (dead_reckoned_.size() == kMostReckoned) {
    dead_reckoned_.erase(dead_reckoned_.begin());
  }
  return dead_reckoned_.emplace(visit, std::move(T_earlier_visit)).first->second[known.index()];
}

VisitMatcher::Spread VisitMatcher::spread_at_place(VisitId known, VisitId visit) const {
  const GaussianPose T_known_visit = dead_reckoned(known, visit);
  const double xx = T_known_visit.covariance(0, 0) + kPlaceReach_m * kPlaceReach_m;
  const double xy = T_known_visit.covariance(0, 1);
  const double yy = T_known_visit.covariance(1, 1) + kPlaceReach_m * kPlaceReach_m;
  const Vector2d away = T_known_visit.mean.translation();
  const double determinant = xx * yy - xy * xy;
  return {(yy * away.x() * away.x() - 2.0 * xy * away.x() * away.y() + xx * away.y() * away.y()) /
              determinant,
          -0.5 * std::log(determinant) - std::log(2.0 * std::numbers::pi)};
}

bool VisitMatcher::is_within_reach(VisitId known, VisitId visit) const {
  return spread_at_place(known, visit).chi2 < kReach_sigmas * kReach_sigmas;
}

double VisitMatcher::log_density(VisitId known, VisitId visit) const {
  const Spread spread = spread_at_place(known, visit);
  return spread.log_highest_density - 0.5 * spread.chi2;
}

double VisitMatcher::log_prior_same(VisitId known, VisitId visit) const {
  return std::clamp(std::log(kPlaceArea_m2) + spread_at_place(known, visit).log_highest_density,
                    kLeastLogPrior, 0.0);
}

double VisitMatcher::log_likelihood_ratio(VisitId known, VisitId visit, GatewayPair pair) const {
  const GaussianPose predicted = dead_reckoned(known, visit);
  const std::vector<Visit>& visits = experience_.visits();
  const Pose2 T_known_visit = aligned_by_gateways(
      visits[known.index()].perceived, visits[visit.index()].perceived, pairs(known, visit, pair));
  // Gateways alone give the pose to about half a metre; that is enough to see what is out of reach.
  const Matrix3d slack = Eigen::Vector3d(0.25, 0.25, 0.04).asDiagonal();
  if (squared_mahalanobis(T_known_visit, predicted.mean, predicted.covariance + slack) >
      kRefutedAt_sigmas * kRefutedAt_sigmas) {
    return -std::numeric_limits<double>::infinity();
  }
  const Recognition& recognition = compare(known, visit, pair);
  const double chi2 =
      squared_mahalanobis(recognition.T_known_visit.mean, predicted.mean,
                          predicted.covariance + recognition.T_known_visit.covariance);
  if (chi2 > kRefutedAt_sigmas * kRefutedAt_sigmas) {
    return -std::numeric_limits<double>::infinity();
  }
  return recognition.log_likelihood_ratio;
}

GaussianPose VisitMatcher::T_place_visit(const TopologicalMap& map, VisitId visit) const {
  const std::optional<GaussianPose> matched = matched_at_place(map, visit);
  return matched ? *matched : dead_reckoned(map.first_visit(map.at_visit(visit).place), visit);
}

std::optional<GaussianPose> VisitMatcher::matched_at_place(const TopologicalMap& map,
                                                           VisitId visit) const {
  const VisitedPlace at = map.at_visit(visit);
  const VisitId first = map.first_visit(at.place);
  if (first == visit) {
    return GaussianPose{};
  }
  // A gateway that both visits saw, the one of arrival if possible.
  const std::vector<Visit>& visits = experience_.visits();
  const int arrival = std::max(visits[visit.index()].perceived.arrival_gateway, 0);
  const auto gateways = [&](VisitId id) {
    return static_cast<int>(visits[id.index()].perceived.neighbourhood.gateways.size());
  };
  for (int turn = 0; turn < gateways(visit); ++turn) {
    const int now = (arrival + turn) % gateways(visit);
    for (int known = 0; known < gateways(first); ++known) {
      const int at_place = map.gateway_at(visit, now);
      if (at_place >= 0 && map.gateway_at(first, known) == at_place) {
        return compare(first, visit, {known, now}).T_known_visit;
      }
    }
  }
  return std::nullopt;
}

double VisitMatcher::chi2_of_unmatched(const TopologicalMap& map) const {
  double chi2 = 0.0;
  for (int v = 0; v < map.visit_count(); ++v) {
    const VisitId visit{v};
    if (map.is_carried(visit) || matched_at_place(map, visit)) {
      continue;
    }
    const VisitId first = map.first_visit(map.at_visit(visit).place);
    const GaussianPose T_first_visit = dead_reckoned(first, visit);
    const double wide_m = std::max(
        kLeastWide_m, experience_.visits()[first.index()].perceived.neighbourhood.radius_m);
    // The heading in which a place is seen says nothing: its frame has that of the local map.
    const Matrix3d spread =
        T_first_visit.covariance + Matrix3d(Eigen::Vector3d(wide_m * wide_m, wide_m * wide_m,
                                                            kAnyHeading_rad * kAnyHeading_rad)
                                                .asDiagonal());
    const Pose2 at_place(0.0, 0.0, T_first_visit.mean.theta());
    chi2 += squared_mahalanobis(T_first_visit.mean, at_place, spread);
  }
  return chi2;
}

std::vector<TravelConstraint> VisitMatcher::constraints(const TopologicalMap& map) const {
  std::vector<Way> all = ways(map);
  std::stable_partition(all.begin(), all.end(), [](const Way& way) { return !way.passes_visit; });
  return constraints_of(all);
}

std::vector<TravelConstraint> VisitMatcher::constraints_by_visit(const TopologicalMap& map) const {
  return constraints_of(ways(map));
}

std::vector<VisitMatcher::Way> VisitMatcher::ways(const TopologicalMap& map) const {
  std::vector<Way> ways;
  // Each visit's pose is asked for by the travel to it and by that from it.
  std::vector<std::optional<GaussianPose>> matched;
  for (int v = 0; v < map.visit_count(); ++v) {
    matched.push_back(matched_at_place(map, VisitId{v}));
  }
  const auto T_place_visit = [&](VisitId visit) -> GaussianPose {
    const std::optional<GaussianPose>& T_place = matched[visit.index()];
    return T_place ? *T_place : dead_reckoned(map.first_visit(map.at_visit(visit).place), visit);
  };
  const auto add = [&](VisitId from, VisitId to, const GaussianPose& T_from_to) {
    ways.push_back(
        {{map.at_visit(from).place.value, map.at_visit(to).place.value,
          compounded(compounded(T_place_visit(from), T_from_to), inverted(T_place_visit(to)))},
         to.value - from.value > 1});
  };
  for (int v = 1; v < map.visit_count(); ++v) {
    const VisitId to{v};
    const VisitId from{v - 1};
    if (map.is_carried(to)) {
      continue;
    }
    const Travel& travel = experience_.travels()[from.index()];
    add(from, to, travel.T_from_to);
    // Where a visit cannot be matched with its place, what holds the places before and after it
    // together is the way between them.
    if (v < 2 || map.is_carried(from) || matched[from.index()]) {
      continue;
    }
    const VisitId before{v - 2};
    if (map.at_visit(before).place != map.at_visit(to).place) {
      add(before, to,
          compounded(experience_.travels()[before.index()].T_from_to, travel.T_from_to));
    }
  }
  return ways;
}

}  // namespace cairn
