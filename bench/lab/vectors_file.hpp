#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "bench/lab/counts.hpp"
#include "exact_search/exploration.hpp"

namespace cairn::lab {

/// An exploration whose counts are published.
struct TestVector {
  std::string name;
  Exploration exploration;
  std::optional<int> max_places;
  Json nonplanar;  ///< Expected counts.
  Json planar;
};

struct VectorsFile {
  std::vector<TestVector> vectors;
  ViewNames names;  ///< The file has its own names for stars.
};

/// Reads a file of explorations and counts in the format that it describes itself. Throws
/// clients::Failure(kBadData) that says where (vector, step, field), what was expected and what
/// came.
[[nodiscard]] VectorsFile read_vectors(const std::filesystem::path& path);

}  // namespace cairn::lab
