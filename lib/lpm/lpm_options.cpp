#include "lpm/lpm_options.hpp"

#include <string>

#include "base/validator.hpp"

namespace cairn {

std::string_view to_string(MatcherKind kind) {
  return kind == MatcherKind::kParticles ? "particles" : "correlative";
}

std::optional<MatcherKind> matcher_kind_of(std::string_view name) {
  for (const MatcherKind kind : {MatcherKind::kCorrelative, MatcherKind::kParticles}) {
    if (name == to_string(kind)) {
      return kind;
    }
  }
  return std::nullopt;
}

Status validate(const ParticleOptions& options) {
  return Validator("lpm.particles")
      .within("least_count", options.least_count, 20, 100'000)
      .within("greatest_count", options.greatest_count, 20, 100'000)
      .positive("bin_m", options.bin_m)
      .positive("bin_rad", options.bin_rad)
      .within("kld_error", options.kld_error, 1e-3, 1.0)
      .within("kld_quantile", options.kld_quantile, 0.0, 5.0)
      .within("effective_share", options.effective_share, 0.01, 0.99)
      .within("max_returns", options.max_returns, 10, 10'000)
      .status();
}

Status validate(const LpmOptions& options) {
  for (const Status& part : {validate(options.particles), validate(options.motion.learning),
                             validate(options.motion_watch), validate(options.wall_orientation)}) {
    if (!part.ok()) {
      return part;
    }
  }
  const ScrollingMapOptions& map = options.map;
  const MotionOptions& motion = options.motion;
  const ScanMatchOptions& match = options.match;
  return Validator("lpm")
      .within("map.cell_m", map.cell_m, 0.01, 0.5)
      .within("map.window_m", map.window_m, 4.0, 200.0)
      .require("map.window_m", map.window_m / map.cell_m <= 4096.0, "be at most 4096 cells")
      .positive("map.memory_travel_m", map.memory_travel_m)
      .within("map.hit_log_odds", map.hit_log_odds, 0.41, 3.0)
      .within("map.miss_log_odds", map.miss_log_odds, 0.41, 3.0)
      .within("map.max_log_odds", map.max_log_odds, 1.0, 20.0)
      .positive("map.max_free_range_m", map.max_free_range_m)
      .within("motion.widening", motion.widening, 1.0, 100.0)
      .within("motion.least_sigma_m", motion.least_sigma_m, 1e-5, 1.0)
      .within("motion.least_sigma_rad", motion.least_sigma_rad, 1e-5, 1.0)
      .within("match.point_spacing_m", match.point_spacing_m, 0.0, 10.0)
      .positive("match.max_match_range_m", match.max_match_range_m)
      .within("match.hit_sigma_m", match.hit_sigma_m, 0.001, 1.0)
      .within("match.independent_share", match.independent_share, 1e-4, 1.0)
      .within("match.min_explained_share", match.min_explained_share, 0.0, 1.0)
      .within("match.min_returns", match.min_returns, 3, 10'000)
      .within("match.search_range_m", match.search_range_m, 0.0, 5.0)
      .within("match.search_turn_rad", match.search_turn_rad, 0.0, 3.2)
      .within("insert_every_m", options.insert_every_m, 0.0, 5.0)
      .within("insert_every_rad", options.insert_every_rad, 0.0, 3.2)
      .within("renewal_travel_m", options.renewal_travel_m, 0.01, 1000.0)
      .within("refusals_before_restart", options.refusals_before_restart, 1, 1000)
      .status();
}

}  // namespace cairn
