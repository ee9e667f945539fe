#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/result.hpp"
#include "geometry/gaussian_pose.hpp"
#include "lpm/lpm_options.hpp"
#include "lpm/scan_beams.hpp"
#include "lpm/scan_matcher.hpp"
#include "lpm/scrolling_map.hpp"
#include "lpm/split_random.hpp"

namespace cairn {

/// Matches scans with the scrolling map by a particle filter over poses: the papers' own method,
/// with the interface of ScanMatcher.
///
/// The belief before a scan is the prediction, blurred by what the particles of the scan before
/// left open (along a corridor, say). As many particles are drawn as it takes to render it within
/// an error (Fox, "KLD-sampling", NIPS 2001), in pairs on either side of the mean. They are weighed
/// by the likelihood field of the map's walls, in tempering steps, with low-variance resampling and
/// a kernel that keeps mean and covariance between them (Liu and West 2001).
///
/// Source: Kuipers et al., ICRA 2004, Sec. III-A; Modayil et al., IROS 2004, Sec. IV-A; Thrun,
/// Burgard and Fox, "Probabilistic Robotics", Sec. 4.3 (table 4.4) and 6.4.
class ParticleMatcher {
 public:
  /// @pre both options are within their ranges
  explicit ParticleMatcher(const ScanMatchOptions& options, const ParticleOptions& particles = {});

  /// Takes the returns of a scan, thinned to the point spacing. The map must not change until all
  /// matches of this scan are done.
  void take(const ScanBeams& beams);
  [[nodiscard]] bool is_blocked() const;
  /// What the particles left from the last match hold.
  [[nodiscard]] std::size_t memory_bytes() const;

  /// The mean of the particles, and the information that they owe to the returns.
  /// @pre the covariance of the prediction is positive definite
  [[nodiscard]] ScanMatch match(const ScrollingMap& map, const GaussianPose& T_lpm_robot_predicted);

  /// How many particles the last match began with.
  [[nodiscard]] int particle_count() const { return first_count_; }

 private:
  using Vector3d = Eigen::Vector3d;
  using Bin = std::array<int, 3>;
  /// Particles are deviations (x, y, theta) from the predicted pose, in the lpm frame.
  struct Belief {
    std::vector<Vector3d> particles;
    std::vector<double> log_likelihoods;
  };
  struct Moments {
    Vector3d mean = Vector3d::Zero();
    Matrix3d covariance = Matrix3d::Zero();
  };

  [[nodiscard]] ScanMatch filtered(const ScrollingMap& map,
                                   const GaussianPose& predicted,
                                   SplitRandom random,
                                   std::vector<Vector3d>* left_open);
  [[nodiscard]] std::vector<Vector3d> drawn(const Matrix3d& covariance, SplitRandom* random) const;
  [[nodiscard]] Bin bin_of(const Vector3d& deviation) const;
  [[nodiscard]] std::size_t enough(std::size_t bins) const;
  void weigh(const DistanceField& walls, const Pose2& around, Belief* belief) const;
  [[nodiscard]] double log_likelihood(const DistanceField& walls, const Pose2& pose) const;
  [[nodiscard]] double next_temper(const Belief& belief, double temper) const;
  void resample(double temper_step, SplitRandom* random, Belief* belief) const;
  [[nodiscard]] static Moments moments_of(const std::vector<Vector3d>& particles);

  ScanMatchOptions options_;
  ParticleOptions particles_;
  SplitRandom random_;
  std::vector<SurfacePoint> returns_;      // robot frame
  std::vector<SurfacePoint> few_returns_;  // weighed per particle
  double weight_ = 0.0;                    // of one of the few, in independent returns
  std::uint64_t scans_ = 0;
  std::uint64_t matches_ = 0;             // of this scan
  double best_score_ = -1.0;              // of the matches of this scan
  std::vector<Vector3d> left_open_;       // deviations from the pose told for the scan before
  std::vector<Vector3d> next_left_open_;  // of the best match of this scan
  UsualScore usual_score_;
  int first_count_ = 0;
};

}  // namespace cairn
