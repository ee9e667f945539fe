#pragma once

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

/// Compares a visit with a known one under the alignment in which gateway j of the visit is gateway
/// (j + shift) mod n of the known place: first the gateways are laid on each other, then the maps
/// are matched from there.
///
/// Source: Kuipers et al., ICRA 2004, Sec. III-D: matching views is (a) isomorphic local topologies
/// and (b) matching LPMs, "with alignment given qualitatively by the corresponding gateways"; the
/// pose is L_i of Modayil et al., IROS 2004, Sec. IV-B.
/// @pre both have the same number of gateways, at least one
[[nodiscard]] Recognition recognize(const PlaceVisit& known,
                                    const PlaceVisit& visit,
                                    int shift,
                                    const MapMatchOptions& options);

/// T_known_visit by the gateways alone, laid on each other under that alignment.
/// @pre as of `recognize`
[[nodiscard]] Pose2 aligned_by_gateways(const PlaceVisit& known,
                                        const PlaceVisit& visit,
                                        int shift);

/// The rigid transform T_a_b that takes points b closest to points a, in the sense of least
/// squares. With one pair, or coinciding points, only the position is determined:
/// `fallback_theta_rad` it is.
/// @pre as many points b as a, at least one
[[nodiscard]] Pose2 aligned(const std::vector<Vector2d>& points_a,
                            const std::vector<Vector2d>& points_b,
                            double fallback_theta_rad);

}  // namespace cairn
