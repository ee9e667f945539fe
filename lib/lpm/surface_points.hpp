#pragma once

#include <vector>

#include "lpm/scan_beams.hpp"
#include "lpm/scan_refinement.hpp"
#include "sensing/laser_scan.hpp"

namespace cairn {

/// The returns of a scan in the robot frame, in the order of the beams, thinned to a spacing, each
/// with the direction across its surface where its neighbours tell it.
/// @param max_range_m farther returns are left out
[[nodiscard]] std::vector<SurfacePoint> surface_points_of(const LaserScan& scan,
                                                          double spacing_m,
                                                          double max_range_m);

/// The returns of a scan as they are, thinned to a spacing.
/// @param max_range_m farther returns, as seen from the laser, are left out
/// @param points overwritten; keeps its memory
void surface_points_of(const ScanBeams& beams,
                       double spacing_m,
                       double max_range_m,
                       std::vector<SurfacePoint>* points);

/// At most so many of them, spread evenly over their order.
[[nodiscard]] std::vector<SurfacePoint> some_of(const std::vector<SurfacePoint>& points,
                                                std::size_t most);

}  // namespace cairn
