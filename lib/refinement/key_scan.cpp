#include "refinement/key_scan.hpp"

#include <cmath>
#include <utility>

namespace cairn {

void KeyScanChooser::add(const std::shared_ptr<const LaserScan>& scan,
                         const GaussianPose& motion,
                         bool is_trusted) {
  const std::size_t number = scans_++;
  if (number > 0) {
    const double step_m = motion.mean.translation().norm();
    T_key_robot_ = compounded(T_key_robot_, motion);
    travel_m_ += step_m;
    driven_m_ += step_m;
    turned_rad_ += std::abs(motion.mean.theta());
    if (!is_trusted || (driven_m_ < kEvery_m && turned_rad_ < kEvery_rad)) {
      return;
    }
  }
  key_scans_.push_back(
      std::make_shared<const KeyScan>(KeyScan{number, scan, T_key_robot_, travel_m_}));
  T_key_robot_ = {};
  driven_m_ = 0.0;
  turned_rad_ = 0.0;
}

}  // namespace cairn
