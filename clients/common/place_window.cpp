#include "clients/common/place_window.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "clients/common/perceived_place.hpp"
#include "clients/common/text.hpp"

namespace cairn::clients {
namespace {

using cairn_lcm::opening_t;
using cairn_lcm::perceived_place_t;

constexpr double kLetters = 10.0;
constexpr Colour kPaper{245, 246, 248};
constexpr Colour kFree{255, 255, 255};
constexpr Colour kUnknown{214, 217, 221};
constexpr Colour kWall{60, 62, 66};
constexpr Colour kAxis{120, 160, 225};
constexpr Colour kInk{30, 34, 40};
constexpr Colour kRobot{150, 30, 130};
constexpr Colour kSure{20, 130, 60};
constexpr Colour kUnsure{225, 120, 0};
constexpr Colour kRejected{190, 50, 60};
constexpr Colour kUndecided{120, 80, 190};
constexpr std::array<Colour, 6> kPaths{
    {{0, 90, 180}, {160, 90, 20}, {0, 130, 140}, {120, 60, 160}, {90, 120, 20}, {180, 60, 110}}};

Colour cell_colour(const perceived_place_t& place, double x_m, double y_m) {
  const auto x = static_cast<int>(std::floor((x_m - place.origin_x_m) / place.cell_m));
  const auto y = static_cast<int>(std::floor((y_m - place.origin_y_m) / place.cell_m));
  if (x < 0 || y < 0 || x >= place.width || y >= place.height) {
    return kPaper;
  }
  const std::size_t i = static_cast<std::size_t>(y) * static_cast<std::size_t>(place.width) +
                        static_cast<std::size_t>(x);
  const std::uint8_t cell = place.cells[i];
  return cell > 100 ? kUnknown : cell > 50 ? kWall : kFree;
}

void draw_grid(const perceived_place_t& place, const Window& window, Canvas* canvas) {
  const auto left = static_cast<int>(window.corner().x);
  const auto top = static_cast<int>(window.corner().y);
  const auto side = static_cast<int>(window.side());
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const double x_m = window.left_m() + (x + 0.5) / window.pixels_per_m();
      const double y_m = window.bottom_m() + (side - y - 0.5) / window.pixels_per_m();
      canvas->set(left + x, top + y, cell_colour(place, x_m, y_m));
    }
  }
}

void draw_axis(const perceived_place_t& place, const Window& window, Canvas* canvas) {
  std::size_t next = 0;
  for (const std::int32_t count : place.axis_line_points) {
    std::vector<PixelPoint> line;
    for (std::int32_t i = 0; i < count; ++i, ++next) {
      line.push_back(window.at(static_cast<double>(place.axis_x_m[next]),
                               static_cast<double>(place.axis_y_m[next])));
    }
    canvas->polyline(line, {.colour = kAxis, .width_pixels = 1.6});
  }
}

void label(PixelPoint middle, const std::string& text, Colour colour, Canvas* canvas) {
  const double width = Canvas::text_width(kLetters, text);
  const PixelPoint base{middle.x - width / 2.0, middle.y + kLetters / 2.0};
  canvas->rectangle({base.x - 3.0, base.y - kLetters - 3.0}, {base.x + width + 3.0, base.y + 3.0},
                    {255, 255, 255}, 0.85);
  canvas->text(base, kLetters, text, {.colour = colour, .width_pixels = 1.5});
}

/// A label that stays within the window.
PixelPoint within(const Window& window, PixelPoint p) {
  constexpr double kMargin = 34.0;
  return {std::clamp(p.x, window.corner().x + kMargin, window.corner().x + window.side() - kMargin),
          std::clamp(p.y, window.corner().y + 14.0, window.corner().y + window.side() - 14.0)};
}

