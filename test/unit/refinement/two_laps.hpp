#pragma once

#include <cmath>
#include <memory>
#include <random>
#include <utility>
#include <vector>

#include "refinement/key_scan.hpp"
#include "unit/lpm/simulated_laser.hpp"

namespace cairn::test {

/// A robot on a circle of 2 m in a furnished room, and what local mapping made of its way: each
/// step a little wrong, so that the laps drift apart.
struct TwoLaps {
  static constexpr double kStep_rad = 0.1;  // 0.2 m of way

  explicit TwoLaps(unsigned seed = 1, int scans = 150, double drift_rad_per_step = 3e-4) {
    SimulatedLaser laser(furnished_room(), seed);
    std::mt19937 random(seed);
    std::normal_distribution<double> noise(0.0, 0.001);
    KeyScanChooser chooser;
    for (int i = 0; i < scans; ++i) {
      truth.push_back(truth_at(i));
      GaussianPose motion;
      if (i > 0) {
        const Pose2 step = truth_at(i - 1).inverse() * truth_at(i);
        motion.mean = step * Pose2(noise(random), noise(random), drift_rad_per_step);
        motion.covariance = Eigen::Vector3d(4e-6, 4e-6, 1e-6).asDiagonal();
      }
      believed.push_back(i > 0 ? believed.back() * motion.mean : truth.front());
      scans_.push_back(std::make_shared<const LaserScan>(laser.scan(truth.back(), 0.1 * i)));
      chooser.add(scans_.back(), motion);
    }
    keys = chooser.key_scans();
  }

  static Pose2 truth_at(int step) {
    const double angle_rad = kStep_rad * step;
    return {2.0 * std::sin(angle_rad), -2.0 * std::cos(angle_rad), angle_rad};
  }

  /// Root mean square distance from the truth, after the best rigid motion by the first pose.
  [[nodiscard]] double error_m(const std::vector<Pose2>& poses) const {
    const Pose2 T_truth_poses = truth.front() * poses.front().inverse();
    double sum_m2 = 0.0;
    for (std::size_t i = 0; i < poses.size(); ++i) {
      sum_m2 += (T_truth_poses * poses[i].translation() - truth[i].translation()).squaredNorm();
    }
    return std::sqrt(sum_m2 / static_cast<double>(poses.size()));
  }
  /// How far the laps are apart where they should not be: a lap is 2 pi / kStep_rad scans.
  [[nodiscard]] double laps_apart_m(const std::vector<Pose2>& poses) const {
    double sum_m = 0.0;
    int count = 0;
    constexpr int kLap = 63;
    for (std::size_t i = kLap; i < poses.size(); ++i) {
      const Pose2 truly = truth[i - kLap].inverse() * truth[i];
      const Pose2 thought = poses[i - kLap].inverse() * poses[i];
      sum_m += (thought.translation() - truly.translation()).norm();
      ++count;
    }
    return sum_m / count;
  }

  std::vector<Pose2> truth;
  std::vector<Pose2> believed;  ///< H(x) before it is refined.
  KeyScans keys;

 private:
  std::vector<std::shared_ptr<const LaserScan>> scans_;
};

}  // namespace cairn::test
