#pragma once

#include <cstddef>
#include <vector>

#include "lpm/correlative_search.hpp"
#include "lpm/distance_field.hpp"
#include "lpm/max_pyramid.hpp"
#include "lpm/scan_refinement.hpp"

namespace cairn {

/// How likely a wall lies where, on a raster coarser than the map it was taken from, made ready
/// once for many searches: where do the walls of another map fit?
///
/// Source: bounds by max-pyramids and branch and bound as in Hess et al., "Real-time loop closure
/// in 2D lidar SLAM", ICRA 2016, Sec. V-B. Memory: 5 bytes per cell of the raster, so a good byte
/// per cell of the map.
class WallRaster {
 public:
  /// Side of a cell of the raster, in cells of the map.
  static constexpr int kCoarser = 2;

  /// @param hit_sigma_m spread of a point around a wall, > 0
  /// @param reach_m half the side of the widest window that will be searched, >= 0
  WallRaster(const DistanceField& walls, double hit_sigma_m, double reach_m);

  /// The best pose of the window, exactly, on the raster of its cells and of the angles that move
  /// the farthest point by one cell; of equally good ones always the same. The window's centre
  /// where there are no walls or no points. The window's `step_level` does not matter.
  /// @param points in the body frame; their normals do not matter
  /// @pre window.range_m <= reach_m
  [[nodiscard]] SearchResult find(const std::vector<SurfacePoint>& points,
                                  const SearchWindow& window) const;

  [[nodiscard]] const GridGeometry& geometry() const { return geometry_; }
  [[nodiscard]] std::size_t memory_bytes() const { return kLevels * geometry_.cell_count(); }

 private:
  struct Turned;
  struct Block;
  struct Search;

  [[nodiscard]] std::vector<Turned> turned(const std::vector<SurfacePoint>& points,
                                           const SearchWindow& window) const;
  void add_block(Block block, Search* search) const;
  void add_whole_window(Search* search) const;
  void search_through(Search* search) const;

  static constexpr int kLevels = 5;
  GridGeometry geometry_;  // padded, so that no point leaves it within a window
  int reach_cells_ = 0;
  MaxPyramid likelihood_;
};

}  // namespace cairn
