#include <algorithm>
#include <cmath>
#include <limits>

#include "clients/cairn/drawing.hpp"
#include "clients/common/planar_pose.hpp"
#include "clients/common/text.hpp"

namespace cairn::clients {
namespace {

constexpr double kFarthestM = 1e6;
constexpr double kMostPixelsPerM = 200.0;
constexpr double kLeastKnownM = 0.6;

struct Extent {
  double left_m = std::numeric_limits<double>::infinity();
  double bottom_m = std::numeric_limits<double>::infinity();
  double right_m = -std::numeric_limits<double>::infinity();
  double top_m = -std::numeric_limits<double>::infinity();

  void add(double x_m, double y_m) {
    if (std::abs(x_m) <= kFarthestM && std::abs(y_m) <= kFarthestM) {  // False for NaN too.
      left_m = std::min(left_m, x_m);
      right_m = std::max(right_m, x_m);
      bottom_m = std::min(bottom_m, y_m);
      top_m = std::max(top_m, y_m);
    }
  }
};

/// First and last of the rows, or columns, that hold enough to be shown.
struct Span {
  int first = 0;
  int last = 0;
};

// A few beams that went out through windows would make the building small: the picture leaves out
// margins in which less than kLeastKnownM of a row is known.
Span shown(const std::vector<int>& known_cells, double cell_m) {
  const auto is_enough = [cell_m](int cells) { return cells * cell_m >= kLeastKnownM; };
  const auto first = std::find_if(known_cells.begin(), known_cells.end(), is_enough);
  if (first == known_cells.end()) {
    return {0, static_cast<int>(known_cells.size()) - 1};
  }
  const auto last = std::find_if(known_cells.rbegin(), known_cells.rend(), is_enough);
  return {static_cast<int>(first - known_cells.begin()),
          static_cast<int>(known_cells.rend() - last) - 1};
}

void add_grid(const Raster& grid, Extent* extent) {
  std::vector<int> in_column(static_cast<std::size_t>(grid.width), 0);
  std::vector<int> in_row(static_cast<std::size_t>(grid.height), 0);
  for (int y = 0; y < grid.height; ++y) {
    for (int x = 0; x < grid.width; ++x) {
      const int is_known = grid.at(x, y) != kUnknownCell ? 1 : 0;
      in_column[static_cast<std::size_t>(x)] += is_known;
      in_row[static_cast<std::size_t>(y)] += is_known;
    }
  }
  const Span columns = shown(in_column, grid.cell_m);
  const Span rows = shown(in_row, grid.cell_m);
  extent->add(grid.origin_x_m + columns.first * grid.cell_m,
              grid.origin_y_m + rows.first * grid.cell_m);
  extent->add(grid.origin_x_m + (columns.last + 1) * grid.cell_m,
              grid.origin_y_m + (rows.last + 1) * grid.cell_m);
}

Extent extent_of(const MapLayers& layers) {
  Extent extent;
  if (layers.grid && layers.grid->width > 0) {
    add_grid(*layers.grid, &extent);
  }
  if (layers.topology) {
    for (const cairn_lcm::place_t& place : layers.topology->places) {
      extent.add(place.x_m, place.y_m);
      for (const cairn_lcm::gateway_t& gateway : place.gateways) {
        const double ahead_m = gateway.is_pending != 0 ? kStubM : 0.0;
        const PlanarPose end = compound(pose_of(place, gateway), {ahead_m, 0.0, 0.0});
        extent.add(end.x_m, end.y_m);
      }
    }
  }
  if (layers.trajectory) {
    for (std::size_t i = 0; i < layers.trajectory->x_m.size(); ++i) {
      extent.add(layers.trajectory->x_m[i], layers.trajectory->y_m[i]);
    }
  }
  if (extent.left_m > extent.right_m) {
    extent.add(0.0, 0.0);
  }
  return extent;
}

}  // namespace

Viewport::Viewport(const MapLayers& layers, int longest_side_pixels) {
  const Extent extent = extent_of(layers);
  const double longest_m =
      std::max({extent.right_m - extent.left_m, extent.top_m - extent.bottom_m, 1.0});
  const double margin_m = 0.06 * longest_m;
  left_m_ = extent.left_m - margin_m;
  top_m_ = extent.top_m + margin_m;
  pixels_per_m_ = std::min(kMostPixelsPerM, longest_side_pixels / (longest_m + 2.0 * margin_m));
  const auto pixels = [this, margin_m, longest_side_pixels](double length_m) {
    const double wanted = std::ceil((length_m + 2.0 * margin_m) * pixels_per_m_ - 1e-6);
    return static_cast<int>(std::clamp(wanted, 1.0, static_cast<double>(longest_side_pixels)));
  };
  width_ = pixels(extent.right_m - extent.left_m);
  height_ = pixels(extent.top_m - extent.bottom_m);
}

double scale_bar_m(double longest_m) {
  const double decade = std::pow(10.0, std::floor(std::log10(std::max(longest_m, 1e-3)) + 1e-9));
  for (const double factor : {5.0, 2.0}) {
    if (factor * decade <= longest_m) {
      return factor * decade;
    }
  }
  return decade;
}

std::string length_text(double length_m) {
  if (length_m >= 1000.0) {
    return fixed(length_m / 1000.0, 0) + " km";
  }
  return length_m >= 1.0 ? fixed(length_m, 0) + " m" : fixed(100.0 * length_m, 0) + " cm";
}

Colour path_colour(std::int64_t path_id) {
  // Steps of the golden angle around the circle of hues keep neighbours far apart.
  const double turns = 0.61 + 0.618033988749895 * static_cast<double>(path_id % 1'000'003);
  const double hue = 6.0 * (turns - std::floor(turns));
  const auto channel = [hue](double offset) {
    const double distance = std::abs(std::remainder(hue - offset, 6.0));
    const double saturated = std::clamp(2.0 - distance, 0.0, 1.0);
    return static_cast<std::uint8_t>(std::lround(255.0 * (0.20 + 0.50 * saturated)));
  };
  return {channel(0.0), channel(2.0), channel(4.0)};
}

const cairn_lcm::place_t* find_place(const cairn_lcm::topology_t& topology, std::int64_t id) {
  const auto place = std::find_if(topology.places.begin(), topology.places.end(),
                                  [id](const cairn_lcm::place_t& p) { return p.id == id; });
  return place == topology.places.end() ? nullptr : &*place;
}

namespace {

const cairn_lcm::gateway_t* find_gateway(const cairn_lcm::place_t* place, std::int32_t index) {
  const bool is_there =
      place != nullptr && index >= 0 && static_cast<std::size_t>(index) < place->gateways.size();
  return is_there ? &place->gateways[static_cast<std::size_t>(index)] : nullptr;
}

}  // namespace

std::vector<MapPoint> course_of(const cairn_lcm::topology_t& topology,
                                const cairn_lcm::segment_t& segment) {
  const cairn_lcm::place_t* from = find_place(topology, segment.from_place);
  const cairn_lcm::place_t* to = find_place(topology, segment.to_place);
  const cairn_lcm::gateway_t* out = find_gateway(from, segment.from_gateway);
  const cairn_lcm::gateway_t* in = find_gateway(to, segment.to_gateway);
  if (out == nullptr || in == nullptr) {
    return {};
  }
  const PlanarPose leaving = pose_of(*from, *out);
  const PlanarPose entering = pose_of(*to, *in);
  return {{from->x_m, from->y_m},
          {leaving.x_m, leaving.y_m},
          {entering.x_m, entering.y_m},
          {to->x_m, to->y_m}};
}

std::int64_t path_of(const cairn_lcm::topology_t& topology, const cairn_lcm::segment_t& segment) {
  const cairn_lcm::gateway_t* out =
      find_gateway(find_place(topology, segment.from_place), segment.from_gateway);
  return out == nullptr ? -1 : out->path_id;
}

}  // namespace cairn::clients
