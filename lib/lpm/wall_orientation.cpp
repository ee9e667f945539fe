#include "lpm/wall_orientation.hpp"

#include <algorithm>
#include <cmath>

#include "base/check.hpp"
#include "base/validator.hpp"

namespace cairn {
namespace {

constexpr double kQuarterTurn = 0.5 * kPi;

/// The same direction modulo 90 degrees, in [-pi/4, pi/4].
double folded(double angle_rad) {
  return std::remainder(angle_rad, kQuarterTurn);
}

/// The same for an angle in (-3 pi/4, 3 pi/4).
double folded_once(double angle_rad) {
  const double back = angle_rad > 0.5 * kQuarterTurn ? angle_rad - kQuarterTurn : angle_rad;
  return back < -0.5 * kQuarterTurn ? back + kQuarterTurn : back;
}

}  // namespace

Status validate(const WallOrientationOptions& options) {
  return Validator("lpm.wall_orientation")
      .positive("segment.least_length_m", options.segment.least_length_m)
      .within("segment.least_returns", options.segment.least_returns, 3, 1000)
      .positive("segment.flatness_m", options.segment.flatness_m)
      .positive("segment.greatest_gap_m", options.segment.greatest_gap_m)
      .positive("segment.max_range_m", options.segment.max_range_m)
      .within("canonical_rad", options.canonical_rad, 0.01, 0.26)
      .within("narrow_rad", options.narrow_rad, 0.005, options.canonical_rad)
      .within("least_aligned_share", options.least_aligned_share, 0.01, 1.0)
      .within("least_scan_share", options.least_scan_share, 0.01, 1.0)
      .positive("least_scan_length_m", options.least_scan_length_m)
      .positive("first_length_m", options.first_length_m)
      .positive("memory_length_m", options.memory_length_m)
      .within("gather_every_m", options.gather_every_m, 0.0, 100.0)
      .within("gather_every_rad", options.gather_every_rad, 0.0, 10.0)
      .positive("jump_rad", options.jump_rad)
      .within("drift_rad_per_m", options.drift_rad_per_m, 0.0, 10.0)
      .within("drift_rad_per_rad", options.drift_rad_per_rad, 0.0, 10.0)
      .positive("wall_sigma_rad", options.wall_sigma_rad)
      .positive("least_sigma_rad", options.least_sigma_rad)
      .status();
}

WallOrientation::WallOrientation(const WallOrientationOptions& options)
    : options_(options), segmenter_(options.segment) {
  CAIRN_CHECK(validate(options).ok());
}

std::optional<HeadingMeasurement> WallOrientation::absorb(const ScanBeams& beams,
                                                          const Pose2& T_lpm_robot) {
  const std::vector<WallSegment>& segments = segmenter_.split(beams);
  move_to(T_lpm_robot);
  auto measurement = measured(segments, T_lpm_robot.theta());
  if (measurement) {
    const double off_rad = turn_between(measurement->theta_rad, T_lpm_robot.theta());
    if (is_plausible(off_rad)) {
      last_off_rad_ = off_rad;
      possible_drift_rad_ = 0.0;
    } else {
      measurement.reset();
    }
  }
  if (is_due(T_lpm_robot)) {
    T_lpm_gathered_ = T_lpm_robot;
    gather(segments, measurement ? measurement->theta_rad : T_lpm_robot.theta());
    find_direction();
  }
  return measurement;
}

void WallOrientation::move_to(const Pose2& T_lpm_robot) {
  if (T_lpm_last_) {
    const Pose2 step = T_lpm_last_->inverse() * T_lpm_robot;
    possible_drift_rad_ += options_.drift_rad_per_m * step.translation().norm() +
                           options_.drift_rad_per_rad * std::abs(step.theta());
  }
  T_lpm_last_ = T_lpm_robot;
}

bool WallOrientation::is_plausible(double off_rad) const {
  if (!last_off_rad_) {
    return true;
  }
  // Whoever asks may have taken the last measurement into the pose, or not.
  const double change_rad = std::min(std::abs(off_rad), std::abs(off_rad - *last_off_rad_));
  return change_rad <= options_.jump_rad + possible_drift_rad_;
}

WallOrientation::Mean WallOrientation::mean_around(const std::vector<WallSegment>& segments,
                                                   double theta_rad,
                                                   double off_rad,
                                                   double reach_rad) const {
  Mean mean;
  double weights = 0.0;
  double sum = 0.0;
  double squares = 0.0;
  for (const WallSegment& segment : segments) {
    const double rest_rad =
        folded(segment.direction_rad + theta_rad - direction_->direction_rad - off_rad);
    if (std::abs(rest_rad) > reach_rad) {
      continue;
    }
    const double weight = 1.0 / (segment.sigma_rad * segment.sigma_rad +
                                 options_.wall_sigma_rad * options_.wall_sigma_rad);
    mean.length_m += segment.length_m;
    weights += weight;
    sum += weight * rest_rad;
    squares += weight * rest_rad * rest_rad;
  }
  if (weights > 0.0) {
    const double middle_rad = sum / weights;
    // Walls that agree less than they should make the mean as much worse.
    const double spread2 = std::max(squares / weights - middle_rad * middle_rad, 0.0);
    mean.off_rad = off_rad + middle_rad;
    mean.sigma_rad = std::sqrt(std::max(1.0 / weights, spread2));
  }
  return mean;
}

std::optional<HeadingMeasurement> WallOrientation::measured(
    const std::vector<WallSegment>& segments, double theta_rad) const {
  if (!direction_) {
    return std::nullopt;
  }
  double all_m = 0.0;
  for (const WallSegment& segment : segments) {
    all_m += segment.length_m;
  }
  // First all that may belong to the directions, then those that agree with each other.
  const Mean wide = mean_around(segments, theta_rad, 0.0, options_.canonical_rad);
  const Mean mean = mean_around(segments, theta_rad, wide.off_rad, options_.narrow_rad);
  if (mean.length_m < options_.least_scan_length_m ||
      mean.length_m < options_.least_scan_share * all_m) {
    return std::nullopt;
  }
  return HeadingMeasurement{wrap_angle(theta_rad - mean.off_rad),
                            std::max(mean.sigma_rad, options_.least_sigma_rad)};
}

bool WallOrientation::is_due(const Pose2& T_lpm_robot) const {
  if (!T_lpm_gathered_) {
    return true;
  }
  const Pose2 since = T_lpm_gathered_->inverse() * T_lpm_robot;
  return since.translation().norm() >= options_.gather_every_m ||
         std::abs(since.theta()) >= options_.gather_every_rad;
}

void WallOrientation::gather(const std::vector<WallSegment>& segments, double theta_rad) {
  for (const WallSegment& segment : segments) {
    const double share = folded(segment.direction_rad + theta_rad) / kQuarterTurn + 0.5;  // [0, 1]
    const int bin = static_cast<int>(std::floor(share * kBins)) % kBins;
    length_m_[static_cast<std::size_t>(bin)] += segment.length_m;
    seen_m_ += segment.length_m;
  }
  if (seen_m_ > options_.memory_length_m) {
    for (double& length_m : length_m_) {
      length_m *= 0.5;
    }
    seen_m_ *= 0.5;
  }
}

double WallOrientation::length_around(int bin) const {
  const int reach = static_cast<int>(options_.narrow_rad / kQuarterTurn * kBins);
  double length_m = 0.0;
  for (int i = bin - reach; i <= bin + reach; ++i) {
    length_m += length_m_[static_cast<std::size_t>((i + kBins) % kBins)];
  }
  return length_m;
}

void WallOrientation::find_direction() {
  direction_.reset();
  if (seen_m_ < options_.first_length_m) {
    return;
  }
  int mode = 0;
  double most_m = -1.0;
  for (int bin = 0; bin < kBins; ++bin) {
    const double length_m = length_around(bin);
    if (length_m > most_m) {
      most_m = length_m;
      mode = bin;
    }
  }
  // The middle of what lies around the mode, and again around that.
  const auto direction_of = [](int bin) { return kQuarterTurn * ((bin + 0.5) / kBins - 0.5); };
  double direction_rad = direction_of(mode);
  double aligned_m = 0.0;
  for (int round = 0; round < 3; ++round) {
    double sum = 0.0;
    aligned_m = 0.0;
    for (int bin = 0; bin < kBins; ++bin) {
      const double length_m = length_m_[static_cast<std::size_t>(bin)];
      const double off_rad = folded_once(direction_of(bin) - direction_rad);
      if (std::abs(off_rad) <= options_.narrow_rad) {
        sum += length_m * off_rad;
        aligned_m += length_m;
      }
    }
    direction_rad = aligned_m > 0.0 ? folded(direction_rad + sum / aligned_m) : direction_rad;
  }
  if (aligned_m >= options_.least_aligned_share * seen_m_) {
    direction_ = BuildingDirection{direction_rad, aligned_m / seen_m_};
  }
}

}  // namespace cairn
