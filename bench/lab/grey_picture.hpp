#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "grid/occupancy_grid.hpp"

namespace cairn::lab {

/// A picture in shades of grey, row by row from above.
struct GreyPicture {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> grey;  ///< 0 black, 255 white.
};

/// Reads a PNG of any kind, or a binary PGM of 8 bits; what is transparent counts as black. Throws
/// Failure(kBadData) for anything else, and for more than 100 million pixels.
[[nodiscard]] GreyPicture read_grey_picture(const std::filesystem::path& file);

/// The map that a picture shows: white is free, black and dark grey are occupied, all other shades
/// are unknown.
[[nodiscard]] OccupancyGrid grid_of(const GreyPicture& picture, double cell_m);

/// Whether a pixel of that shade is free. Pictures that were scaled or compressed have no pure
/// white.
[[nodiscard]] constexpr bool is_free_shade(std::uint8_t grey) {
  constexpr std::uint8_t kDarkestFree = 250;
  return grey >= kDarkestFree;
}

}  // namespace cairn::lab
