#pragma once

#include <sstream>
#include <string>

#include <CLI/CLI.hpp>

namespace cairn::clients {

/// A number of the command line between two bounds, both included. Unlike CLI::Range it refuses
/// what is not a number ("nan"), and negative numbers for unsigned ones.
inline CLI::Validator within(double low, double high) {
  std::ostringstream text;
  text.precision(16);
  text << "in [" << low << " - " << high << "]";
  const std::string range = text.str();
  return CLI::Validator(
      [low, high, range](std::string& input) -> std::string {
        double value = 0.0;
        const bool is_number = CLI::detail::lexical_cast(input, value);
        return is_number && value >= low && value <= high
                   ? std::string()
                   : "expected a number " + range + ", got " + input;
      },
      range);
}

/// The largest seed that every tool takes the same way.
inline constexpr double kMostSeed = 9007199254740992.0;

}  // namespace cairn::clients
