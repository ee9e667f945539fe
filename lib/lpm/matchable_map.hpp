#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "grid/occupancy_grid.hpp"
#include "lpm/distance_field.hpp"
#include "lpm/map_match_options.hpp"
#include "lpm/scan_refinement.hpp"
#include "lpm/wall_raster.hpp"

namespace cairn {

/// All that match_maps() needs of a map, worked out once for many comparisons. Does not refer to
/// the grid that it was made from.
/// Memory: about 8 bytes per cell of the map, and the margin of the search.
class MatchableMap {
 public:
  /// @pre validate(options).ok()
  MatchableMap(const OccupancyGrid& map, const MapMatchOptions& options);

  [[nodiscard]] const GridGeometry& geometry() const { return walls_.geometry(); }
  [[nodiscard]] const DistanceField& walls() const { return walls_; }
  [[nodiscard]] const WallRaster& raster() const { return raster_; }
  /// Unknown outside of the map.
  [[nodiscard]] CellState state(Cell c) const {
    return geometry().contains(c) ? states_[geometry().index_of(c)] : CellState::kUnknown;
  }

  /// The middle of all wall cells.
  [[nodiscard]] const Vector2d& center() const { return center_; }
  /// Some hundred wall cells, evenly spread over all, as seen from center(), with the directions of
  /// their walls. Empty where there is no wall.
  [[nodiscard]] const std::vector<SurfacePoint>& points() const { return points_; }
  /// The number of wall cells that one of points() stands for, >= 1.
  [[nodiscard]] double walls_per_point() const { return walls_per_point_; }
  /// Some hundred cells that are known, walls or free, evenly spread.
  [[nodiscard]] const std::vector<Cell>& known() const { return known_; }

  [[nodiscard]] std::size_t memory_bytes() const;

 private:
  void take_walls(const OccupancyGrid& map);
  void take_known();

  DistanceField walls_;
  WallRaster raster_;
  std::vector<CellState> states_;
  Vector2d center_ = Vector2d::Zero();
  std::vector<SurfacePoint> points_;
  double walls_per_point_ = 1.0;
  std::vector<Cell> known_;
};

}  // namespace cairn
