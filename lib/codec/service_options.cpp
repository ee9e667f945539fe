#include "codec/service_options.hpp"

namespace cairn {
namespace {

OptionObject describe(JoinerOptions* joiner) {
  OptionObject object("joiner", "How scans and odometry are brought together by their stamps.");
  object
      .number("history_s", &joiner->history_s, {0.1, 600}, "Odometry that is kept, by its stamps.")
      .number("patience_s", &joiner->patience_s, {0, 60}, "How long a scan waits for odometry.")
      .number("clock_step_back_s", &joiner->clock_step_back_s, {0.1, 3600},
              "A longer jump back is a stray stamp, three that agree a new clock.")
      .number("clock_step_ahead_s", &joiner->clock_step_ahead_s, {1, 1e9},
              "A longer jump ahead is a stray stamp, three that agree a new clock.");
  return object;
}

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
              "Clamp, so that what has moved away fades.")
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
      .object(describe(&lpm->particles))
      .number("insert_every_m", &lpm->insert_every_m, {0, 5},
              "The map takes a scan after this travel,")
      .number("insert_every_rad", &lpm->insert_every_rad, {0, 3.2}, "or after this turn.")
      .integer("refusals_before_restart", &lpm->refusals_before_restart, {1, 1000},
               "So many refused matches in a row: the local map starts afresh.");
  return object;
}

OptionObject describe(ContinuationOptions* continuation) {
  OptionObject object("continuation", "When a path goes on through a place.");
  object
      .number("max_turn_rad", &continuation->max_turn_rad, {0.01, 3.1},
              "Largest turn between inbound and outbound heading.")
      .number("rival_margin_rad", &continuation->rival_margin_rad, {0, 3.1},
              "Least extra turn of the next best continuation.");
  return object;
}

OptionObject describe(PlaceOptions* place) {
  OptionObject object("place", "Perception of places: gateways, path fragments, stars, visits.");
  object.number("window_m", &place->window_m, {4, 100}, "Side of the square that is looked at.")
      .number("cell_m", &place->cell_m, {0.01, 1}, "Coarsest cell worked with.")
      .number("robot_width_m", &place->robot_width_m, {0.05, 5}, "Narrower passages are none.")
      .number("coastal_distance_m", &place->coastal_distance_m, {0.05, 20},
              "Alcoves less deep are no branches.")
      .number("speck_m", &place->speck_m, {0, 2},
              "Isolated obstacles up to this extent are ignored.")
      .number("constriction_ahead_m", &place->constriction_ahead_m, {0.1, 20},
              "Stretch of axis compared for a constriction.")
      .number("constriction_tolerance_m", &place->constriction_tolerance_m, {0, 2},
              "Roughness of walls.")
      .number("min_corner_rad", &place->min_corner_rad, {0.01, 3.1},
              "Two gateways less out of line are no place.")
      .number("min_gateway_separation_rad", &place->min_gateway_separation_rad, {0, 3.1},
              "Gateways closer in bearing are one.")
      .number("seen_beyond_m", &place->seen_beyond_m, {0.1, 20},
              "Free passage that makes an opening a gateway.")
      .number("midline_below_m", &place->midline_below_m, {0.1, 100},
              "Wider passages are followed by a wall.")
      .number("min_distinctiveness", &place->min_distinctiveness, {0, 1},
              "Less distinctive spots are no islands of reliability.")
      .number("recompute_after_m", &place->recompute_after_m, {0, 5},
              "Travel between two looks at the map.")
      .number("same_spot_m", &place->same_spot_m, {0.01, 10},
              "Two readings of one place lie less apart.")
      .number("left_beyond_m", &place->left_beyond_m, {0.01, 10},
              "Distance beyond a gateway at which a place is left.")
      .number("crop_margin_m", &place->crop_margin_m, {0, 20},
              "Of the stored local map around the gateways.")
      .object(describe(&place->continuation));
  return object;
}

OptionObject describe(MapMatchOptions* recognition) {
  OptionObject object("recognition", "Comparison of the local maps of two visits.");
  object.number("search_range_m", &recognition->search_range_m, {0, 20}, "Half the search window.")
      .number("search_turn_rad", &recognition->search_turn_rad, {0, 3.2}, "Half the search window.")
      .number("hit_sigma_m", &recognition->hit_sigma_m, {0.001, 1},
              "Spread of a wall of one map around the same wall of the other.")
      .number("min_overlap_share", &recognition->min_overlap_share, {0, 1},
              "Less common ground is no evidence.");
  return object;
}

