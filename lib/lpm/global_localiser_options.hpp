#pragma once

#include "base/result.hpp"

namespace cairn {

/// When a pose in a known map is accepted, and when it is given up. In the configuration file: the
/// object "lpm.global_localiser".
struct GlobalLocaliserOptions {
  double key_scan_every_m = 0.5;    ///< Travel between scans that are searched for, > 0
  double key_scan_every_rad = 0.8;  ///< or turning. > 0
  int candidates = 12;              ///< Poses that each search puts forward. [2, 100]
  int key_scans = 10;               ///< A candidate must explain so many, [2, 100]
  double accept_travel_m = 3.0;     ///< over so much travel, >= 0
  double accept_score = 0.86;       ///< with a mean score of this, [0, 1]
  double accept_margin = 0.05;      ///< and so much better than any other. [0, 1]
  int confirm_key_scans = 3;        ///< All that at so many key scans in a row. [1, 100]
  double drop_margin = 0.15;        ///< Candidates so much worse than the best go. [0, 1]
  double follow_range_m = 0.6;      ///< Half the widest window to follow a candidate in. > 0
  double follow_turn_rad = 0.3;     ///< Half the widest window to follow a candidate in. > 0
  double doubt_drop = 0.08;         ///< A fall of the mean score by this casts doubt. [0, 1]
  double lost_drop = 0.25;          ///< A fall by this ends a localisation. [0, 1]
};

/// Names every field that is out of range, with its value.
[[nodiscard]] Status validate(const GlobalLocaliserOptions& options);

}  // namespace cairn
