#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string_view>
#include <vector>

#include "base/result.hpp"
#include "geometry/gaussian_pose.hpp"
#include "lpm/global_search.hpp"

namespace cairn {

/// When a pose in a known map is accepted, and when it is given up. In the configuration file: the
/// object "lpm.global_localiser".
struct GlobalLocaliserOptions {
  double key_scan_every_m = 0.5;    ///< Travel between scans that are searched for, > 0
  double key_scan_every_rad = 0.8;  ///< or turning. > 0
  int candidates = 12;              ///< Poses that each search puts forward. [2, 100]
  int key_scans = 10;               ///< A candidate must explain so many, [2, 100]
  double accept_travel_m = 3.0;     ///< over so much travel, >= 0
  double accept_score = 0.82;       ///< with a mean score of this, [0, 1]
  double accept_margin = 0.03;      ///< and so much better than any other. [0, 1]
  double drop_margin = 0.15;        ///< Candidates so much worse than the best go. [0, 1]
  double follow_range_m = 0.6;      ///< Half the widest window to follow a candidate in. > 0
  double follow_turn_rad = 0.3;     ///< Half the widest window to follow a candidate in. > 0
  double doubt_drop = 0.08;         ///< A fall of the mean score by this casts doubt. [0, 1]
  double lost_drop = 0.25;          ///< A fall by this ends a localisation. [0, 1]
};

/// Names every field that is out of range, with its value.
[[nodiscard]] Status validate(const GlobalLocaliserOptions& options);

/// What is known of the robot's place in a map.
enum class Localisation : std::uint8_t {
  kSearching,  ///< Candidates at best.
  kAccepted,   ///< Localised, from this very scan on.
  kTracking,   ///< Localised.
  kLost,       ///< Given up with this very scan: the map does not explain the scans any more.
};

/// The name of a state, as in "searching".
[[nodiscard]] std::string_view to_string(Localisation state);

/// What a scan has brought.
struct GlobalFix {
  Localisation state = Localisation::kSearching;
  std::optional<GaussianPose> T_map_robot;  ///< Where localised.
  double score = 0.0;   ///< Mean of the best candidate over the key scans, [0, 1].
  double margin = 0.0;  ///< How much better than the next candidate, >= 0. As of the last search.
};

/// Localises a robot in a known map from no prior, and notices when it was carried away.
///
/// A single scan may fit in many places: corridors repeat themselves. So each search puts its best
/// poses forward as candidates, and each candidate has to explain the same key scans, those before
/// it as well as those after it, as the motion between them places them, give or take a little
/// drift. One is accepted only when it has explained scans over some travel, clearly better than
/// any other.
///
/// When later the scans fit worse than they used to, for a while, the whole map is searched again;
/// the pose is given up when another explains the scans of late better, or when they do not fit at
/// all.
class GlobalLocaliser {
 public:
  /// @param search must outlive this object
  /// @pre validate(options).ok()
  explicit GlobalLocaliser(const GlobalSearch& search, const GlobalLocaliserOptions& options = {});

  /// Takes the next scan. Searches the whole map only at key scans, while not localised or in
  /// doubt.
  /// @param points of the scan, in the robot frame, in the order of the beams
  /// @param step motion since the last scan, by odometry or scan matching; the first is not used
  GlobalFix absorb(const std::vector<SurfacePoint>& points, const GaussianPose& step);

  /// How often the whole map was searched.
  [[nodiscard]] int searches() const { return searches_; }

 private:
  struct KeyScan {
    std::vector<SurfacePoint> points;
    GaussianPose T_before_this;  // from the key scan before
    double travel_m = 0.0;
  };
  /// A trajectory through the map.
  struct Candidate {
    GaussianPose T_map_robot;   // at the last key scan
    std::deque<double> scores;  // one for each key scan
    [[nodiscard]] double mean_score() const;
  };

  [[nodiscard]] bool is_key_scan() const;
  void add_key_scan(const std::vector<SurfacePoint>& points);
  [[nodiscard]] GlobalMatch followed(const std::vector<SurfacePoint>& points,
                                     const GaussianPose& T_map_robot) const;
  void follow_candidates();
  void put_forward();
  [[nodiscard]] Candidate looked_back(const GlobalMatch& match, std::size_t scans) const;
  /// Whether another pose explains as many key scans of late better than by this mean score.
  [[nodiscard]] bool has_better(std::size_t late, double score);
  void rank();
  [[nodiscard]] bool is_acceptable() const;
  [[nodiscard]] double margin() const;
  GlobalFix search();
  GlobalFix track();
  [[nodiscard]] bool is_still_there();
  [[nodiscard]] GlobalFix summary(Localisation state) const;

  const GlobalSearch& search_;
  GlobalLocaliserOptions options_;
  std::deque<KeyScan> key_scans_;      // oldest first
  std::vector<Candidate> candidates_;  // best first
  GaussianPose T_key_robot_;           // in the frame of the last key scan
  double travel_m_ = 0.0;
  double margin_ = 0.0;        // as of the last search
  bool is_localised_ = false;  // at the best candidate
  double usual_score_ = 0.0;   // where localised
  int searches_ = 0;
};

}  // namespace cairn