OptionObject describe(TopologyOptions* topology) {
  OptionObject object("topology", "The tree of topological maps.");
  object.flag("planar", &topology->planar, "No path segment crosses another.")
      .number("log_penalty_handle", &topology->log_penalty_handle, {0, 10000},
              "If not planar, of each link between two faces, in nats.")
      .flag("region_consistent", &topology->region_consistent,
            "Every path must separate a left from a right.")
      .flag("noisy_stars", &topology->noisy_stars,
            "Stars may be misread at the penalties below; if not, what contradicts a view dies.")
      .choice(
          "preference", [topology] { return static_cast<int>(topology->preference); },
          [topology](int value) { topology->preference = static_cast<Preference>(value); },
          {"simplest", "posterior"}, "Which hypothesis is the best one.")
      .integer(
          "max_hypotheses", &topology->max_hypotheses, {1, 1e7},
          "Live hypotheses: the best ones. The others wait and come back when they are better.")
      .number("live_margin", &topology->live_margin, {0, 1e6},
              "By posterior, hypotheses further below the best wait, in nats.")
      .integer("max_bytes", &topology->max_bytes, {65536, 1e12},
               "Memory of the tree; what this makes it give up is said in the status.")
      .integer(
          "max_alike", &topology->max_alike, {1, 1e7},
          "Of those, so many that part from the best one at one visit are preferred to others.")
      .number("log_loss_waiting", &topology->log_loss_waiting, {0, 100},
              "What one that waits is taken to lose per visit, in nats: the last steps are doubted "
              "before old ones.")
      .integer("max_revivals", &topology->max_revivals, {0, 1e7},
               "Steps of waiting hypotheses per arrival.")
      .integer("max_repair_steps", &topology->max_repair_steps, {0, 1e7},
               "Steps of the search for misread stars when nothing explains an arrival.")
      .integer("max_broken_hypotheses", &topology->max_broken_hypotheses, {1, 1e7},
               "How many go on with an arrival that nothing explains.")
      .number("log_prior_new_place", &topology->log_prior_new_place, {-1000, 0},
              "Of each place beyond the first, in nats.")
      .number("log_penalty_misread", &topology->log_penalty_misread, {0, 10000},
              "Of each star taken to be misread, in nats.")
      .number("log_penalty_missed_gateway", &topology->log_penalty_missed_gateway, {0, 10000},
              "Of each gateway taken to be overlooked, in nats.")
      .number("log_penalty_false_gateway", &topology->log_penalty_false_gateway, {0, 10000},
              "Of each gateway taken to be imagined, in nats.")
      .number("log_penalty_unnoticed", &topology->log_penalty_unnoticed, {0, 10000},
              "Of each place taken to be passed without notice, in nats.")
      .number("log_penalty_break", &topology->log_penalty_break, {0, 10000},
              "Of each observation left unexplained, in nats.")
      .number("blame_margin", &topology->blame_margin, {0, 10000},
              "A closure against the star is considered if a new place is not likelier by more.")
      .number("recognition_threshold", &topology->recognition_threshold, {0, 10000},
              "Evidence above it may overrule a link, in nats.")
      .number("max_log_evidence", &topology->max_log_evidence, {0, 1000},
              "Each answer about same places is cut to it, in nats.")
      .integer("max_visits_compared", &topology->max_visits_compared, {1, 1000},
               "The last visits to a place with which a new one is compared.")
      .number("evidence_correlation", &topology->evidence_correlation, {0, 1},
              "Between answers about one place: 0, they add up; 1, many are worth one.")
      .number("layout_margin", &topology->layout_margin, {0, 1e6},
              "Hypotheses further below the best are not laid out, in nats.")
      .number("claim_odds", &topology->claim_odds, {1, 1e12},
              "A place is claimed after waking up once its odds reach this.");
  return object;
}

OptionObject describe(LayoutOptions* layout) {
  OptionObject object("layout", "The layout of places.");
  object.integer("max_iterations", &layout->max_iterations, {1, 10000}, "Of the non-linear solver.")
      .number("outlier_sigmas", &layout->outlier_sigmas, {0, 1000},
              "Travels that disagree by more count less (Huber); 0 is plain least squares.");
  return object;
}

OptionObject describe(GlobalMapOptions* map) {
  OptionObject object("global_map", "The global metrical map in tiles.");
  object.number("cell_m", &map->cell_m, {0.01, 1}, "Side of a cell.")
      .integer("tile_cells", &map->tile_cells, {8, 128}, "Cells along the side of a tile.")
      .number("draw_range_m", &map->draw_range_m, {0.1, 100}, "Beams are drawn up to here.")
      .number("hit_log_odds", &map->hit_log_odds, {0.01, 10}, "A scan ends a beam in the cell.")
      .number("miss_log_odds", &map->miss_log_odds, {0.01, 10}, "A scan sees through the cell.")
      .number("moved_m", &map->moved_m, {0, 1}, "A scan moved by no more stays as it is drawn.")
      .number("turned_rad", &map->turned_rad, {0, 1}, "The same for its heading.")
      .integer("max_tiles", &map->max_tiles, {1, 1e6},
               "What lies beyond this budget is not drawn.");
  return object;
}

OptionObject describe(GridSearchOptions* search) {
  OptionObject object("search", "Ways over the cells of the map.");
  object
      .number("robot_radius_m", &search->robot_radius_m, {0, 10},
              "Cells with less clearance are not traversable.")
      .number("comfort_clearance_m", &search->comfort_clearance_m, {0, 10},
              "Nearer to walls than this, cells cost more.")
      .number("wall_cost", &search->wall_cost, {0, 14},
              "Added cost per metre at the robot's radius.")
      .flag("unknown_is_traversable", &search->unknown_is_traversable,
            "Whether paths may lead where nothing was seen.");
  return object;
}

OptionObject describe(PathOptions* path) {
  OptionObject object("path", "Metric paths.");
  object.object(describe(&path->search))
      .number("corridor_m", &path->corridor_m, {0.1, 100},
              "A path along a route stays this near to it.")
      .number("waypoint_spacing_m", &path->waypoint_spacing_m, {0.01, 100},
              "Between two waypoints.")
      .number("start_tolerance_m", &path->start_tolerance_m, {0, 10},
              "A robot this near to traversable space may start there.")
      .number("goal_tolerance_m", &path->goal_tolerance_m, {0, 10},
              "A goal in a wall may be moved so far.");
  return object;
}

}  // namespace

std::vector<OptionObject> describe(ServiceOptions* options) {
  OptionObject topology = describe(&options->topology);
  topology.text("evidence", &options->evidence,
                "What speaks for or against a hypothesis: place_match, layout; \"\" is strict.");
  return {describe(&options->joiner),      describe(&options->lpm), describe(&options->place),
          describe(&options->recognition), std::move(topology),     describe(&options->layout),
          describe(&options->global_map),  describe(&options->path)};
}

}  // namespace cairn
