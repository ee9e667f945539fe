#pragma once

#include <map>
#include <string>
#include <vector>

#include "exact_search/exploration.hpp"

namespace cairn::lab {

/// How canonical codes name a place that is entered by this gateway: "T1".
/// @pre star is valid and has the gateway
[[nodiscard]] std::string view_token(const Star& star, int gateway);

/// A place of a canonical code: "T1[0.2 - 3.0]".
struct CodedPlace {
  std::string view;
  /// Clockwise from the gateway of entry: number of the place there and gateways clockwise from its
  /// entry, or -1 and 0 where pending.
  struct Exit {
    int place = -1;
    int offset = 0;
  };
  std::vector<Exit> exits;
};

/// @pre code is a canonical code
[[nodiscard]] std::vector<CodedPlace> parsed_code(const std::string& code);

/// The code with its views named otherwise; those that are not in the table keep their names.
[[nodiscard]] std::string renamed_code(const std::string& code,
                                       const std::map<std::string, std::string>& names);

}  // namespace cairn::lab
