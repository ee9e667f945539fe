#include "clients/common/canvas.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "clients/common/stroke_font.hpp"

namespace cairn::clients {
namespace {

constexpr double kFarthestPixel = 1e6;  // Keeps products of coordinates finite and exact enough.

bool is_drawable(PixelPoint p) {
  return std::abs(p.x) <= kFarthestPixel && std::abs(p.y) <= kFarthestPixel;  // False for NaN too.
}

// One character each: letters of Latin-1 without their accents, '?' for what the font does not
// have.
std::string in_ascii(const std::string& text) {
  static constexpr std::string_view kLatin1 =
      "AAAAAAACEEEEIIIIDNOOOOO*OUUUUYPsaaaaaaaceeeeiiiidnooooo/ouuuuypy";
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    const bool is_latin1 =
        byte == 0xC3 && i + 1 < text.size() && (static_cast<unsigned char>(text[i + 1]) >> 6U) == 2;
    if (is_latin1) {
      result += kLatin1[static_cast<unsigned char>(text[++i]) & 0x3FU];
    } else if (byte < 0x80) {
      result += text[i];
    } else if (byte >= 0xC0) {
      result += '?';
    }
  }
  return result;
}

double distance_to_segment(PixelPoint p, PixelPoint a, PixelPoint b) {
  const double dx = b.x - a.x;
  const double dy = b.y - a.y;
  const double length_squared = dx * dx + dy * dy;
  double along = 0.0;
  if (length_squared > 0.0) {
    along = std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / length_squared, 0.0, 1.0);
  }
  return std::hypot(p.x - (a.x + along * dx), p.y - (a.y + along * dy));
}

}  // namespace

Canvas::Canvas(int width, int height, Colour background)
    : width_(width),
      height_(height),
      pixels_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), background) {}

void Canvas::blend(int x, int y, Colour colour, double share) {
  const double s = std::clamp(share, 0.0, 1.0);
  const auto mixed = [s](std::uint8_t below, std::uint8_t above) {
    return static_cast<std::uint8_t>(std::lround((1.0 - s) * below + s * above));
  };
  Colour& pixel = pixels_[index(x, y)];
  pixel = {mixed(pixel.red, colour.red), mixed(pixel.green, colour.green),
           mixed(pixel.blue, colour.blue)};
}

// Row by row, only over the columns near the segment, so that a long slanting line costs its
// length.
void Canvas::stroke(PixelPoint from, PixelPoint to, const Pen& pen) {
  const double radius = pen.width_pixels / 2.0;
  const double reach = radius + 1.0;
  const int first_row = static_cast<int>(std::floor(std::max(0.0, std::min(from.y, to.y) - reach)));
  const int last_row =
      static_cast<int>(std::floor(std::min(height_ - 1.0, std::max(from.y, to.y) + reach)));
  const double slope = std::abs(to.y - from.y) > 1e-9 ? (to.x - from.x) / (to.y - from.y) : 0.0;
  const bool is_steep = std::abs(to.y - from.y) > 1e-9;
  for (int row = first_row; row <= last_row; ++row) {
    double left = std::min(from.x, to.x);
    double right = std::max(from.x, to.x);
    if (is_steep) {
      const double upper = from.x + (row - reach - from.y) * slope;
      const double lower = from.x + (row + 1.0 + reach - from.y) * slope;
      left = std::max(left, std::min(upper, lower));
      right = std::min(right, std::max(upper, lower));
    }
    const int first = static_cast<int>(std::floor(std::max(0.0, left - reach)));
    const int last = static_cast<int>(std::floor(std::min(width_ - 1.0, right + reach)));
    for (int column = first; column <= last; ++column) {
      const double distance = distance_to_segment({column + 0.5, row + 0.5}, from, to);
      const double coverage =
          std::clamp(radius + 0.5 - distance, 0.0, std::min(1.0, pen.width_pixels));
      if (coverage > 0.0) {
        blend(column, row, pen.colour, coverage * pen.opacity);
      }
    }
  }
}

void Canvas::line(PixelPoint from, PixelPoint to, const Pen& pen) {
  if (!is_drawable(from) || !is_drawable(to)) {
    return;
  }
  const double length = std::hypot(to.x - from.x, to.y - from.y);
  if (pen.dash_pixels <= 0.0 || length <= pen.dash_pixels) {
    stroke(from, to, pen);
    return;
  }
  const double dash = std::max(pen.dash_pixels, length / 10'000.0);
  for (double begin = 0.0; begin < length; begin += 2.0 * dash) {
    const double end = std::min(begin + dash, length);
    const auto at = [&](double s) {
      return PixelPoint{from.x + (to.x - from.x) * s / length,
                        from.y + (to.y - from.y) * s / length};
    };
    stroke(at(begin), at(end), pen);
  }
}

void Canvas::polyline(const std::vector<PixelPoint>& points, const Pen& pen) {
  for (std::size_t i = 1; i < points.size(); ++i) {
    line(points[i - 1], points[i], pen);
  }
}

void Canvas::disc(PixelPoint centre, double radius_pixels, Colour colour, double opacity) {
  line(centre, centre, {.colour = colour, .width_pixels = 2.0 * radius_pixels, .opacity = opacity});
}

void Canvas::rectangle(PixelPoint corner, PixelPoint opposite, Colour colour, double opacity) {
  if (!is_drawable(corner) || !is_drawable(opposite)) {
    return;
  }
  const auto pixel = [](double value, int limit) {
    return static_cast<int>(std::lround(std::clamp(value, 0.0, static_cast<double>(limit))));
  };
  const int right = pixel(std::max(corner.x, opposite.x), width_);
  const int bottom = pixel(std::max(corner.y, opposite.y), height_);
  for (int y = pixel(std::min(corner.y, opposite.y), height_); y < bottom; ++y) {
    for (int x = pixel(std::min(corner.x, opposite.x), width_); x < right; ++x) {
      blend(x, y, colour, opacity);
    }
  }
}

void Canvas::text(PixelPoint base, double height_pixels, const std::string& text, const Pen& pen) {
  const double unit = height_pixels / kGlyphHeight;
  double left = base.x;
  for (const char character : in_ascii(text)) {
    const std::string_view strokes = glyph(character);
    std::vector<PixelPoint> points;
    for (std::size_t i = 0; i < strokes.size(); i += 2) {
      if (strokes[i] == ' ') {
        polyline(points, pen);
        points.clear();
        ++i;
      }
      points.push_back(
          {left + (strokes[i] - '0') * unit, base.y - (strokes[i + 1] - '0' - kGlyphBase) * unit});
    }
    polyline(points, pen);
    left += kGlyphAdvance * unit;
  }
}

double Canvas::text_width(double height_pixels, const std::string& text) {
  const auto length = static_cast<double>(in_ascii(text).size());
  const double gap = kGlyphAdvance - 4.0;
  return length == 0.0 ? 0.0 : (length * kGlyphAdvance - gap) * height_pixels / kGlyphHeight;
}

}  // namespace cairn::clients
