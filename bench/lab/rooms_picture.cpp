#include "bench/lab/rooms_picture.hpp"

#include <array>
#include <cmath>

#include "clients/common/canvas.hpp"

namespace cairn::lab {
namespace {

using clients::Canvas;
using clients::Colour;
using clients::PixelPoint;

/// Pastel colours; hues a golden section apart, so that neighbours in number look different.
Colour colour_of(std::size_t region) {
  constexpr double kGoldenSection = 0.618033988749895;
  const double hue = std::fmod(kGoldenSection * static_cast<double>(region), 1.0);
  std::array<std::uint8_t, 3> rgb{};
  for (std::size_t i = 0; i < 3; ++i) {
    const double phase = hue - static_cast<double>(i) / 3.0;
    rgb[i] = static_cast<std::uint8_t>(std::lround(190.0 + 60.0 * std::cos(2.0 * kPi * phase)));
  }
  return {rgb[0], rgb[1], rgb[2]};
}

Colour colour_of(CellState state) {
  switch (state) {
    case CellState::kFree:
      return {255, 255, 255};
    case CellState::kOccupied:
      return {0, 0, 0};
    case CellState::kUnknown:
      break;
  }
  return {128, 128, 128};
}

PixelPoint at(const GridGeometry& geometry, Cell c) {
  return {c.x + 0.5, geometry.height - c.y - 0.5};
}

}  // namespace

void draw_regions(const OccupancyGrid& grid,
                  const RegionGraph& graph,
                  const std::filesystem::path& png) {
  const GridGeometry& geometry = grid.geometry();
  Canvas canvas(geometry.width, geometry.height, {255, 255, 255});
  for (int y = 0; y < geometry.height; ++y) {
    for (int x = 0; x < geometry.width; ++x) {
      const CellState state = grid.state({x, y});
      const std::int32_t region = graph.region_at({x, y});
      const bool is_in_region = region != RegionGraph::kNoRegion && state == CellState::kFree;
      canvas.set(x, geometry.height - 1 - y,
                 is_in_region ? colour_of(static_cast<std::size_t>(region)) : colour_of(state));
    }
  }
  for (const CriticalLine& line : graph.lines) {
    canvas.line(at(geometry, line.basis_points[0]), at(geometry, line.basis_points[1]),
                {{220, 0, 0}, 1.5});
    canvas.disc(at(geometry, line.critical_point), 2.0, {220, 0, 0});
  }
  for (const Region& region : graph.regions) {
    canvas.disc(at(geometry, region.centre), 2.5, {40, 40, 40});
  }
  clients::write_png(canvas, png);
}

}  // namespace cairn::lab
