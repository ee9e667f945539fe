#pragma once

#include <vector>

#include "geometry/gaussian_pose.hpp"
#include "lpm/correlative_search.hpp"
#include "lpm/lpm_options.hpp"
#include "lpm/scan_refinement.hpp"
#include "lpm/scrolling_map.hpp"
#include "sensing/laser_scan.hpp"

namespace cairn {

/// Where a scan lies in the map, and how well.
struct ScanMatch {
  Refinement fit;
  double score = 0.0;         ///< Share of the returns over known cells that fall on walls, [0, 1].
  double known_share = 0.0;   ///< Share of the returns that fall on known cells, [0, 1].
  bool was_searched = false;  ///< The wide search was needed.
};

/// Matches scans with the scrolling map, with effort by need: least squares from the prediction
/// where that is certain and succeeds, a correlative search over the uncertain region otherwise.
class ScanMatcher {
 public:
  explicit ScanMatcher(const ScanMatchOptions& options) : options_(options) {}

  /// Takes the returns of a scan, in the robot frame, thinned to the point spacing. The map must
  /// not change until all matches of this scan are done.
  void take(const LaserScan& scan);
  [[nodiscard]] bool is_blocked() const;
  [[nodiscard]] std::size_t memory_bytes() const { return search_.memory_bytes(); }

  /// @pre the covariance of the prediction is positive definite
  [[nodiscard]] ScanMatch match(const ScrollingMap& map, const GaussianPose& T_lpm_robot_predicted);

 private:
  void find_normals();
  [[nodiscard]] ScanMatch best_match(const ScrollingMap& map, const GaussianPose& predicted);
  void judge(const ScrollingMap& map, ScanMatch* match) const;
  [[nodiscard]] ScanMatch refined(const ScrollingMap& map,
                                  const GaussianPose& predicted,
                                  const Pose2& start) const;
  void prepare_search(const ScrollingMap& map, const Pose2& around);
  [[nodiscard]] ScanMatch searched(const ScrollingMap& map, const GaussianPose& predicted);

  ScanMatchOptions options_;
  std::vector<SurfacePoint> returns_;      // robot frame
  std::vector<SurfacePoint> few_returns_;  // for the search
  double farthest_m_ = 0.0;
  CorrelativeSearch search_;
  bool is_prepared_ = false;  // for the scan taken last, around
  Vector2d prepared_at_m_ = Vector2d::Zero();
};

}  // namespace cairn
