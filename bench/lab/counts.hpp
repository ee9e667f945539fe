#pragma once

#include <map>
#include <ostream>
#include <set>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "exact_search/map_counts.hpp"

namespace cairn::lab {

using Json = nlohmann::ordered_json;

/// What a view is called in a file of vectors, by what canonical codes call it.
using ViewNames = std::map<std::string, std::string>;

/// The counts, by the names of the files of vectors.
[[nodiscard]] Json to_json(const MapCounts& counts, const ViewNames& names = {});

/// Expected counts held against those counted.
struct Differences {
  /// One line for each field: "tree_nodes: expected 317, got 318".
  std::vector<std::string> found;
  /// Fields that both have, "optimal.count", sorted; of those that are only expected nothing can be
  /// said.
  std::set<std::string> compared;
  std::set<std::string> not_counted;
};
[[nodiscard]] Differences differences(const Json& expected, const Json& counted);

/// The counts for people, a line each.
void print_counts(const MapCounts& counts, std::ostream& out);

}  // namespace cairn::lab
