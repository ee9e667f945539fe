#include "clients/sim/laser.hpp"

#include <limits>
#include <numbers>

namespace cairn::sim {
namespace {

constexpr std::uint64_t kLaserStream = 1;

}  // namespace

Laser::Laser(const LaserOptions& options, std::uint64_t seed)
    : options_(options), random_(seed, kLaserStream) {}

double Laser::bearing_step_rad() const {
  const double fov_rad = options_.fov_deg * std::numbers::pi / 180.0;
  const bool is_full_turn = options_.fov_deg >= 360.0;
  return fov_rad / (is_full_turn ? options_.beams : options_.beams - 1);
}

double Laser::first_bearing_rad() const {
  return -0.5 * options_.fov_deg * std::numbers::pi / 180.0;
}

std::vector<float> Laser::sweep(const FloorPlan& plan, const Pose& T_world_laser) {
  std::vector<float> ranges_m;
  ranges_m.reserve(static_cast<std::size_t>(options_.beams));
  const double first_rad = T_world_laser.theta_rad + first_bearing_rad();
  const double step_rad = bearing_step_rad();
  for (int beam = 0; beam < options_.beams; ++beam) {
    const double true_m =
        cast_ray_m(plan, T_world_laser.at, first_rad + beam * step_rad, options_.max_range_m);
    const double read_m = true_m + options_.noise_sigma_m * random_.normal();
    const bool is_lost = random_.uniform() < options_.dropout_share;
    const bool has_return = !is_lost && read_m > 0.0 && read_m <= options_.max_range_m;
    ranges_m.push_back(has_return ? static_cast<float>(read_m)
                                  : std::numeric_limits<float>::infinity());
  }
  return ranges_m;
}

}  // namespace cairn::sim
