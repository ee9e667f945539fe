#include "codec/service_options.hpp"

#include "codec/lpm_description.hpp"

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

OptionObject describe(LocalisationOptions* localisation) {
  OptionObject object("localisation",
                      "When the pose in the local map is relied on, and when the robot is lost.");
  object
      .number("error_min_m", &localisation->error_min_m, {0.01, 0.9},
              "e_min: with less accumulated error a lost robot is found.")
      .number("error_max_m", &localisation->error_max_m, {0.3, 100},
              "e_max: with more the robot is lost. Greater than error_min_m.")
      .integer("patience_scans", &localisation->patience_scans, {1, 1000},
               "Refused scans in a row that are worth a word.")
      .integer("calm_scans", &localisation->calm_scans, {1, 1000},
               "Good scans in a row that end what was said.")
      .integer("found_scans", &localisation->found_scans, {1, 1000},
               "Matched scans in a row that a lost robot needs.")
      .integer("new_map_scans", &localisation->new_map_scans, {1, 100000},
               "Refused scans in a row after which a lost robot starts a new local map.")
      .number(
          "doubt_drop", &localisation->doubt_drop, {0.01, 1},
          "Matches are doubted when after a bump, a lift or a refused scan their score is so much "
          "less than usual.")
      .number("silence_s", &localisation->silence_s, {0.1, 3600},
              "A sensor that says nothing for longer, and longer than usual, has fallen out.")
      .number("unknown_way_m", &localisation->unknown_way_m, {4, 1000},
              "Sigma of the way from the old local map to a new one.")
      .number("unknown_turn_rad", &localisation->unknown_turn_rad, {0.1, 10},
              "Sigma of the turn from the old local map to a new one.");
  return object;
}

OptionObject describe(RelocalisationOptions* relocalisation) {
  OptionObject object(
      "relocalisation",
      "Looking for a robot that has lost its local map in all that it has seen. What "
      "comes of it is said, and the hypotheses decide.");
  object.flag("looks", &relocalisation->looks, "If not, the robot only goes on in a new local map.")
      .number("cell_m", &relocalisation->cell_m, {0.05, 1}, "Of the map that is searched.")
      .integer("max_cells", &relocalisation->max_cells, {1000, 2e7},
               "A larger map is not searched: it takes 40 bytes a cell.")
      .number("draw_every_m", &relocalisation->draw_every_m, {0, 10},
              "Travel between scans that are drawn.")
      .integer("lookups_per_scan", &relocalisation->lookups_per_scan, {1e4, 1e9},
               "Work done with each scan, in cells of the map looked up.")
      .integer("max_searches", &relocalisation->max_searches, {1, 100000},
               "Searches of the whole map before it is given up.")
      .number("accept_travel_m", &relocalisation->accept_travel_m, {0, 1000},
              "So much travel must be explained,")
      .number("accept_score", &relocalisation->accept_score, {0, 1}, "with this mean score,")
      .number("accept_margin", &relocalisation->accept_margin, {0, 1},
              "so much better than by any other pose.");
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
      .number("doorway_below_m", &place->doorway_below_m, {0, 20},
              "Narrower openings are doorways, and make no place until driven through.")
      .number("passage_depth_m", &place->passage_depth_m, {0.1, 20},
              "Way seen along walls that makes an opening a gateway.")
      .number("driven_memory_m", &place->driven_memory_m, {0.1, 1000},
              "Travel for which it is remembered where the robot has gone through.")
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

OptionObject describe(RecallOptions* recall) {
  OptionObject object("recall", "Stars of earlier visits as readings of one that looks different.");
  object
      .number("least_log_likelihood_ratio", &recall->least_log_likelihood_ratio, {0, 100},
              "Of the local maps being of one place, for its star to be recalled, in nats.")
      .number("log_penalty_difference", &recall->log_penalty_difference, {0, 100},
              "Of each gateway that only one of both visits saw, in nats.")
      .integer(
          "max_visits", &recall->max_visits, {0, 1000},
          "The earlier visits, the nearest by dead reckoning, that are compared with a new one; "
          "0: none.");
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
      .number("log_penalty_junction", &topology->log_penalty_junction, {0, 10000},
              "Of each junction on the way taken to be passed without notice, in nats.")
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

OptionObject describe(PatchMatchOptions* matching) {
  OptionObject object("matching", "Which scans are laid on what.");
  object
      .number("patch_reach_m", &matching->patch_reach_m, {0, 10},
              "Travel before and after the middle of a patch.")
      .number("patch_every_m", &matching->patch_every_m, {0.1, 10},
              "Travel between the middles of patches.")
      .number("apart_m", &matching->apart_m, {0, 1e6},
              "Travel between patch and scan, so that they are independent.")
      .number("near_m", &matching->near_m, {0.1, 10}, "A scan is laid on patches no farther away.")
      .integer("passes", &matching->passes, {1, 20},
               "It is laid on patches of so many passages, the nearest.")
      .number("min_score", &matching->min_score, {0, 1},
              "Share of returns over known cells that must lie on walls.")
      .number("min_known_share", &matching->min_known_share, {0, 1},
              "Share of returns that must lie over known cells.");
  return object;
}

OptionObject describe(TrajectoryRefinementOptions* refinement) {
  OptionObject object("refinement", "Aligning the trajectory with what was seen along it.");
  object
      .flag("enabled", &refinement->enabled,
            "If not, the trajectory is as interpolated between the places.")
      .integer("rounds", &refinement->rounds, {1, 10}, "What lies near what is looked up so often.")
      .number("tolerance", &refinement->tolerance, {0.001, 1000},
              "Matches whose squared Mahalanobis distance is so large count a quarter.")
      .object(describe(&refinement->matching));
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
  return {describe(&options->joiner),       describe(&options->lpm),
          describe(&options->localisation), describe(&options->relocalisation),
          describe(&options->place),        describe(&options->recognition),
          describe(&options->recall),       std::move(topology),
          describe(&options->layout),       describe(&options->refinement),
          describe(&options->global_map),   describe(&options->path)};
}

}  // namespace cairn
