#include "clients/sim/odometer.hpp"

#include <cmath>

namespace cairn::sim {
namespace {

constexpr std::uint64_t kOdometerStream = 2;

}  // namespace

Odometer::Odometer(const OdometerOptions& options, std::uint64_t seed)
    : options_(options), random_(seed, kOdometerStream) {}

void Odometer::add(const Motion& true_motion) {
  const double root_distance = std::sqrt(std::abs(true_motion.distance_m));
  const double root_turn = std::sqrt(std::abs(true_motion.turn_rad));
  Motion measured;
  measured.distance_m = true_motion.distance_m * (1.0 + options_.scale_error) +
                        options_.distance_noise_m_per_sqrt_m * root_distance * random_.normal();
  measured.turn_rad = true_motion.turn_rad * (1.0 + options_.turn_scale_error) +
                      options_.turn_bias_rad_per_m * true_motion.distance_m +
                      options_.heading_noise_rad_per_sqrt_m * root_distance * random_.normal() +
                      options_.heading_noise_rad_per_sqrt_rad * root_turn * random_.normal();
  pose_ = moved(pose_, measured);
}

}  // namespace cairn::sim
