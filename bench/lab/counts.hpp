#pragma once

#include <map>
#include <ostream>
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

/// What is not as expected, one line for each field: "tree_nodes: expected 317, got 318". Fields
/// that are not expected are not compared.
[[nodiscard]] std::vector<std::string> differences(const Json& expected, const Json& counted);

/// The counts for people, a line each.
void print_counts(const MapCounts& counts, std::ostream& out);

}  // namespace cairn::lab
