#pragma once

#include <fstream>
#include <map>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "support/recorded_data.hpp"
#include "support/stars.hpp"

namespace cairn::test {

/// A recorded JSON file, such as topology/vectors.json.
inline nlohmann::json recorded_json(const std::string& file) {
  std::ifstream in(recorded_data(file));
  return nlohmann::json::parse(in);
}

/// The stars that a file of test vectors names.
inline std::map<std::string, Star> stars_of(const nlohmann::json& file) {
  std::map<std::string, Star> stars;
  for (const auto& [name, star] : file["stars"].items()) {
    stars[name] = star_of(star["slots"].get<std::vector<int>>(),
                          star["partner_slot"].get<std::vector<std::size_t>>());
  }
  return stars;
}

}  // namespace cairn::test
