#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>
#include <vector>

#include "base/result.hpp"
#include "geometry/gaussian_pose.hpp"
#include "lpm/global_localiser_options.hpp"
#include "lpm/global_search.hpp"
#include "lpm/global_search_run.hpp"
#include "lpm/pose_candidates.hpp"

namespace cairn {

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
/// A single scan may fit in many places: corridors repeat themselves. So each search of the whole
/// map puts its best poses forward as candidates, and each candidate has to explain the same key
/// scans, those before it as well as those after it, as the motion between them places them, give
/// or take a little drift. One is accepted only when it has explained scans over some travel,
/// clearly better than any other.
///
/// A search may be spread over many scans; the next one is begun with the newest key scan when it
/// is through. A rival of the accepted pose comes as close to it as the margin on the mean of the
/// key scans, so that it is found with one of them, and from then on it is a candidate too.
///
/// When later the scans fit worse than they used to, for a while, the whole map is searched again;
/// the pose is given up when another explains the scans of late better, or when they do not fit at
/// all.
class GlobalLocaliser {
 public:
  /// @param search must outlive this object
  /// @pre validate(options).ok()
  explicit GlobalLocaliser(const GlobalSearch& search, const GlobalLocaliserOptions& options = {});

  /// Takes the next scan. Candidates are looked for while the robot is not localised.
  /// @param points of the scan, in the robot frame, in the order of the beams
  /// @param step motion since the last scan, by odometry or scan matching; the first is not used
  /// @param lookups so many cells are looked up, and the rest is done with the scans to come, while
  ///        the robot is looked for; what is done once it is localised is not in slices
  GlobalFix absorb(const std::vector<SurfacePoint>& points,
                   const GaussianPose& step,
                   std::int64_t lookups = std::numeric_limits<std::int64_t>::max());

  /// How often the whole map was searched.
  [[nodiscard]] int searches() const { return searches_; }

 private:
  /// A search of the whole map for one key scan.
  struct Search {
    GlobalSearchRun run;
    GaussianPose T_then_now;  // the newest key scan as seen from this one
  };

  /// Key scans in a row with which a candidate was acceptable.
  struct Confirmed {
    std::int64_t candidate = -1;
    std::int64_t key_scan = -1;  // the last of them
    int times = 0;
  };

  [[nodiscard]] bool is_key_scan() const;
  void add_key_scan(const std::vector<SurfacePoint>& points);
  GlobalFix search(std::int64_t lookups);
  std::int64_t search_on(std::int64_t lookups);
  [[nodiscard]] bool is_begun_with_newest() const;
  void begin_search();
  [[nodiscard]] bool is_acceptable() const;
  [[nodiscard]] bool is_confirmed();
  [[nodiscard]] GlobalFix accepted();
  GlobalFix track();
  [[nodiscard]] bool is_still_there();
  /// Whether another pose explains as many key scans of late better than by this mean score.
  [[nodiscard]] bool has_better(std::size_t late, double score);
  [[nodiscard]] GlobalFix summary(Localisation state) const;

  const GlobalSearch& search_;
  GlobalLocaliserOptions options_;
  PoseCandidates candidates_;
  std::optional<Search> running_;
  std::int64_t begun_ = -1;  // the key scan of the last search that was begun
  int searches_since_start_ = 0;
  GaussianPose T_key_robot_;  // in the frame of the last key scan
  double travel_m_ = 0.0;
  double margin_ = 0.0;  // as of the last ranking
  Confirmed confirmed_;
  bool is_rank_due_ = false;   // since candidates or key scans have come
  bool is_localised_ = false;  // at the best candidate
  double usual_score_ = 0.0;   // where localised
  int searches_ = 0;
};

}  // namespace cairn
