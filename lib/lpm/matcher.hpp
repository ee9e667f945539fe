#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <variant>

#include "lpm/particle_matcher.hpp"
#include "lpm/scan_matcher.hpp"

namespace cairn {

/// How scans are matched with the scrolling map. In the configuration file: "correlative" or
/// "particles".
enum class MatcherKind : std::uint8_t {
  kCorrelative,  ///< Least squares, and correlative search where that fails.
  kParticles,    ///< The papers' particle filter.
};

/// The name of a kind, as in the configuration file.
[[nodiscard]] std::string_view to_string(MatcherKind kind);
/// None for a name that is no kind's.
[[nodiscard]] std::optional<MatcherKind> matcher_kind_of(std::string_view name);

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
