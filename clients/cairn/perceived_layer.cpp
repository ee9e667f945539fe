#include "clients/cairn/drawing.hpp"
#include "clients/cairn/perceived_visits.hpp"
#include "clients/common/perceived_place.hpp"
#include "clients/common/place_window.hpp"
#include "clients/common/planar_pose.hpp"
#include "clients/common/text.hpp"

namespace cairn::clients {
namespace {

constexpr Colour kAxisColour{120, 160, 225};
constexpr double kLabelPixels = 8.0;

/// What was seen of a place, where the map has it.
class PerceivedLayer {
 public:
  PerceivedLayer(Canvas& canvas,
                 const Viewport& view,
                 const cairn_lcm::place_t& place,
                 const cairn_lcm::perceived_place_t& perceived)
      : canvas_(canvas), view_(view), T_global_place_(pose_of(place)), perceived_(perceived) {}

  void draw_axis() {
    std::size_t next = 0;
    for (const std::int32_t count : perceived_.axis_line_points) {
      std::vector<PixelPoint> line;
      for (std::int32_t i = 0; i < count; ++i, ++next) {
        line.push_back(pixel(static_cast<double>(perceived_.axis_x_m[next]),
                             static_cast<double>(perceived_.axis_y_m[next])));
      }
      canvas_.polyline(line, {.colour = kAxisColour, .width_pixels = 1.4});
    }
  }

  void draw_fragment(std::size_t i) {
    const Pen pen{.colour = kPlaceColour, .width_pixels = 2.0, .opacity = 0.7};
    std::vector<PixelPoint> line;
    for (const PlacePoint& p : fragment_course(perceived_, i)) {
      line.push_back(pixel(p.x_m, p.y_m));
    }
    canvas_.polyline(line, pen);
    if (line.size() > 1 && perceived_.fragment_through[i] < 0) {
      draw_end_bar(line[line.size() - 2], line.back(), pen, &canvas_);
    }
  }

  void draw_opening(std::size_t i) {
    const cairn_lcm::opening_t& opening = perceived_.openings[i];
    const Colour colour = opening_colour(opening);
    const bool is_in_map = opening.gateway >= 0;
    if (!is_in_map && opening.width_m > 0.0) {
      canvas_.line(pixel(opening.ends_m[0], opening.ends_m[1]),
                   pixel(opening.ends_m[2], opening.ends_m[3]),
                   {.colour = colour, .width_pixels = 1.6, .dash_pixels = 4.0});
    }
    if (is_in_map) {
      const PlanarPose ahead =
          compound(T_global_place_,
                   compound({opening.x_m, opening.y_m, opening.bearing_rad}, {0.45, 0.45, 0.0}));
      label(view_.pixel(ahead.x_m, ahead.y_m),
            opening_label(perceived_, i) + ": " + fixed(opening.width_m, 1), colour);
    }
  }

 private:
  [[nodiscard]] PixelPoint pixel(double x_m, double y_m) const {
    const PlanarPose at = compound(T_global_place_, {x_m, y_m, 0.0});
    return view_.pixel(at.x_m, at.y_m);
  }

  void label(PixelPoint middle, const std::string& text, Colour colour) {
    const PixelPoint base{middle.x - Canvas::text_width(kLabelPixels, text) / 2.0,
                          middle.y + kLabelPixels / 2.0};
    canvas_.text(base, kLabelPixels, text,
                 {.colour = {255, 255, 255}, .width_pixels = 4.0, .opacity = 0.85});
    canvas_.text(base, kLabelPixels, text, {.colour = colour, .width_pixels = 1.3});
  }

  Canvas& canvas_;
  const Viewport& view_;
  PlanarPose T_global_place_;
  const cairn_lcm::perceived_place_t& perceived_;
};

}  // namespace

void draw_perceived(Canvas& canvas,
                    const Viewport& view,
                    const cairn_lcm::place_t& place,
                    const cairn_lcm::perceived_place_t& perceived) {
  check_perceived_place(perceived);
  if (!is_shown_by(place, perceived)) {
    return;
  }
  PerceivedLayer layer(canvas, view, place, perceived);
  layer.draw_axis();
  for (std::size_t i = 0; i < perceived.fragment_from.size(); ++i) {
    layer.draw_fragment(i);
  }
  for (std::size_t i = 0; i < perceived.openings.size(); ++i) {
    layer.draw_opening(i);
  }
}

}  // namespace cairn::clients
