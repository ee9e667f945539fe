#pragma once

#include <cstddef>
#include <variant>

#include "lpm/particle_matcher.hpp"
#include "lpm/scan_matcher.hpp"

namespace cairn {

/// One of the ways to match scans, with the interface that they share.
class Matcher {
 public:
  /// @pre the options are within their ranges
  Matcher(MatcherKind kind, const ScanMatchOptions& options, const ParticleOptions& particles);

  /// Takes the returns of a scan. The map must not change until all its matches are done.
  void take(const ScanBeams& beams);
  [[nodiscard]] bool is_blocked() const;
  [[nodiscard]] std::size_t memory_bytes() const;
  /// @pre the covariance of the prediction is positive definite
  [[nodiscard]] ScanMatch match(const ScrollingMap& map, const GaussianPose& T_lpm_robot_predicted);

 private:
  std::variant<ScanMatcher, ParticleMatcher> matcher_;
};

}  // namespace cairn