void draw_opening(const perceived_place_t& place,
                  std::size_t i,
                  const Window& window,
                  Canvas* canvas) {
  const opening_t& opening = place.openings[i];
  const Colour colour = opening_colour(opening);
  const bool is_gateway = opening.state == opening_t::GATEWAY;
  const bool is_in_star = opening.gateway >= 0;
  const PixelPoint middle = window.at(opening.x_m, opening.y_m);
  if (!window.contains(middle)) {
    return;
  }
  const auto ahead = [&](double pixels) {
    return PixelPoint{middle.x + pixels * std::cos(opening.bearing_rad),
                      middle.y - pixels * std::sin(opening.bearing_rad)};
  };
  if (opening.width_m > 0.0) {
    canvas->line(window.at(opening.ends_m[0], opening.ends_m[1]),
                 window.at(opening.ends_m[2], opening.ends_m[3]),
                 {.colour = colour,
                  .width_pixels = is_in_star ? 3.5 : 2.0,
                  .dash_pixels = is_gateway ? 0.0 : 6.0});
  } else {
    canvas->disc(middle, 5.0, colour);
  }
  if (is_in_star) {
    const double tip = 20.0;
    canvas->line(middle, ahead(tip), {.colour = colour, .width_pixels = 2.0});
    for (const double turn_rad : {2.6, -2.6}) {
      const double bearing_rad = opening.bearing_rad + turn_rad;
      const PixelPoint end = ahead(tip);
      canvas->line(end, {end.x + 8.0 * std::cos(bearing_rad), end.y - 8.0 * std::sin(bearing_rad)},
                   {.colour = colour, .width_pixels = 2.0});
    }
  }
  std::string text = opening_label(place, i);
  text += is_in_star ? ": " + fixed(opening.width_m, 1) + " m" : "";
  label(within(window,
               ahead(is_in_star ? 38.0 + 26.0 * std::abs(std::cos(opening.bearing_rad)) : 16.0)),
        text, colour, canvas);
}

void draw_fragment(const perceived_place_t& place,
                   std::size_t i,
                   const Window& window,
                   Canvas* canvas) {
  const Pen pen{.colour = fragment_colour(i), .width_pixels = 3.0, .opacity = 0.8};
  std::vector<PixelPoint> line;
  for (const PlacePoint& p : fragment_course(place, i)) {
    line.push_back(window.at(p.x_m, p.y_m));
  }
  canvas->polyline(line, pen);
  if (line.size() > 1 && place.fragment_through[i] < 0) {
    draw_end_bar(line[line.size() - 2], line.back(), pen, canvas);
  }
}

void draw_robot(const double* pose_m_rad, const char* name, const Window& window, Canvas* canvas) {
  const PixelPoint at = window.at(pose_m_rad[0], pose_m_rad[1]);
  const PixelPoint nose{at.x + 14.0 * std::cos(pose_m_rad[2]),
                        at.y - 14.0 * std::sin(pose_m_rad[2])};
  canvas->disc(at, 6.0, kRobot);
  canvas->line(at, nose, {.colour = kRobot, .width_pixels = 2.5});
  label(within(window, {at.x, at.y + 18.0}), name, kRobot, canvas);
}

}  // namespace

Window::Window(const perceived_place_t& place, PixelPoint corner, double side)
    : corner_(corner), side_(side) {
  const double width_m = place.width * place.cell_m;
  const double height_m = place.height * place.cell_m;
  const double side_m = std::max({1.0, width_m, height_m});
  pixels_per_m_ = side / side_m;
  left_m_ = place.origin_x_m + 0.5 * (width_m - side_m);
  bottom_m_ = place.origin_y_m + 0.5 * (height_m - side_m);
}

void draw_window(const perceived_place_t& place, const Window& window, Canvas* canvas) {
  draw_grid(place, window, canvas);
  draw_axis(place, window, canvas);
  for (std::size_t i = 0; i < place.fragment_from.size(); ++i) {
    draw_fragment(place, i, window, canvas);
  }
  for (std::size_t i = 0; i < place.openings.size(); ++i) {
    draw_opening(place, i, window, canvas);
  }
  draw_robot(place.entry_m_rad, "in", window, canvas);
  draw_robot(place.exit_m_rad, place.departure_gateway < 0 ? "here" : "out", window, canvas);
}

void draw_scale(const Window& window, Canvas* canvas) {
  const PixelPoint left{window.corner().x + 14.0, window.corner().y + window.side() - 14.0};
  const PixelPoint right{left.x + window.pixels_per_m(), left.y};
  canvas->line(left, right, {.colour = kInk, .width_pixels = 3.0});
  canvas->text({right.x + 6.0, right.y + 4.0}, kLetters, "1 m",
               {.colour = kInk, .width_pixels = 1.4});
}

void draw_end_bar(PixelPoint before, PixelPoint end, const Pen& pen, Canvas* canvas) {
  constexpr double kHalfBar = 9.0;
  const double length = std::hypot(end.x - before.x, end.y - before.y);
  if (length > 0.0) {
    const double dx = kHalfBar * (end.y - before.y) / length;
    const double dy = -kHalfBar * (end.x - before.x) / length;
    canvas->line({end.x - dx, end.y - dy}, {end.x + dx, end.y + dy}, pen);
  }
}

Colour opening_colour(const opening_t& opening) {
  return opening.state == opening_t::GATEWAY     ? kSure
         : opening.state == opening_t::UNSURE    ? kUnsure
         : opening.state == opening_t::UNDECIDED ? kUndecided
                                                 : kRejected;
}

Colour fragment_colour(std::size_t i) {
  return kPaths[i % kPaths.size()];
}

}  // namespace cairn::clients
