#pragma once

#include <string>
#include <string_view>

#include "base/result.hpp"

namespace cairn {

/// Collects every option of one object that is out of range, so that an operator sees all of them
/// in one round.
///
///     return Validator("localizer")
///         .within("particle_count", options.particle_count, 1, 100'000)
///         .positive("hit_sigma_m", options.hit_sigma_m)
///         .status();
class Validator {
 public:
  /// @param object name of the object in the configuration file, prefixed to every field
  explicit Validator(std::string_view object) : object_(object) {}

  /// The value must lie in [low, high]. NaN does not.
  Validator& within(std::string_view field, double value, double low, double high);
  /// The value must be finite and greater than zero.
  Validator& positive(std::string_view field, double value);
  /// The condition must hold; `rule` completes the sentence "<field> must ...".
  Validator& require(std::string_view field, bool holds, std::string_view rule);

  [[nodiscard]] Status status() const;

 private:
  void complain(std::string_view field, const std::string& rule_and_value);

  std::string object_;
  std::string complaints_;
};

}  // namespace cairn
