#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "base/result.hpp"
#include "geometry/gaussian_pose.hpp"
#include "lpm/global_search.hpp"

namespace cairn {

/// When a pose in a known map is accepted, and when it is given up. In the configuration file: the
/// object "lpm.global_localiser".
struct GlobalLocaliserOptions {
  double search_every_m = 0.5;    ///< Travel between searches, > 0
  double search_every_rad = 0.8;  ///< or turning. > 0
  int candidates = 10;            ///< Poses that each search puts forward. [2, 100]
  double accept_travel_m = 2.0;   ///< A candidate must hold over so much travel, >= 0
  int accept_searches = 4;        ///< and so many scans, [1, 1000]
  double accept_score = 0.45;     ///< by a mean score of this, [0, 1]
  double accept_margin = 0.05;    ///< and so much ahead of any other candidate. [0, 1]
  double track_range_m = 0.4;     ///< Half the window in which a candidate is followed. > 0
  double track_turn_rad = 0.2;    ///< Half the window in which a candidate is followed. > 0
  double lost_score = 0.3;        ///< A mean score below this ends a localisation, [0, 1]
  int lost_scans = 8;             ///< over so many scans. [1, 1000]
};

/// Names every field that is out of range, with its value.
[[nodiscard]] Status validate(const GlobalLocaliserOptions& options);

/// What is known of the robot's place in a map.
enum class Localisation : std::uint8_t {
  kSearching,  ///< Candidates at best.
  kAccepted,   ///< Localised, by this very scan.
  kTracking,   ///< Localised.
  kLost,       ///< Given up with this very scan: the scans do not fit any more.
};

/// The name of a state, as in "searching".
[[nodiscard]] const char* to_string(Localisation state);

struct GlobalFix {
  Localisation state = Localisation::kSearching;
  std::optional<GaussianPose> T_map_robot;  ///< Where localised.
  double score = 0.0;   ///< Of the best candidate, mean over the scans of late, [0, 1].
  double margin = 0.0;  ///< Ahead of the next candidate, >= 0.
};

/// Localises a robot in a known map from no prior, and notices when it was carried away.
///
/// A single scan may fit in many places. Each search puts its best poses forward as candidates;
/// candidates move along with odometry and are followed within a small window, scan by scan. A
/// candidate is accepted only when it has held over some travel, clearly better than every other.
class GlobalLocaliser {
 public:
  /// @param search must outlive this object
  /// @pre validate(options).ok()
  explicit GlobalLocaliser(const GlobalSearch& search, const GlobalLocaliserOptions& options = {});

  /// @param points of a scan, in the robot frame
  /// @param step motion since the last call by odometry or scan matching; not used the first time
  GlobalFix absorb(const std::vector<Vector2d>& points, const Pose2& step);

 private:
  struct Candidate {
    GaussianPose T_map_robot;
    double score_sum = 0.0;
    int scans = 0;
    double travel_m = 0.0;
    [[nodiscard]] double mean_score() const { return score_sum / std::max(scans, 1); }
  };

  const GlobalSearch& search_;
  GlobalLocaliserOptions options_;
};

}  // namespace cairn
