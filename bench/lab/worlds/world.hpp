#pragma once

#include <array>
#include <compare>
#include <optional>
#include <string>
#include <vector>

#include "exact_search/exploration.hpp"
#include "star/star.hpp"

namespace cairn::lab {

/// A gateway of a world's place, numbered clockwise as in the place's star.
struct WorldGateway {
  int place = 0;
  int gateway = 0;
  friend auto operator<=>(const WorldGateway&, const WorldGateway&) = default;
};

struct WorldPlace {
  Star star;
  std::vector<WorldGateway> leads_to;  ///< By gateway.
};

/// The true map: places and where their gateways lead. All gateways lead somewhere.
struct World {
  std::vector<WorldPlace> places;
};

/// Whether links are symmetric and no place lies twice on a path.
[[nodiscard]] bool satisfies_axioms(const World& world);
/// Whether it can be drawn in the plane with the gateways around its places in order.
/// @pre it is connected
[[nodiscard]] bool is_planar(const World& world);

/// What only the world knows about a visit.
struct TrueVisit {
  int place = 0;
  /// By gateway of the star that was seen, the gateway of the place; -1 where there is none.
  std::vector<int> gateways;
  bool is_misread = false;  ///< The star that was seen is of another kind.
  int missed = 0;           ///< Gateways of the place that were not seen.
  int invented = 0;         ///< Gateways that are not there.
};

/// An experience in a world, and the truth about it.
struct Walk {
  Exploration exploration;
  std::vector<TrueVisit> visits;  ///< The start, then one for each step.
};

/// The walk that begins looking back into `start` and leaves each place by the gateway given.
/// @pre every gateway exists at the place where the walk then is
[[nodiscard]] Walk walk_through(const World& world,
                                WorldGateway start,
                                const std::vector<int>& departures);

/// A grid of streets between places, rows going south and columns east.
struct GridWorld {
  World world;
  int rows = 0;
  int columns = 0;
  /// By place and heading (N E S W): the gateway that leaves there, or -1. Place = row * columns +
  /// column.
  std::vector<std::array<int, 4>> gateways;
};
/// @pre rows, columns >= 1, not both 1
[[nodiscard]] GridWorld grid_world(int rows, int columns);

/// All rows, alternately east and west, from the north-west corner; then, from the corner reached,
/// all columns: how Savelli and Kuipers, IROS 2004, explore grids.
[[nodiscard]] std::string snake_moves(int rows, int columns);

/// A walk by the letters N, E, S and W. Names the first move that leaves the grid or is no letter
/// of these.
[[nodiscard]] Result<Walk> walk_grid(const GridWorld& grid, int start, const std::string& moves);

}  // namespace cairn::lab
