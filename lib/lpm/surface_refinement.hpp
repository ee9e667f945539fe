#pragma once

#include <vector>

#include "geometry/gaussian_pose.hpp"
#include "lpm/scan_refinement.hpp"
#include "lpm/scrolling_map.hpp"

namespace cairn {

/// Lays points onto the surfaces of the map: the pose that minimizes the robust squares of their
/// distances to the surfaces, and of the deviation from a prior, from a starting pose.
///
/// Every point looks up the wall cell nearest to it and is drawn across the surface in that cell,
/// not along it: Levenberg-Marquardt on point-to-line distances (Censi, "An ICP variant using a
/// point-to-line metric", ICRA 2008), where the distance field spares the search for partners.
/// Geman and McClure's loss lets go of people and new walls, which are in no map.
/// @param points in the robot frame, normals towards the laser
/// @param prior T_lpm_robot; its covariance must be positive definite
[[nodiscard]] Refinement refine_on_surfaces(const ScrollingMap& map,
                                            const std::vector<SurfacePoint>& points,
                                            const GaussianPose& prior,
                                            const Pose2& start,
                                            const RefinementOptions& options);

}  // namespace cairn
