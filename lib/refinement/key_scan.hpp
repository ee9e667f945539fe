#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "geometry/gaussian_pose.hpp"
#include "sensing/laser_scan.hpp"

namespace cairn {

/// A scan that stands for all those up to the next key scan.
struct KeyScan {
  std::size_t number = 0;                 ///< Among all scans of the way, from 0.
  std::shared_ptr<const LaserScan> scan;  ///< Not null.
  GaussianPose T_before_this;             ///< From the key scan before, by local mapping.
  double travel_m = 0.0;                  ///< Along the way, since the first scan.
};

/// Shared and immutable: pictures of the map hold the same key scans.
using KeyScans = std::vector<std::shared_ptr<const KeyScan>>;

/// Chooses the key scans of a way, scan by scan: those before never change.
class KeyScanChooser {
 public:
  static constexpr double kEvery_m = 0.8;    ///< Of travel from one key scan to the next,
  static constexpr double kEvery_rad = 0.8;  ///< or so much turning.

  /// @param motion since the scan before; not looked at for the first scan
  /// @param is_trusted whether it may stand for others; the first one always does
  void add(const std::shared_ptr<const LaserScan>& scan,
           const GaussianPose& motion,
           bool is_trusted = true);

  [[nodiscard]] const KeyScans& key_scans() const { return key_scans_; }

 private:
  KeyScans key_scans_;
  std::size_t scans_ = 0;
  GaussianPose T_key_robot_;  // since the last key scan
  double travel_m_ = 0.0;
  double driven_m_ = 0.0;  // since the last key scan
  double turned_rad_ = 0.0;
};

}  // namespace cairn
