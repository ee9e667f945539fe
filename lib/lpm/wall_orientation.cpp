#include "lpm/wall_orientation.hpp"

#include <algorithm>
#include <cmath>

#include "base/check.hpp"
#include "base/validator.hpp"

namespace cairn {
namespace {

constexpr double kQuarterTurn = 0.5 * kPi;
// Walls in any direction would spread by 0.58 of the reach around a canonical direction.
constexpr double kDisagreement = 0.4;

/// The same direction modulo 90 degrees, in [-pi/4, pi/4].
double folded(double angle_rad) {
  return std::remainder(angle_rad, kQuarterTurn);
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
      .within("least_aligned_share", options.least_aligned_share, 0.01, 1.0)
      .within("least_scan_share", options.least_scan_share, 0.01, 1.0)
      .positive("least_scan_length_m", options.least_scan_length_m)
      .positive("first_length_m", options.first_length_m)
      .positive("memory_length_m", options.memory_length_m)
      .within("gather_every_m", options.gather_every_m, 0.0, 100.0)
      .within("gather_every_rad", options.gather_every_rad, 0.0, 10.0)
      .positive("wall_sigma_rad", options.wall_sigma_rad)
      .positive("least_sigma_rad", options.least_sigma_rad)
      .status();
}

WallOrientation::WallOrientation(const WallOrientationOptions& options) : options_(options) {
  CAIRN_CHECK(validate(options).ok());
}

std::optional<HeadingMeasurement> WallOrientation::absorb(const LaserScan& scan,
                                                          const Pose2& T_lpm_robot) {
  const std::vector<WallSegment> segments = wall_segments(scan, options_.segment);
  const auto measurement = measured(segments, T_lpm_robot.theta());
  if (is_due(T_lpm_robot)) {
    T_lpm_gathered_ = T_lpm_robot;
    gather(segments, measurement ? measurement->theta_rad : T_lpm_robot.theta());
    find_direction();
  }
  return measurement;
}

std::optional<HeadingMeasurement> WallOrientation::measured(
    const std::vector<WallSegment>& segments, double theta_rad) const {
  if (!direction_) {
    return std::nullopt;
  }
  double all_m = 0.0;
  double aligned_m = 0.0;
  double weights = 0.0;
  double sum = 0.0;
  double squares = 0.0;
  for (const WallSegment& segment : segments) {
    const double off_rad = folded(segment.direction_rad + theta_rad - direction_->direction_rad);
    all_m += segment.length_m;
    if (std::abs(off_rad) > options_.canonical_rad) {
      continue;
    }
    aligned_m += segment.length_m;
    const double weight = 1.0 / (segment.sigma_rad * segment.sigma_rad +
                                 options_.wall_sigma_rad * options_.wall_sigma_rad);
    weights += weight;
    sum += weight * off_rad;
    squares += weight * off_rad * off_rad;
  }
  if (aligned_m < options_.least_scan_length_m || aligned_m < options_.least_scan_share * all_m) {
    return std::nullopt;
  }
  const double off_rad = sum / weights;
  // Walls that agree less than they should make the measurement as much worse.
  const double spread2 = std::max(squares / weights - off_rad * off_rad, 0.0);
  const double sigma_rad = std::sqrt(std::max(1.0 / weights, spread2));
  if (sigma_rad > kDisagreement * options_.canonical_rad) {
    return std::nullopt;
  }
  return HeadingMeasurement{wrap_angle(theta_rad - off_rad),
                            std::max(sigma_rad, options_.least_sigma_rad)};
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
  const int reach = static_cast<int>(options_.canonical_rad / kQuarterTurn * kBins);
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
      const double off_rad = folded(direction_of(bin) - direction_rad);
      if (std::abs(off_rad) <= options_.canonical_rad) {
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
