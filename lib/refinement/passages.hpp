#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "geometry/pose2.hpp"
#include "refinement/key_scan.hpp"

namespace cairn {

struct PatchMatchOptions;

/// Tells for key scans which patches lie near them that were driven through at another time.
class Passages {
 public:
  /// All must outlive this object; as many poses as key scans.
  Passages(const KeyScans& keys,
           const std::vector<Pose2>& T_global_key,
           const PatchMatchOptions& options);

  /// The nearest patch of each passage, of the nearest passages; nearest first.
  [[nodiscard]] std::vector<int> near(int key) const;

 private:
  struct Tile {
    std::int32_t x = 0;
    std::int32_t y = 0;
    friend auto operator<=>(const Tile&, const Tile&) = default;
  };
  [[nodiscard]] Tile tile_of(const Vector2d& p) const;
  [[nodiscard]] std::vector<int> patches_around(const Vector2d& p) const;

  const KeyScans& keys_;
  const std::vector<Pose2>& T_global_key_;
  const PatchMatchOptions& options_;
  std::vector<std::pair<Tile, int>> patches_;  // sorted
};

}  // namespace cairn
