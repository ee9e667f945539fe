#pragma once

#include <vector>

#include "geometry/gaussian_pose.hpp"
#include "lpm/correlative_search.hpp"
#include "lpm/lpm_options.hpp"
#include "lpm/scan_beams.hpp"
#include "lpm/scan_refinement.hpp"
#include "lpm/scrolling_map.hpp"

namespace cairn {

/// Where a scan lies in the map, and how well.
struct ScanMatch {
  Refinement fit;
  /// Of the returns alone, as they scattered in this match, were the map without error; long where
  /// they say nothing.
  [[nodiscard]] Matrix3d covariance(double hit_sigma_m) const;
  double score = 0.0;         ///< Share of the returns over known cells that fall on walls, [0, 1].
  double usual_score = 0.0;   ///< What scans scored of late.
  double known_share = 0.0;   ///< Share of the returns that fall on known cells, [0, 1].
  bool was_searched = false;  ///< The wide search was needed.
};

/// What scans have scored of late.
class UsualScore {
 public:
  [[nodiscard]] double value() const { return value_; }
  /// Bad scores do not become usual.
  void learn(double score);

 private:
  double value_ = 0.85;
};

/// Matches scans with the scrolling map, with effort by need: least squares from the prediction
/// where that is certain and succeeds, a correlative search over the uncertain region otherwise.
class ScanMatcher {
 public:
  explicit ScanMatcher(const ScanMatchOptions& options) : options_(options) {}

  /// Takes the returns of a scan, thinned to the point spacing. The map must not change until all
  /// matches of this scan are done.
  void take(const ScanBeams& beams);
  [[nodiscard]] bool is_blocked() const;
  [[nodiscard]] std::size_t memory_bytes() const { return search_.memory_bytes(); }

  /// @pre the covariance of the prediction is positive definite
  [[nodiscard]] ScanMatch match(const ScrollingMap& map, const GaussianPose& T_lpm_robot_predicted);

 private:
  void choose_few();
  [[nodiscard]] ScanMatch nearby(const ScrollingMap& map, const GaussianPose& predicted);
  [[nodiscard]] ScanMatch in_doubt(const ScrollingMap& map,
                                   const GaussianPose& predicted,
                                   const ScanMatch& believed);
  [[nodiscard]] ScanMatch refined(const ScrollingMap& map,
                                  const GaussianPose& predicted,
                                  const Pose2& start) const;
  void prepare_search(const ScrollingMap& map, const Pose2& around);
  [[nodiscard]] ScanMatch searched(const ScrollingMap& map,
                                   const GaussianPose& predicted,
                                   double most_turn_rad);

  ScanMatchOptions options_;
  std::vector<SurfacePoint> returns_;      // robot frame
  std::vector<SurfacePoint> few_returns_;  // for the search
  double reach_m_ = 0.0;                   // of few_returns_
  CorrelativeSearch search_;
  unsigned doubts_ = 0;  // of the last matches in a row
  UsualScore usual_score_;
  bool is_prepared_ = false;  // for the scan taken last, around
  Vector2d prepared_at_m_ = Vector2d::Zero();
};

}  // namespace cairn
