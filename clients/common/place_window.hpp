#pragma once

#include <cairn_lcm/perceived_place_t.hpp>

#include "clients/common/canvas.hpp"

namespace cairn::clients {

/// A square part of a picture that shows the surroundings of a place.
class Window {
 public:
  Window(const cairn_lcm::perceived_place_t& place, PixelPoint corner, double side);

  [[nodiscard]] PixelPoint at(double x_m, double y_m) const {
    return {corner_.x + (x_m - left_m_) * pixels_per_m_,
            corner_.y + side_ - (y_m - bottom_m_) * pixels_per_m_};
  }
  [[nodiscard]] bool contains(PixelPoint p) const {
    return p.x >= corner_.x && p.y >= corner_.y && p.x <= corner_.x + side_ &&
           p.y <= corner_.y + side_;
  }
  [[nodiscard]] double pixels_per_m() const { return pixels_per_m_; }
  [[nodiscard]] PixelPoint corner() const { return corner_; }
  [[nodiscard]] double side() const { return side_; }
  [[nodiscard]] double left_m() const { return left_m_; }
  [[nodiscard]] double bottom_m() const { return bottom_m_; }

 private:
  PixelPoint corner_;
  double side_;
  double pixels_per_m_ = 1.0;
  double left_m_ = 0.0;
  double bottom_m_ = 0.0;
};

/// Draws what was seen of a place into its window: local map, axis, paths, robot and openings but
/// for those outside of it.
/// @pre check_perceived_place(place)
void draw_window(const cairn_lcm::perceived_place_t& place, const Window& window, Canvas* canvas);
/// A bar of one metre in the lower left corner.
void draw_scale(const Window& window, Canvas* canvas);

/// Colour of an opening by its state.
[[nodiscard]] Colour opening_colour(const cairn_lcm::opening_t& opening);
/// Colour of a path fragment by its number.
[[nodiscard]] Colour fragment_colour(std::size_t i);
/// The bar across the end of a path.
void draw_end_bar(PixelPoint before, PixelPoint end, const Pen& pen, Canvas* canvas);

}  // namespace cairn::clients
