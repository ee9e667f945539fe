#include "codec/lpm_description.hpp"

#include <utility>

namespace cairn {
namespace {

OptionObject describe(ScrollingMapOptions* map) {
  OptionObject object("map", "The scrolling occupancy grid around the robot.");
  object.number("cell_m", &map->cell_m, {0.01, 0.5}, "Side of a cell.")
      .number("window_m", &map->window_m, {4, 200}, "Side of the square window.")
      .number("memory_travel_m", &map->memory_travel_m, {1, 10000},
              "What was not seen for this travel is forgotten, so that no large loop closes here.")
      .number("hit_log_odds", &map->hit_log_odds, {0.41, 3}, "Added to the cell a beam ends in.")
      .number("miss_log_odds", &map->miss_log_odds, {0.41, 3},
              "Taken from a cell a beam passes through.")
      .number("max_log_odds", &map->max_log_odds, {1, 20},
              "Clamp: a wall is gone after (this - 0.4) / miss_log_odds scans through it.")
      .number("max_free_range_m", &map->max_free_range_m, {0.1, 200},
              "A beam without return frees no more than this.");
  return object;
}

OptionObject describe(MotionLearningOptions* learning) {
  OptionObject object("learning", "How odometry is calibrated, and its noise learned, by matches.");
  OdometryNoise* const first = &learning->first;
  OptionObject noise("first", "Variances of odometry believed beforehand.");
  noise.number("drive_m2_per_m", &first->drive_m2_per_m, {1e-9, 10}, "Ahead, by driving.")
      .number("slide_m2_per_m", &first->slide_m2_per_m, {1e-9, 10}, "Sideways, by driving.")
      .number("turn_rad2_per_rad", &first->turn_rad2_per_rad, {1e-9, 10}, "Heading, by turning.")
      .number("turn_rad2_per_m", &first->turn_rad2_per_m, {1e-9, 10}, "Heading, by driving.")
      .number("rest_m2_per_step", &first->rest_m2_per_step, {1e-9, 10}, "Per scan, even at rest.")
      .number("rest_rad2_per_step", &first->rest_rad2_per_step, {1e-9, 10},
              "Per scan, even at rest.");
  object.object(std::move(noise))
      .number("least_share", &learning->least_share, {1e-6, 1}, "Floor of each, of the first.")
      .number("greatest_share", &learning->greatest_share, {1, 10000},
              "Ceiling of each, of the first.")
      .number("lesson_m", &learning->lesson_m, {0.001, 100},
              "Travel after which odometry and matches are compared,")
      .number("lesson_rad", &learning->lesson_rad, {0.001, 100}, "or turn,")
      .integer("lesson_steps", &learning->lesson_steps, {1, 1000}, "or scans.")
      .number("noise_memory_lessons", &learning->noise_memory_lessons, {2, 1e5},
              "Older lessons on noise have faded.")
      .number("calibration_memory_lessons", &learning->calibration_memory_lessons, {2, 1e6},
              "Older lessons on calibration have faded.")
      .number("drive_scale_sigma", &learning->drive_scale_sigma, {1e-4, 1}, "Of 1, beforehand.")
      .number("turn_scale_sigma", &learning->turn_scale_sigma, {1e-4, 1}, "Of 1, beforehand.")
      .number("turn_sigma_rad_per_m", &learning->turn_sigma_rad_per_m, {1e-4, 1},
              "Of unlike wheels, beforehand.")
      .number("slide_sigma_m_per_m", &learning->slide_sigma_m_per_m, {1e-4, 1},
              "Of a laser mounted askew, beforehand.")
      .number("lever_sigma_m", &learning->lever_sigma_m, {1e-4, 1},
              "Of the laser's place, beforehand.")
      .number("bound_sigmas", &learning->bound_sigmas, {1, 10},
              "Calibration never leaves this many of its sigmas.");
  return object;
}

OptionObject describe(MotionOptions* motion) {
  OptionObject object("motion", "How motion is foretold, to start matching from.");
  object.object(describe(&motion->learning))
      .flag("learns", &motion->learns, "Odometry is corrected, and believed as it has earned.")
      .number("widening", &motion->widening, {1, 100}, "Variances count as so much larger,")
      .number("least_sigma_m", &motion->least_sigma_m, {1e-5, 1}, "and this is added,")
      .number("least_sigma_rad", &motion->least_sigma_rad, {1e-5, 1}, "and this.");
  return object;
}

OptionObject describe(MotionWatchOptions* watch) {
  OptionObject object("motion_watch", "When odometry and scans disagree so much that it is said.");
  object
      .number("max_speed_m_per_s", &watch->max_speed_m_per_s, {0.01, 100},
              "Faster odometry is not believed.")
      .number("max_turn_rate_rad_per_s", &watch->max_turn_rate_rad_per_s, {0.01, 100},
              "Faster odometry is not believed.")
      .integer("window_steps", &watch->window_steps, {1, 100},
               "Scans over which slips and lifts add up.")
      .number("alarm_sigmas", &watch->alarm_sigmas, {3, 100}, "Disagreement that is no noise,")
      .number("least_m", &watch->least_m, {0.001, 10}, "if it is as much as this,")
      .number("least_rad", &watch->least_rad, {0.001, 3.2}, "or this.")
      .number("flip_travel_m", &watch->flip_travel_m, {0.1, 1000},
              "Travel that convicts a reversed laser.")
      .number("flip_turn_rad", &watch->flip_turn_rad, {0.1, 1000},
              "Turning that convicts one upside down.");
  return object;
}

OptionObject describe(ScanMatchOptions* match) {
  OptionObject object("match", "Scan matching against the scrolling map.");
  object
      .number("point_spacing_m", &match->point_spacing_m, {0, 5},
              "Returns closer together than this are thinned.")
      .number("max_match_range_m", &match->max_match_range_m, {0.5, 200},
              "Farther returns are not matched.")
      .number("hit_sigma_m", &match->hit_sigma_m, {0.001, 1}, "Spread of a return around the wall.")
      .number("independent_share", &match->independent_share, {0.001, 1},
              "Share of the returns that count as independent.")
      .number("min_explained_share", &match->min_explained_share, {0, 1},
              "Of the returns over known cells; below it a match is refused.")
      .integer("min_returns", &match->min_returns, {3, 10000},
               "Fewer returns: the sensor is blocked.")
      .number("search_range_m", &match->search_range_m, {0, 5}, "Half the wide search's window.")
      .number("search_turn_rad", &match->search_turn_rad, {0, 3.2},
              "Half the wide search's window.");
  return object;
}

OptionObject describe(WallOrientationOptions* walls) {
  OptionObject object("wall_orientation", "What the directions of walls say about the heading.");
  object.flag("enabled", &walls->enabled,
              "Dead reckoning is corrected by it, where the heading shows to drift.");
  return object;
}

OptionObject describe(ParticleOptions* particles) {
  OptionObject object("particles", "The particle filter, where `matcher` is \"particles\".");
  object
      .integer("least_count", &particles->least_count, {20, 100000}, "As many particles at least,")
      .integer("greatest_count", &particles->greatest_count, {20, 100000}, "and at most.")
      .number("bin_m", &particles->bin_m, {0.001, 10}, "Particles closer than this count as alike")
      .number("bin_rad", &particles->bin_rad, {0.001, 3.2}, "and this.")
      .number("kld_error", &particles->kld_error, {0.001, 1}, "Of the sampled belief.")
      .number("kld_quantile", &particles->kld_quantile, {0, 5},
              "Of the normal distribution: 2.33 for 99 %.")
      .number("effective_share", &particles->effective_share, {0.01, 0.99},
              "Of particles that a tempering step must leave.")
      .integer("max_returns", &particles->max_returns, {10, 10000}, "Returns weighed per particle.")
      .integer("seed", &particles->seed, {0, 1e15}, "Same seed, same scans: same poses.");
  return object;
}

}  // namespace

OptionObject describe(LpmOptions* lpm) {
  OptionObject object("lpm", "The local metrical layer (local perceptual map).");
  object.object(describe(&lpm->map))
      .object(describe(&lpm->motion))
      .object(describe(&lpm->motion_watch))
      .object(describe(&lpm->match))
      .choice(
          "matcher", [lpm] { return static_cast<int>(lpm->matcher); },
          [lpm](int value) { lpm->matcher = static_cast<MatcherKind>(value); },
          {"correlative", "particles"}, "How scans are matched with the local map.")
      .object(describe(&lpm->wall_orientation))
      .object(describe(&lpm->particles))
      .number("insert_every_m", &lpm->insert_every_m, {0, 5},
              "The map takes a scan after this travel,")
      .number("insert_every_rad", &lpm->insert_every_rad, {0, 3.2}, "or after this turn.")
      .integer("refusals_before_restart", &lpm->refusals_before_restart, {1, 1000},
               "So many refused matches in a row: the local map is drawn anew around the robot, or "
               "starts afresh where the way is not known, either.");
  return object;
}

}  // namespace cairn
