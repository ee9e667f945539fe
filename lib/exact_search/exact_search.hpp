#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "exact_search/exploration.hpp"
#include "exact_search/map_counts.hpp"
#include "topology/topological_map.hpp"

namespace cairn {

/// What the maps of a search must satisfy beyond the axiom, and which maps are not looked at since
/// they provably lead to no closed map. Every option names what it gives up.
struct ExactSearchOptions {
  bool planar = false;             ///< Links must lie within a face.
  bool region_consistent = false;  ///< As an axiom: pruned as soon as violated.
  bool perpendicular = false;      ///< No two paths meet twice, no triangles: pruned early.
  std::optional<int> max_places;   ///< >= 1
  /// Skips maps in which more gateways of a kind are pending than the rest of the experience can
  /// close. Loses only maps that end with pending gateways. With max_corners also maps that need
  /// more corners than arrivals at corners are to come.
  bool look_ahead = false;
  /// Skips also maps with a face whose pending gateways cannot be linked to each other and to
  /// places that the rest of the experience can add there: by parity, by circular paths, and, if
  /// max_corners is 4, since all faces must have four corners. Needs planar and look_ahead. Loses
  /// only maps that end with pending gateways. What lets grids of an even side be found without a
  /// compass.
  bool look_ahead_by_face = false;
  /// Skips maps whose faces need more corners (places of type L) than max_corners allows. Needs
  /// planar and perpendicular; loses nothing that is closed.
  std::optional<int> max_corners;
  bool straight_corridors = false;  ///< A gateway is north-south or east-west: 4-slot stars only.
  bool compass = false;  ///< Gateways keep their heading along corridors: 4-slot stars only.
  /// Nodes that a search may count, the root included; 0: no limit. A search is complete if it
  /// needs no more; one that does counts exactly as many and says so.
  std::int64_t max_nodes = 0;
  int max_codes = 64;  ///< Canonical codes kept of the simplest maps.
};

/// Every map consistent with the exploration, counted by depth-first search with one working state:
/// no leaf is stored.
struct Enumeration {
  MapCounts counts;
  bool is_complete = true;  ///< False: there are more nodes than max_nodes.
};
[[nodiscard]] Enumeration enumerate(const Exploration& exploration,
                                    const ExactSearchOptions& options);

/// What best-first search takes first. All are bounds that never exceed the map's final value and
/// are exact at closed maps, so that the first closed map is the least of its kind. With
/// max_corners the first two include corners still needed as well.
enum class SearchOrder {
  kPlaces,            ///< Places, then paths.
  kPaths,             ///< Paths (half of the terminated ends), then places.
  kCorners,           ///< Corners (places of type L) still needed included, then places. Planar and
                      ///< perpendicular.
  kPathsWithCorners,  ///< Paths with corners still needed, then places. Planar and perpendicular.
};

/// The first closed map (no gateway pending) that a best-first search meets. Among equal bounds the
/// search takes the deepest first. Where the experience is long (over 256 travels), look_ahead is
/// on and the order counts corners, it deepens iteratively on the first part of the order instead,
/// which stores no nodes and gives the same guarantee.
struct BestMap {
  std::optional<TopologicalMap> map;
  std::string code;
  std::int64_t tree_nodes = 0;  ///< Generated.
  std::int64_t maps_built = 0;
  std::int64_t max_open = 0;       ///< Longest list of nodes waiting.
  std::int64_t stored_nodes = 0;   ///< 0 where it deepens iteratively.
  std::size_t bytes_per_node = 0;  ///< Stored.
  std::size_t bytes_per_open = 0;  ///< Of a node that waits, beyond its own.
  bool is_proven = false;          ///< Nothing that waits can be better.
  bool is_complete = true;         ///< False: the search needs more nodes than max_nodes.
};
[[nodiscard]] BestMap find_best(const Exploration& exploration,
                                const ExactSearchOptions& options,
                                SearchOrder order);

/// Options that exclude each other, out-of-range bounds, stars that an option cannot deal with.
Status validate(const ExactSearchOptions& options, const Exploration& exploration);
/// The same, and whether the order can be used with them.
Status validate(const ExactSearchOptions& options,
                const Exploration& exploration,
                SearchOrder order);

/// Rooted canonical code of a map and the robot's position: places numbered breadth-first from the
/// robot's place, gateways clockwise from the one by which the place was met; each place is its
/// star's type, the number of the gateway's view class, and "[neighbour.offset ...]", "-" where
/// pending. Equal exactly for maps that are the same.
[[nodiscard]] std::string canonical_code(const TopologicalMap& map);

}  // namespace cairn
