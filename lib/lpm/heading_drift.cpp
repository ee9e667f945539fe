#include "lpm/heading_drift.hpp"

#include <algorithm>

namespace cairn {
namespace {

constexpr double kStretch_m = 1.0;
constexpr std::size_t kCloseStretches = 5;  // apart: no wall of one is of weight in the other
constexpr double kLeastPairs = 20.0;        // far apart, before drift is looked for
constexpr double kMostPairs = 2000.0;       // then what was seen before has half the weight
constexpr double kSurelyDrift = 0.9;        // of the spread far apart; the rest may be chance
constexpr double kAlike = 3.0;              // stretches in a row that see the same walls
constexpr double kLeastSigma_rad = 0.004;

}  // namespace

void HeadingDrift::Differences::take(double a_rad, double b_rad) {
  sum_rad2 += 0.5 * (a_rad - b_rad) * (a_rad - b_rad);
  count += 1.0;
}

void HeadingDrift::Differences::fade() {
  sum_rad2 *= 0.5;
  count *= 0.5;
}

void HeadingDrift::absorb(double travel_m, double off_rad) {
  if (!has_begun_) {
    has_begun_ = true;
    begin_m_ = travel_m;
  }
  if (travel_m - begin_m_ > kStretch_m * (kFarStretches + 1)) {
    // Nothing was measured for so long that nothing is left to compare with.
    stretches_.fill({});
    begin_m_ = travel_m;
  }
  while (travel_m - begin_m_ >= kStretch_m) {
    end_stretch();
    begin_m_ += kStretch_m;
  }
  stretches_[at_].sum_rad += off_rad;
  ++stretches_[at_].count;
}

void HeadingDrift::end_stretch() {
  const std::size_t size = stretches_.size();
  const Stretch& ended = stretches_[at_];
  const Stretch& close = stretches_[(at_ + size - kCloseStretches) % size];
  const Stretch& far = stretches_[(at_ + 1) % size];
  variance_rad2_ += kStretch_m * drift_rad2_per_m();
  if (ended.count > 0) {
    if (close.count > 0) {
      close_.take(ended.mean_rad(), close.mean_rad());
    }
    if (far.count > 0) {
      far_.take(ended.mean_rad(), far.mean_rad());
    }
    filter(ended.mean_rad());
  }
  if (far_.count > kMostPairs) {
    far_.fade();
    close_.fade();
  }
  at_ = (at_ + 1) % size;
  stretches_[at_] = {};
}

void HeadingDrift::filter(double off_rad) {
  const double noise_rad2 = kAlike * std::max(close_.variance(), kLeastSigma_rad * kLeastSigma_rad);
  if (!has_offset_) {
    has_offset_ = true;
    off_rad_ = off_rad;
    variance_rad2_ = noise_rad2;
    return;
  }
  const double gain = variance_rad2_ / (variance_rad2_ + noise_rad2);
  const double change_rad = gain * (off_rad - off_rad_);
  off_rad_ += change_rad;
  variance_rad2_ *= 1.0 - gain;
  if (drift_rad2_per_m() > 0.0) {
    correction_rad_ -= change_rad;  // else it was but learned how the walls lie here
  }
}

double HeadingDrift::drift_rad2_per_m() const {
  if (far_.count < kLeastPairs) {
    return 0.0;
  }
  constexpr double kApart_m = kStretch_m * (kFarStretches - kCloseStretches);
  return std::max(0.0, 2.0 * (kSurelyDrift * far_.variance() - close_.variance()) / kApart_m);
}

}  // namespace cairn
