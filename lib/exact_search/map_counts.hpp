#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace cairn {

/// The simplest maps of a kind: how many share the least (paths, places), and which they are.
struct SimplestMaps {
  std::int64_t count = 0;
  int paths = 0;
  int places = 0;
  std::vector<std::string> codes;  ///< Canonical codes, sorted; left empty beyond max_codes.
};

/// The simplest maps that are region-consistent, whether or not gateways are pending, and of those
/// the ones in which no three paths that meet pairwise form a triangle (HSSH, Sec. IV).
struct MinimalRegionMaps {
  std::int64_t count = 0;
  int paths = 0;
  int places = 0;
  /// Paths known from two places or more: the fewest that one of the maps has.
  int paths_with_two_places = 0;
  std::int64_t count_without_triangles = 0;
  /// Pairs of places in order on a path, summed over the paths of a map: the fewest, and how many
  /// of the maps have no more. Another preference that leaves the maps without triangles.
  std::int64_t order_atoms = 0;
  std::int64_t count_fewest_order_atoms = 0;
  std::vector<std::string> codes;  ///< Of those without triangles.
};

/// What Fig. 4 of Savelli and Kuipers (IROS 2004) counts, and more.
struct MapCounts {
  std::int64_t tree_nodes = 0;  ///< The root and all consistent successors.
  std::int64_t maps_built = 0;  ///< The root, closures and new places.
  std::int64_t view_mismatches = 0;
  std::int64_t final_maps = 0;
  std::int64_t closed_paper = 0;  ///< No path known from one place only.
  std::int64_t closed_no_pending = 0;
  std::int64_t region_consistent_finals = 0;
  std::int64_t perpendicular_closed_paper = 0;
  std::optional<SimplestMaps>
      optimal;  ///< Of those region-consistent and without pending gateways.
  std::optional<MinimalRegionMaps> minimal_region;  ///< None without region-consistent finals.
  std::vector<std::int64_t> leaves_per_step;
  /// Leaves that are region-consistent, which is the same whether pruned early or filtered late.
  std::vector<std::int64_t> region_leaves_per_step;
};

}  // namespace cairn
