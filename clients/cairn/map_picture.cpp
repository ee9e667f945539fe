#include <algorithm>
#include <cmath>
#include <string>

#include "clients/cairn/drawing.hpp"
#include "clients/common/planar_pose.hpp"
#include "clients/common/text.hpp"

namespace cairn::clients {
namespace {

constexpr Colour kUnknownColour{205, 208, 213};
constexpr Colour kFreeColour{255, 255, 255};
constexpr Colour kWallColour{20, 22, 26};
constexpr Colour kWhite{255, 255, 255};
constexpr int kFooterPixels = 48;
constexpr int kLeastWidth = 560;  ///< Room for the scale bar and the key.
constexpr double kDiscPixels = 12.0;
constexpr double kIdPixels = 9.0;
constexpr double kLabelPixels = 10.0;

Colour mix(Colour a, Colour b, double share) {
  const auto channel = [share](std::uint8_t from, std::uint8_t to) {
    return static_cast<std::uint8_t>(std::lround((1.0 - share) * from + share * to));
  };
  return {channel(a.red, b.red), channel(a.green, b.green), channel(a.blue, b.blue)};
}

/// Means over the cells that a pixel covers.
struct Cover {
  double unknown = 0.0;   ///< Share of cells.
  double darkness = 0.0;  ///< Of the known ones, white 0 to wall 1.
};

Cover cover_of(const Raster& grid, double x_m, double y_m, double pixel_m, int samples) {
  int unknown = 0;
  double sum = 0.0;
  double darkest = 0.0;
  for (int i = 0; i < samples * samples; ++i) {
    const double dx_m = ((i % samples) + 0.5) / samples * pixel_m;
    const double dy_m = ((i / samples) + 0.5) / samples * pixel_m;
    const auto cell =
        grid.at(static_cast<int>(std::floor((x_m + dx_m - grid.origin_x_m) / grid.cell_m)),
                static_cast<int>(std::floor((y_m - dy_m - grid.origin_y_m) / grid.cell_m)));
    if (cell == kUnknownCell) {
      ++unknown;
      continue;
    }
    const double darkness = std::clamp((cell - 25.0) / 40.0, 0.0, 1.0);
    sum += darkness;
    darkest = std::max(darkest, darkness);
  }
  const int known = samples * samples - unknown;
  if (known == 0) {
    return {1.0, 0.0};
  }
  // Where a pixel covers many cells a thin wall would fade: it counts for more than its area.
  const double emphasis = pixel_m > grid.cell_m ? 0.6 : 0.0;
  return {static_cast<double>(unknown) / (samples * samples),
          (1.0 - emphasis) * sum / known + emphasis * darkest};
}

void draw_grid(Canvas& canvas, const Viewport& view, const Raster& grid) {
  if (grid.width == 0) {
    return;
  }
  const double pixel_m = 1.0 / view.pixels_per_m();
  const int samples =
      static_cast<int>(std::clamp(std::ceil(2.0 * pixel_m / grid.cell_m), 2.0, 8.0));
  const PixelPoint corner =
      view.pixel(grid.origin_x_m, grid.origin_y_m + grid.height * grid.cell_m);
  const PixelPoint opposite =
      view.pixel(grid.origin_x_m + grid.width * grid.cell_m, grid.origin_y_m);
  const auto first = [](double pixel) { return std::max(0, static_cast<int>(std::floor(pixel))); };
  for (int y = first(corner.y); y < std::min<double>(view.height(), opposite.y); ++y) {
    for (int x = first(corner.x); x < std::min<double>(view.width(), opposite.x); ++x) {
      const Cover cover = cover_of(grid, view.x_m(x), view.y_m(y), pixel_m, samples);
      const Colour known = mix(kFreeColour, kWallColour, cover.darkness);
      canvas.set(x, y, mix(known, kUnknownColour, cover.unknown * (1.0 - cover.darkness)));
    }
  }
}

void draw_trajectory(Canvas& canvas,
                     const Viewport& view,
                     const cairn_lcm::trajectory_t& trajectory) {
  const Pen pen{.colour = kTrajectoryColour, .width_pixels = 1.2, .opacity = 0.6};
  for (std::size_t i = 1; i < trajectory.x_m.size(); ++i) {
    canvas.line(view.pixel(trajectory.x_m[i - 1], trajectory.y_m[i - 1]),
                view.pixel(trajectory.x_m[i], trajectory.y_m[i]), pen);
  }
}

void draw_segments(Canvas& canvas, const Viewport& view, const cairn_lcm::topology_t& topology) {
  for (const cairn_lcm::segment_t& segment : topology.segments) {
    std::vector<PixelPoint> course;
    for (const MapPoint& point : course_of(topology, segment)) {
      course.push_back(view.pixel(point.x_m, point.y_m));
    }
    const Colour colour = path_colour(path_of(topology, segment));
    canvas.polyline(
        course,
        {.colour = colour, .width_pixels = 3.5, .dash_pixels = segment.is_broken != 0 ? 6.0 : 0.0});
  }
}

bool has_broken_segment(const cairn_lcm::topology_t& topology) {
  return std::any_of(topology.segments.begin(), topology.segments.end(),
                     [](const cairn_lcm::segment_t& segment) { return segment.is_broken != 0; });
}

void draw_gateway(Canvas& canvas,
                  const Viewport& view,
                  const PlanarPose& middle,
                  const cairn_lcm::gateway_t& gateway) {
  const bool is_pending = gateway.is_pending != 0;
  const double half_m = std::clamp(gateway.width_m, 0.3, 4.0) / 2.0;
  const auto at = [&](double ahead_m, double left_m) {
    const PlanarPose p = compound(middle, {ahead_m, left_m, 0.0});
    return view.pixel(p.x_m, p.y_m);
  };
  const Colour colour = is_pending ? kPendingColour : kGatewayColour;
  canvas.line(at(0.0, -half_m), at(0.0, half_m), {.colour = colour, .width_pixels = 3.0});
  if (is_pending) {
    canvas.line(at(0.0, 0.0), at(kStubM, 0.0),
                {.colour = colour, .width_pixels = 2.0, .dash_pixels = 4.0});
  }
}

void text_with_halo(Canvas& canvas, PixelPoint base, double height, const std::string& text) {
  canvas.text(base, height, text, {.colour = kWhite, .width_pixels = 4.5, .opacity = 0.85});
  canvas.text(base, height, text, {.colour = kInkColour, .width_pixels = 1.5});
}

void draw_place(Canvas& canvas,
                const Viewport& view,
                const cairn_lcm::place_t& place,
                bool is_here) {
  const PixelPoint centre = view.pixel(place.x_m, place.y_m);
  const std::string id = std::to_string(place.id);
  const double id_width = Canvas::text_width(kIdPixels, id);
  const double radius = std::max(kDiscPixels, id_width / 2.0 + 4.5);
  if (is_here) {
    canvas.disc(centre, radius + 6.0, kPlaceColour, 0.35);
  }
  canvas.disc(centre, radius + 2.0, kWhite);
  canvas.disc(centre, radius, kPlaceColour);
  canvas.text({centre.x - id_width / 2.0, centre.y + kIdPixels / 2.0}, kIdPixels, id,
              {.colour = kWhite, .width_pixels = 1.7});
  if (!place.name.empty()) {
    const double width = Canvas::text_width(kLabelPixels, place.name);
    text_with_halo(canvas, {centre.x - width / 2.0, centre.y + radius + kLabelPixels + 6.0},
                   kLabelPixels, place.name);
  }
}

void draw_topology(Canvas& canvas, const Viewport& view, const cairn_lcm::topology_t& topology) {
  draw_segments(canvas, view, topology);
  for (const cairn_lcm::place_t& place : topology.places) {
    for (const cairn_lcm::gateway_t& gateway : place.gateways) {
      draw_gateway(canvas, view, pose_of(place, gateway), gateway);
    }
  }
  for (const cairn_lcm::place_t& place : topology.places) {
    draw_place(canvas, view, place, place.id == topology.at_place);
  }
}

/// Writes the key from the left to the right.
class Key {
 public:
  Key(Canvas& canvas, PixelPoint at) : canvas_(canvas), at_(at) {}

