#include "bench/lab/place_picture.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "clients/common/canvas.hpp"
#include "clients/common/text.hpp"
#include "place/local_view.hpp"
#include "star/small_scale_star.hpp"

namespace cairn::lab {
namespace {

using clients::Canvas;
using clients::Colour;
using clients::fixed;
using clients::PixelPoint;

constexpr int kTile = 320;
constexpr int kCaption = 44;
constexpr double kHeight = 9.0;      // of letters
constexpr double kStarHeight = 5.0;  // of those of a star
constexpr Colour kFree{255, 255, 255};
constexpr Colour kUnknown{205, 208, 212};
constexpr Colour kWall{30, 30, 30};
constexpr Colour kAxis{90, 140, 220};
constexpr Colour kGateway{20, 140, 60};
constexpr Colour kUnsure{210, 120, 20};
constexpr Colour kRobot{200, 40, 120};

/// Where a tile lies in the picture, and which part of the world it shows.
struct Tile {
  double left = 0.0;
  double top = 0.0;
  Vector2d p_low = Vector2d::Zero();
  double pixels_per_m = 1.0;

  [[nodiscard]] PixelPoint at(const Vector2d& p) const {
    return {left + (p.x() - p_low.x()) * pixels_per_m,
            top + kTile - (p.y() - p_low.y()) * pixels_per_m};
  }
};

void draw_grid(const OccupancyGrid& grid, const Tile& tile, Canvas* canvas) {
  for (int y = 1; y < kTile; ++y) {
    for (int x = 1; x < kTile; ++x) {
      const Vector2d p = tile.p_low + Vector2d(x, kTile - y) / tile.pixels_per_m;
      const CellState state = grid.state(grid.geometry().cell_at(p));
      const Colour colour = state == CellState::kFree       ? kFree
                            : state == CellState::kOccupied ? kWall
                                                            : kUnknown;
      canvas->set(static_cast<int>(tile.left) + x, static_cast<int>(tile.top) + y, colour);
    }
  }
}

void draw_axis(const PlaceVisit& visit,
               const PlaceOptions& options,
               const Tile& tile,
               Canvas* canvas) {
  LocalViewer viewer;
  const LocalView view = viewer.look_around(visit.lpm, visit.neighbourhood.center, options, kPi);
  for (const AxisEdge& edge : view.axis.edges) {
    std::vector<PixelPoint> line;
    for (const Cell cell : edge.cells) {
      line.push_back(tile.at(view.grid.geometry().center_of(cell)));
    }
    canvas->polyline(line, {kAxis, 1.2, 0.9});
  }
}

void draw_gateway(const Gateway& gateway,
                  Colour colour,
                  const std::string& name,
                  const Tile& tile,
                  Canvas* canvas) {
  canvas->line(tile.at(gateway.basis_points[0]), tile.at(gateway.basis_points[1]), {colour, 2.2});
  canvas->line(tile.at(gateway.middle), tile.at(gateway.middle + 0.8 * gateway.outward()),
               {colour, 1.4});
  canvas->text(tile.at(gateway.middle + 1.1 * gateway.outward()), kHeight, name, {colour, 1.2});
}

void draw_robot(const Pose2& T_place_robot, const Tile& tile, Canvas* canvas) {
  const Vector2d at = T_place_robot.translation();
  canvas->disc(tile.at(at), 3.0, kRobot);
  canvas->line(tile.at(at), tile.at(T_place_robot * Vector2d(0.5, 0.0)), {kRobot, 1.4});
}

/// As much of a text as fits into a tile.
std::string fitting(std::string text, double height) {
  while (!text.empty() && Canvas::text_width(height, text) > kTile - 8) {
    text.pop_back();
  }
  return text;
}

std::string in_one_line(const std::string& text) {
  std::string line;
  for (const char c : text) {
    line += c == '\n' ? "" : std::string(1, c);
  }
  return line;
}

void draw_visit(const PlaceVisit& visit,
                std::size_t number,
                const PlaceOptions& options,
                const Tile& tile,
                Canvas* canvas) {
  draw_grid(visit.lpm, tile, canvas);
  draw_axis(visit, options, tile, canvas);
  const std::vector<Gateway>& gateways = visit.neighbourhood.gateways;
  for (std::size_t i = 0; i < gateways.size(); ++i) {
    draw_gateway(gateways[i], kGateway,
                 std::to_string(i) + " " + fixed(gateways[i].width_m, 1) + "/" +
                     fixed(gateways[i].seen_beyond_m, 1),
                 tile, canvas);
  }
  draw_robot(visit.T_place_robot_at_entry, tile, canvas);
  draw_robot(visit.T_place_robot_at_exit, tile, canvas);
  const clients::Pen ink{{0, 0, 0}, 1.1};
  canvas->text({tile.left + 4, tile.top + kTile + 14}, kHeight,
               fitting("visit " + std::to_string(number) + ", in by " +
                           std::to_string(visit.arrival_gateway) + ", out by " +
                           std::to_string(visit.departure_gateway) + ", distinct " +
                           fixed(visit.neighbourhood.distinctiveness, 2),
                       kHeight),
               ink);
  canvas->text({tile.left + 4, tile.top + kTile + 30}, kStarHeight,
               fitting(in_one_line(small_scale_text(visit.neighbourhood.star, 0)), kStarHeight),
               ink);
}

Tile tile_of(const PlaceVisit& visit, std::size_t i, std::size_t columns) {
  const GridGeometry& geometry = visit.lpm.geometry();
  const Vector2d size = geometry.cell_m * Vector2d(geometry.width, geometry.height);
  Tile tile;
  tile.left = static_cast<double>((i % columns) * kTile);
  tile.top = static_cast<double>((i / columns) * (kTile + kCaption));
  const double side_m = std::max(1.0, size.maxCoeff());
  tile.pixels_per_m = kTile / side_m;
  tile.p_low = geometry.origin_m + 0.5 * size - Vector2d::Constant(0.5 * side_m);
  return tile;
}

}  // namespace

void draw_places(const std::vector<PlaceVisit>& visits,
                 const PlaceOptions& options,
                 const std::filesystem::path& png) {
  const std::size_t count = std::max<std::size_t>(1, visits.size());
  const auto columns =
      static_cast<std::size_t>(std::ceil(std::sqrt(1.2 * static_cast<double>(count))));
  const std::size_t rows = (count + columns - 1) / columns;
  Canvas canvas(static_cast<int>(columns) * kTile, static_cast<int>(rows) * (kTile + kCaption),
                {245, 246, 248});
  for (std::size_t i = 0; i < visits.size(); ++i) {
    draw_visit(visits[i], i, options, tile_of(visits[i], i, columns), &canvas);
  }
  clients::write_png(canvas, png);
}

}  // namespace cairn::lab
