#pragma once

#include <cstdint>
#include <vector>

#include "clients/sim/floor_plan.hpp"
#include "clients/sim/random_source.hpp"

namespace cairn::sim {

struct LaserOptions {
  int beams = 360;         ///< [2, 10000]
  double fov_deg = 270.0;  ///< From first to last beam; 360: the last is one step short of it.
  double max_range_m = 12.0;
  double noise_sigma_m = 0.01;
  double dropout_share = 0.005;  ///< Of beams that hit something but bring no return.
};

/// A planar laser at the robot's centre, facing ahead.
class Laser {
 public:
  Laser(const LaserOptions& options, std::uint64_t seed);

  [[nodiscard]] double first_bearing_rad() const;
  [[nodiscard]] double bearing_step_rad() const;
  [[nodiscard]] double max_range_m() const { return options_.max_range_m; }

  /// Ranges of one sweep in metres, counterclockwise; infinity: no return. All of one instant.
  [[nodiscard]] std::vector<float> sweep(const FloorPlan& plan, const Pose& T_world_laser);

 private:
  LaserOptions options_;
  RandomSource random_;
};

}  // namespace cairn::sim
