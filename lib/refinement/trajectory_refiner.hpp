#pragma once

#include <cstddef>
#include <vector>

#include "base/result.hpp"
#include "geometry/gaussian_pose.hpp"
#include "refinement/key_scan.hpp"
#include "refinement/patch_matcher.hpp"

namespace cairn {

/// The layout says where the robot was at one scan as seen from where it was at another, as it was
/// at the same place at both.
struct SamePlace {
  std::size_t scan = 0;
  std::size_t other_scan = 0;
  GaussianPose T_scan_other;
};

/// Tuning of the refinement. In the configuration file: the object "refinement".
struct TrajectoryRefinementOptions {
  bool enabled = true;  ///< If not, the trajectory is as interpolated between the places.
  PatchMatchOptions matching;
  int rounds = 2;           ///< What lies near what is looked up so often. [1, 10]
  double tolerance = 12.0;  ///< Matches whose squared Mahalanobis distance is so large count a
                            ///< quarter, and worse ones next to nothing. (0, 1000]
};

/// Names every field that is out of range, with its value.
[[nodiscard]] Status validate(const TrajectoryRefinementOptions& options);

/// A trajectory after its refinement, and what that rested on.
struct RefinedTrajectory {
  std::vector<Pose2> T_global_robot;  ///< As many as came.
  /// Of (x, y, theta) of the key scans in the global frame, as against the first one, whose own is
  /// zero. Empty where nothing was refined.
  std::vector<Matrix3d> key_covariances;
  int matches = 0;    ///< Scans that lie on patches of another passage;
  int let_go = 0;     ///< of these, they contradict the others, and hardly count.
  double chi2 = 0.0;  ///< Of all that counts, as it counts.
};

/// H(x) refined: scans are laid on small maps of other passages through the same surroundings, and
/// one sparse solve brings these matches, the local motion and the places together.
///
/// It moves poses, and never says which places are the same: the hypothesis that it is given stays
/// what it was. Matches are looked for only where that hypothesis has the two passages within
/// metres of each other, and each counts less the more it contradicts the others.
///
/// Source: Modayil, Beeson and Kuipers, IROS 2004, Sec. IV-F; switching off contradicting matches
/// after Agarwal et al., "Robust map optimization using dynamic covariance scaling", ICRA 2013.
class TrajectoryRefiner {
 public:
  /// @pre validate(options).ok()
  explicit TrajectoryRefiner(const TrajectoryRefinementOptions& options = {});

  /// The same for the same arguments, whatever was refined before.
  /// @param T_global_robot H(x), by scan: finite poses within 1e6 m
  /// @param keys of the same way, none beyond the last scan
  /// Errors: kNotConverged.
  [[nodiscard]] Result<RefinedTrajectory> refine(const std::vector<Pose2>& T_global_robot,
                                                 const KeyScans& keys,
                                                 const std::vector<SamePlace>& same_places);

  [[nodiscard]] const PatchMatcher& matcher() const { return matcher_; }

 private:
  TrajectoryRefinementOptions options_;
  PatchMatcher matcher_;
};

}  // namespace cairn
