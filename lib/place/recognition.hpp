#pragma once

#include <compare>
#include <vector>

#include "geometry/gaussian_pose.hpp"
#include "lpm/map_matching.hpp"
#include "place/place_detector.hpp"

namespace cairn {

/// What comparing two visits' local perceptual maps says about whether they were to the same place.
struct Recognition {
  GaussianPose T_known_visit;  ///< Place frame of the visit in the place frame of the known one.
  double log_likelihood_ratio =
      0.0;  ///< ln p(both maps | same place) - ln p(both maps | different).
};

/// A gateway of the known place that is one of the visit's, each in the numbers of its own star.
struct GatewayPair {
  int known = 0;
  int visit = 0;
  friend auto operator<=>(const GatewayPair&, const GatewayPair&) = default;
};

/// All gateways that are the same, if one pair is: where both visits saw as many, in the same
/// directions, the others follow clockwise; else those that, with the pair laid on each other, lead
/// in the same direction from about the same spot. In the order of the visit's gateways.
/// @pre the gateways exist
[[nodiscard]] std::vector<GatewayPair> paired_gateways(const std::vector<Gateway>& known,
                                                       const std::vector<Gateway>& visit,
                                                       GatewayPair pair);

/// Compares the local map of a visit with that of a known one whose gateways correspond: the
/// gateways are laid on each other, by aligned_by_gateways(), and the maps are matched from there.
///
/// Source: Kuipers et al., ICRA 2004, Sec. III-D: matching views is (a) isomorphic local topologies
/// and (b) matching LPMs, "with alignment given qualitatively by the corresponding gateways"; the
/// pose is L_i of Modayil et al., IROS 2004, Sec. IV-B.
/// @pre at least one pair, of gateways that exist
[[nodiscard]] Recognition recognize(const MatchableMap& known,
                                    const MatchableMap& visit,
                                    const Pose2& T_known_visit_by_gateways,
                                    const MapMatchOptions& options);

/// The same for visits that are compared once.
[[nodiscard]] Recognition recognize(const PlaceVisit& known,
                                    const PlaceVisit& visit,
                                    const std::vector<GatewayPair>& pairs,
                                    const MapMatchOptions& options);

/// T_known_visit by the gateways alone, laid on each other.
/// @pre as of `recognize`
[[nodiscard]] Pose2 aligned_by_gateways(const PlaceVisit& known,
                                        const PlaceVisit& visit,
                                        const std::vector<GatewayPair>& pairs);

/// The rigid transform T_a_b that takes points b closest to points a, in the sense of least
/// squares. With one pair, or coinciding points, only the position is determined:
/// `fallback_theta_rad` it is.
/// @pre as many points b as a, at least one
[[nodiscard]] Pose2 aligned(const std::vector<Vector2d>& points_a,
                            const std::vector<Vector2d>& points_b,
                            double fallback_theta_rad);

}  // namespace cairn
