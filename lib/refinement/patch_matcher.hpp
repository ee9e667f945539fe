#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <tuple>
#include <vector>

#include "base/result.hpp"
#include "geometry/gaussian_pose.hpp"
#include "lpm/scrolling_map.hpp"
#include "refinement/key_scan.hpp"

namespace cairn {

/// Where one key scan lies, seen from another that passed there at another time.
struct PatchMatch {
  int patch = 0;  ///< Key scan in the middle of the patch.
  int key = 0;    ///< Key scan that was laid on the patch.
  GaussianPose T_patch_key;
};

/// Which key scans are laid on what, and when the result is believed.
struct PatchMatchOptions {
  double patch_reach_m = 1.5;  ///< Travel before and after the middle of a patch. [0, 10]
  double patch_every_m = 1.0;  ///< Travel between the middles of patches. [0.1, 10]
  double apart_m = 15.0;    ///< Travel between patch and scan, so that they are independent. >= 0
  double near_m = 2.0;      ///< A scan is laid on patches no farther away. (0, 10]
  int passes = 3;           ///< It is laid on patches of so many passages, the nearest. [1, 20]
  double min_score = 0.75;  ///< Share of returns over known cells that must lie on walls,
  double min_known_share = 0.5;  ///< and share of returns that lie over known cells. [0, 1]
};

/// Names every field that is out of range, with its value.
[[nodiscard]] Status validate(const PatchMatchOptions& options);

/// Lays key scans on patches, which are small local maps of a few metres of travel, wherever two
/// passages of the robot come near each other.
///
/// A match depends only on the scans, on the local motion between those of the patch, and on where
/// it was begun; that is rounded to a raster. So what was matched once is remembered, and the
/// result is the same as without remembering.
///
/// Source: Modayil et al., IROS 2004, Sec. IV-F (aligning the poses with map estimates).
class PatchMatcher {
 public:
  /// @pre validate(options).ok()
  explicit PatchMatcher(const PatchMatchOptions& options = {});

  /// @param T_global_key where the key scans are thought to lie; as many
  [[nodiscard]] std::vector<PatchMatch> match(const KeyScans& keys,
                                              const std::vector<Pose2>& T_global_key);
  /// What was not asked for since the last time is forgotten.
  void forget_unused();

  /// How often a scan was laid on a patch in all: what was remembered does not count.
  [[nodiscard]] std::int64_t matches_made() const { return matches_made_; }

 private:
  /// Key scan to be laid on a patch, and from where.
  struct Start {
    int key = 0;
    std::int32_t x = 0;  // in steps of the raster
    std::int32_t y = 0;
    std::int32_t turn = 0;
    [[nodiscard]] Pose2 pose() const;
    friend auto operator<=>(const Start&, const Start&) = default;
  };
  using Starts = std::map<int, std::vector<Start>>;  // by patch
  struct Known {
    std::optional<GaussianPose> T_patch_key;  // None: not believed.
    std::int64_t asked_in = 0;
  };

  [[nodiscard]] Starts starts(const KeyScans& keys, const std::vector<Pose2>& T_global_key) const;
  void draw(const KeyScans& keys, int patch);
  [[nodiscard]] std::optional<GaussianPose> laid_on_patch(const LaserScan& scan,
                                                          const Pose2& start) const;

  PatchMatchOptions options_;
  ScrollingMap map_;  // of one patch at a time, in the frame of its middle
  std::map<std::pair<int, Start>, Known> known_;
  std::int64_t period_ = 0;  // between calls of forget_unused()
  std::int64_t matches_made_ = 0;
};

}  // namespace cairn
