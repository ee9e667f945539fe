#pragma once

#include <string>

#include "global_map/global_map.hpp"
#include "layout/place_layout.hpp"
#include "lpm/localisation_health.hpp"
#include "lpm/lpm_options.hpp"
#include "lpm/map_match_options.hpp"
#include "place/place_options.hpp"
#include "planning/path.hpp"
#include "refinement/trajectory_refiner.hpp"
#include "sensing/scan_joiner.hpp"
#include "service/recalled_readings.hpp"
#include "service/relocaliser.hpp"
#include "topology/topology_options.hpp"

namespace cairn {

/// Everything that tunes what cairn computes, stage by stage.
struct ServiceOptions {
  JoinerOptions joiner;
  LpmOptions lpm;
  LocalisationOptions localisation;
  RelocalisationOptions relocalisation;
  PlaceOptions place;
  MapMatchOptions recognition;  ///< Comparison of two visits' local maps.
  RecallOptions recall;
  TopologyOptions topology;
  /// What else than stars and links speaks for or against a hypothesis: names of evidence_named(),
  /// separated by blanks; none is the papers' strict tree.
  std::string evidence = "place_match layout";
  LayoutOptions layout;
  TrajectoryRefinementOptions refinement;
  GlobalMapOptions global_map;
  PathOptions path;

  ServiceOptions() {
    // Stars read from noisy maps need the posterior; see docs/decisions/0005-order-by-posterior.md.
    topology.noisy_stars = true;
    topology.preference = Preference::kPosterior;
    topology.log_prior_new_place = -3.0;
    // Of recorded visits to one place not a third have equal stars, even where many are recalled.
    topology.log_penalty_misread = 3.0;
    topology.log_penalty_missed_gateway = 3.0;
    topology.log_penalty_false_gateway = 4.0;
  }
};

/// Names every field of every stage that is out of range, with its value.
[[nodiscard]] Status validate(const ServiceOptions& options);

}  // namespace cairn
