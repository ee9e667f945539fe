#include "place/recognition.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/check.hpp"

namespace cairn {
namespace {

/// Gateways are read farther in or out along their way, and turned a little.
constexpr double kSameDirection_rad = 0.7;
constexpr double kSameSpot_m = 3.0;

/// Mean turn that takes the visit's outward directions to the known ones.
double mean_turn(const std::vector<Gateway>& known,
                 const std::vector<Gateway>& visit,
                 const std::vector<GatewayPair>& pairs) {
  double sine = 0.0;
  double cosine = 0.0;
  for (const GatewayPair& pair : pairs) {
    const double turn =
        turn_between(visit[static_cast<std::size_t>(pair.visit)].outward_bearing_rad,
                     known[static_cast<std::size_t>(pair.known)].outward_bearing_rad);
    sine += std::sin(turn);
    cosine += std::cos(turn);
  }
  return std::atan2(sine, cosine);
}

/// The gateways' lines laid on each other: their middles, and a point a little outward of each, so
/// that the directions count too.
Pose2 laid_on(const std::vector<Gateway>& known,
              const std::vector<Gateway>& visit,
              const std::vector<GatewayPair>& pairs) {
  static constexpr double kOutward_m = 2.0;
  std::vector<Vector2d> points_known;
  std::vector<Vector2d> points_visit;
  const auto add = [](const Gateway& gateway, std::vector<Vector2d>& points) {
    points.push_back(gateway.middle);
    points.push_back(gateway.middle + kOutward_m * gateway.outward());
  };
  for (const GatewayPair& pair : pairs) {
    add(known[static_cast<std::size_t>(pair.known)], points_known);
    add(visit[static_cast<std::size_t>(pair.visit)], points_visit);
  }
  return aligned(points_known, points_visit, mean_turn(known, visit, pairs));
}

/// The others follow the pair clockwise.
std::vector<GatewayPair> paired_in_order(int count, GatewayPair pair) {
  std::vector<GatewayPair> pairs;
  for (int gateway = 0; gateway < count; ++gateway) {
    pairs.push_back({(gateway + pair.known - pair.visit + count) % count, gateway});
  }
  return pairs;
}

/// Whether gateways that are said to be the same lead in the same directions, one turn for all.
bool lead_alike(const std::vector<Gateway>& known,
                const std::vector<Gateway>& visit,
                const std::vector<GatewayPair>& pairs) {
  const double turn_rad = mean_turn(known, visit, pairs);
  return std::all_of(pairs.begin(), pairs.end(), [&](const GatewayPair& pair) {
    const double bearing_rad =
        visit[static_cast<std::size_t>(pair.visit)].outward_bearing_rad + turn_rad;
    return std::abs(turn_between(bearing_rad,
                                 known[static_cast<std::size_t>(pair.known)].outward_bearing_rad)) <
           kSameDirection_rad;
  });
}

/// Of the known gateways not taken yet that lead in the same direction, the nearest one.
std::optional<std::size_t> nearest_alike(const std::vector<Gateway>& known,
                                         const std::vector<bool>& is_taken,
                                         const Gateway& seen) {
  std::optional<std::size_t> nearest;
  double least_m = kSameSpot_m;
  for (std::size_t k = 0; k < known.size(); ++k) {
    const double away_m = (known[k].middle - seen.middle).norm();
    if (!is_taken[k] && away_m < least_m &&
        std::abs(turn_between(seen.outward_bearing_rad, known[k].outward_bearing_rad)) <
            kSameDirection_rad) {
      least_m = away_m;
      nearest = k;
    }
  }
  return nearest;
}

}  // namespace

Pose2 aligned(const std::vector<Vector2d>& points_a,
              const std::vector<Vector2d>& points_b,
              double fallback_theta_rad) {
  CAIRN_CHECK(!points_a.empty() && points_a.size() == points_b.size());
  Vector2d mean_a = Vector2d::Zero();
  Vector2d mean_b = Vector2d::Zero();
  for (std::size_t i = 0; i < points_a.size(); ++i) {
    mean_a += points_a[i];
    mean_b += points_b[i];
  }
  mean_a /= static_cast<double>(points_a.size());
  mean_b /= static_cast<double>(points_b.size());
  double dot = 0.0;
  double cross = 0.0;
  for (std::size_t i = 0; i < points_a.size(); ++i) {
    const Vector2d a = points_a[i] - mean_a;
    const Vector2d b = points_b[i] - mean_b;
    dot += b.dot(a);
    cross += b.x() * a.y() - b.y() * a.x();
  }
  const double theta = std::hypot(dot, cross) > 1e-9 ? std::atan2(cross, dot) : fallback_theta_rad;
  const Vector2d rotated = Pose2(0.0, 0.0, theta) * mean_b;
  return {Vector2d(mean_a - rotated), theta};
}

std::vector<GatewayPair> paired_gateways(const std::vector<Gateway>& known,
                                         const std::vector<Gateway>& visit,
                                         GatewayPair pair) {
  if (known.size() == visit.size()) {
    const std::vector<GatewayPair> all = paired_in_order(static_cast<int>(known.size()), pair);
    if (lead_alike(known, visit, all)) {
      return all;
    }
  }
  const Pose2 T_known_visit = laid_on(known, visit, {pair});
  std::vector<GatewayPair> pairs;
  std::vector<bool> is_taken(known.size(), false);
  is_taken[static_cast<std::size_t>(pair.known)] = true;
  for (int v = 0; v < static_cast<int>(visit.size()); ++v) {
    if (v == pair.visit) {
      pairs.push_back(pair);
      continue;
    }
    const Gateway seen = transformed(T_known_visit, visit[static_cast<std::size_t>(v)]);
    const std::optional<std::size_t> same = nearest_alike(known, is_taken, seen);
    if (same) {
      is_taken[*same] = true;
      pairs.push_back({static_cast<int>(*same), v});
    }
  }
  return pairs;
}

Pose2 aligned_by_gateways(const PlaceVisit& known,
                          const PlaceVisit& visit,
                          const std::vector<GatewayPair>& pairs) {
  CAIRN_CHECK(!pairs.empty());
  return laid_on(known.neighbourhood.gateways, visit.neighbourhood.gateways, pairs);
}

Recognition recognize(const MatchableMap& known,
                      const MatchableMap& visit,
                      const Pose2& T_known_visit_by_gateways,
                      const MapMatchOptions& options) {
  if (known.geometry().cell_m != visit.geometry().cell_m) {
    // Taken with other settings: the maps cannot be laid on each other, the gateways can.
    const Matrix3d covariance = Eigen::Vector3d(0.25, 0.25, 0.04).asDiagonal();
    return {{T_known_visit_by_gateways, covariance}, 0.0};
  }
  const MapMatch match = match_maps(known, visit, T_known_visit_by_gateways, options);
  return {match.T_reference_other, match.log_likelihood_ratio};
}

Recognition recognize(const PlaceVisit& known,
                      const PlaceVisit& visit,
                      const std::vector<GatewayPair>& pairs,
                      const MapMatchOptions& options) {
  return recognize(MatchableMap(known.lpm, options), MatchableMap(visit.lpm, options),
                   aligned_by_gateways(known, visit, pairs), options);
}

}  // namespace cairn