  void stroke(const std::string& text, const Pen& pen) {
    canvas_.line(at_, {at_.x + 22.0, at_.y}, pen);
    label(at_.x + 30.0, text);
  }
  void disc(const std::string& text, Colour colour) {
    canvas_.disc({at_.x + 7.0, at_.y}, 7.0, colour);
    label(at_.x + 22.0, text);
  }

 private:
  void label(double x, const std::string& text) {
    canvas_.text({x, at_.y + kLabelPixels / 2.0}, kLabelPixels, text,
                 {.colour = kInkColour, .width_pixels = 1.3});
    at_.x = x + Canvas::text_width(kLabelPixels, text) + 26.0;
  }

  Canvas& canvas_;
  PixelPoint at_;
};

void draw_footer(Canvas& canvas, const Viewport& view, const MapLayers& layers) {
  const double top = canvas.height() - kFooterPixels;
  canvas.rectangle({0.0, top}, {static_cast<double>(canvas.width()), top + kFooterPixels},
                   {247, 248, 250});
  canvas.line({0.0, top}, {static_cast<double>(canvas.width()), top},
              {.colour = {190, 194, 200}, .width_pixels = 1.0});
  const double bar_m = scale_bar_m(0.2 * canvas.width() / view.pixels_per_m());
  const double bar = bar_m * view.pixels_per_m();
  const double y = top + kFooterPixels / 2.0;
  const Pen ink{.colour = kInkColour, .width_pixels = 2.0};
  canvas.line({16.0, y}, {16.0 + bar, y}, ink);
  canvas.line({16.0, y - 5.0}, {16.0, y + 5.0}, ink);
  canvas.line({16.0 + bar, y - 5.0}, {16.0 + bar, y + 5.0}, ink);
  const std::string length = length_text(bar_m);
  canvas.text({24.0 + bar, y + kLabelPixels / 2.0}, kLabelPixels, length,
              {.colour = kInkColour, .width_pixels = 1.3});

  Key key(canvas, {24.0 + bar + Canvas::text_width(kLabelPixels, length) + 36.0, y});
  if (layers.topology) {
    key.disc("place", kPlaceColour);
    key.stroke("path", {.colour = path_colour(0), .width_pixels = 3.5});
    if (has_broken_segment(*layers.topology)) {
      key.stroke("one way", {.colour = path_colour(0), .width_pixels = 3.5, .dash_pixels = 6.0});
    }
    key.stroke("gateway", {.colour = kGatewayColour, .width_pixels = 3.0});
    key.stroke("pending", {.colour = kPendingColour, .width_pixels = 2.5, .dash_pixels = 4.0});
  }
  if (layers.trajectory) {
    key.stroke("way", {.colour = kTrajectoryColour, .width_pixels = 1.5});
  }
}

}  // namespace

Canvas draw_map(const MapLayers& layers, int longest_side_pixels) {
  const Viewport view(layers, longest_side_pixels);
  Canvas canvas(std::max(view.width(), std::min(kLeastWidth, longest_side_pixels)),
                view.height() + kFooterPixels, layers.grid ? kUnknownColour : kWhite);
  if (layers.grid) {
    draw_grid(canvas, view, *layers.grid);
  }
  if (layers.trajectory) {
    draw_trajectory(canvas, view, *layers.trajectory);
  }
  if (layers.topology) {
    for (const cairn_lcm::perceived_place_t& perceived : layers.perceived) {
      if (const auto* const place = find_place(*layers.topology, perceived.place_id)) {
        draw_perceived(canvas, view, *place, perceived);
      }
    }
    draw_topology(canvas, view, *layers.topology);
  }
  draw_footer(canvas, view, layers);
  return canvas;
}

}  // namespace cairn::clients
