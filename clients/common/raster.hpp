#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include <cairn_lcm/grid_map_t.hpp>

namespace cairn::clients {

inline constexpr std::uint8_t kUnknownCell = 255;

/// An occupancy grid in one piece, cut down to what is known.
struct Raster {
  double cell_m = 0.0;
  double origin_x_m = 0.0;  ///< Frame of the grid: lower left corner of cell (0, 0).
  double origin_y_m = 0.0;
  int width = 0;  ///< Cells; 0 where nothing is known.
  int height = 0;
  std::vector<std::uint8_t> cells;  ///< Row by row, y up: occupancy in percent; 255 unknown.

  /// The cell; unknown outside.
  [[nodiscard]] std::uint8_t at(int x, int y) const {
    return x < 0 || y < 0 || x >= width || y >= height
               ? kUnknownCell
               : cells[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                       static_cast<std::size_t>(x)];
  }
};

/// Puts the tiles together. Throws Failure(kBadData) for tiles of the wrong size, a cell size that
/// is not positive, or a map of more than 2^28 cells.
[[nodiscard]] Raster raster_of(const cairn_lcm::grid_map_t& map);

/// Writes the map for the map_server of ROS: an 8-bit PGM (254 free, 0 occupied, 205 unknown,
/// shades of trinary thresholds) and beside it the YAML file, same name, extension .yaml.
/// @return path of the YAML file
std::filesystem::path write_ros_map(const Raster& raster, const std::filesystem::path& pgm);

}  // namespace cairn::clients
