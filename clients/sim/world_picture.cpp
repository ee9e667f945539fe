#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <sstream>

#include <png.h>

#include "clients/sim/text_file.hpp"
#include "clients/sim/world.hpp"

namespace cairn::sim {
namespace {

constexpr std::size_t kMaxPixels = 100'000'000;
constexpr std::size_t kMaxTourWaypoints = 1'000;
/// Pictures that were scaled or compressed have no pure white.
constexpr std::uint8_t kDarkestFree = 250;

/// Frees what libpng holds, on every way out.
class PictureReader {
 public:
  PictureReader() { image_.version = PNG_IMAGE_VERSION; }
  ~PictureReader() { png_image_free(&image_); }
  PictureReader(const PictureReader&) = delete;
  PictureReader(PictureReader&&) = delete;
  PictureReader& operator=(const PictureReader&) = delete;
  PictureReader& operator=(PictureReader&&) = delete;

  FloorPlan read(const std::filesystem::path& file, double m_per_pixel) {
    if (png_image_begin_read_from_file(&image_, file.c_str()) == 0) {
      throw BadWorld(file.string() + ": expected a PNG picture: " + image_.message);
    }
    const auto pixels = static_cast<std::size_t>(image_.width) * image_.height;
    if (pixels == 0 || pixels > kMaxPixels) {
      throw BadWorld(file.string() + ": expected at most 100 million pixels, has " +
                     std::to_string(image_.width) + " x " + std::to_string(image_.height));
    }
    image_.format = PNG_FORMAT_GRAY;
    std::vector<std::uint8_t> grey(pixels);
    const png_color black = {0, 0, 0};  // Behind transparent pixels: unknown is wall.
    if (png_image_finish_read(&image_, &black, grey.data(), 0, nullptr) == 0) {
      throw BadWorld(file.string() + ": the picture is damaged: " + image_.message);
    }
    return plan_of(grey, m_per_pixel);
  }

 private:
  [[nodiscard]] FloorPlan plan_of(const std::vector<std::uint8_t>& grey, double m_per_pixel) const {
    const int columns = static_cast<int>(image_.width);
    const int rows = static_cast<int>(image_.height);
    FloorPlan plan(columns, rows, m_per_pixel);
    std::size_t pixel = 0;
    for (int row = rows - 1; row >= 0; --row) {
      for (int column = 0; column < columns; ++column) {
        if (grey[pixel++] >= kDarkestFree) {
          plan.set_free({column, row});
        }
      }
    }
    return plan;
  }

  png_image image_{};
};

/// One line of a tour file; empty where the line holds no waypoint.
std::optional<NamedPoint> waypoint_of(const std::string& line, const std::string& where) {
  std::istringstream words(line.substr(0, line.find('#')));
  std::string x;
  std::string y;
  NamedPoint waypoint;
  if (!(words >> x)) {
    return std::nullopt;
  }
  words >> y >> waypoint.name;
  waypoint.at = {number_of(x, "x in metres", where), number_of(y, "y in metres", where)};
  std::string rest;
  if (words >> rest) {
    throw BadWorld(where + ": expected 'x_m y_m [name]', got '" + rest + "' after it");
  }
  return waypoint;
}

bool is_new_name(const World& world, const NamedPoint& waypoint, const std::string& where) {
  for (const NamedPoint& known : world.junctions) {
    if (known.name == waypoint.name && known.at != waypoint.at) {
      throw BadWorld(where + ": the name '" + waypoint.name + "' already means another point");
    }
    if (known.name == waypoint.name) {
      return false;
    }
  }
  return !waypoint.name.empty();
}

void check_waypoint(const World& world, const NamedPoint& waypoint, const std::string& where) {
  const std::vector<NamedPoint>& waypoints = world.tours.front().waypoints;
  if (waypoints.size() >= kMaxTourWaypoints) {
    throw BadWorld(where + ": expected at most 1000 waypoints");
  }
  const Point from = waypoints.empty() ? waypoint.at : waypoints.back().at;
  if (!waypoints.empty() && from == waypoint.at) {
    throw BadWorld(where + ": expected a waypoint that differs from the one before");
  }
  if (const auto obstacle = obstacle_on(world.plan, from, waypoint.at)) {
    throw BadWorld(where + ": expected a free straight leg to this waypoint, but " + *obstacle);
  }
}

}  // namespace

World read_floor_plan(const std::filesystem::path& picture,
                      double m_per_pixel,
                      const std::filesystem::path& tour_file) {
  World world;
  world.plan = PictureReader().read(picture, m_per_pixel);
  world.tours.push_back({"tour", {}});
  std::istringstream lines(read_text(tour_file));
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    const std::string where = tour_file.string() + ":" + std::to_string(++number);
    const std::optional<NamedPoint> waypoint = waypoint_of(line, where);
    if (!waypoint) {
      continue;
    }
    check_waypoint(world, *waypoint, where);
    if (is_new_name(world, *waypoint, where)) {
      world.junctions.push_back(*waypoint);
    }
    world.tours.front().waypoints.push_back(*waypoint);
  }
  if (world.tours.front().waypoints.size() < 2) {
    throw BadWorld(tour_file.string() + ": expected two waypoints or more");
  }
  return world;
}

}  // namespace cairn::sim
