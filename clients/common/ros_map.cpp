#include <sstream>

#include "clients/common/failure.hpp"
#include "clients/common/raster.hpp"
#include "clients/common/text.hpp"

namespace cairn::clients {
namespace {

// The map_server of ROS reads a shade s as an occupancy of (255 - s) / 255 and, in trinary mode,
// keeps what lies between the thresholds as unknown: 205 gives 0.1961, just above 0.196.
constexpr int kFreeBelowPercent = 25;
constexpr int kOccupiedAbovePercent = 65;
constexpr char kFreeShade = static_cast<char>(254);
constexpr char kOccupiedShade = static_cast<char>(0);
constexpr char kUnknownShade = static_cast<char>(205);

char shade_of(std::uint8_t cell) {
  if (cell == kUnknownCell) {
    return kUnknownShade;
  }
  return cell < kFreeBelowPercent       ? kFreeShade
         : cell > kOccupiedAbovePercent ? kOccupiedShade
                                        : kUnknownShade;
}

}  // namespace

std::filesystem::path write_ros_map(const Raster& raster, const std::filesystem::path& pgm) {
  // One unknown cell stands for a map without any: readers refuse a picture without pixels.
  const int width = raster.width > 0 ? raster.width : 1;
  const int height = raster.height > 0 ? raster.height : 1;
  std::string picture = "P5\n" + std::to_string(width) + " " + std::to_string(height) + "\n255\n";
  for (int y = height - 1; y >= 0; --y) {
    for (int x = 0; x < width; ++x) {
      picture += shade_of(raster.at(x, y));
    }
  }
  write_file(pgm, picture);

  std::ostringstream yaml;
  yaml << "image: " << pgm.filename().string() << "\n"
       << "mode: trinary\n"
       << "resolution: " << fixed(raster.cell_m, 6) << "\n"
       << "origin: [" << fixed(raster.origin_x_m, 6) << ", " << fixed(raster.origin_y_m, 6)
       << ", 0.0]\n"
       << "negate: 0\n"
       << "occupied_thresh: 0.65\n"
       << "free_thresh: 0.196\n";
  std::filesystem::path yaml_path = pgm;
  write_file(yaml_path.replace_extension(".yaml"), yaml.str());
  return yaml_path;
}

}  // namespace cairn::clients
