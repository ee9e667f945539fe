#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace cairn::clients {

struct Colour {
  std::uint8_t red = 0;
  std::uint8_t green = 0;
  std::uint8_t blue = 0;

  friend bool operator==(const Colour&, const Colour&) = default;
};

/// A point of a picture in pixels: x to the right, y down; (0, 0) is the upper left corner of the
/// upper left pixel.
struct PixelPoint {
  double x = 0.0;
  double y = 0.0;
};

/// How a stroke looks.
struct Pen {
  Colour colour;
  double width_pixels = 1.0;
  double opacity = 1.0;      ///< [0, 1]
  double dash_pixels = 0.0;  ///< Length of dashes and of gaps; 0: one solid line.
};

/// An RGB picture with anti-aliased strokes, discs and text. Whatever lies outside is cut off; a
/// point that is not finite is not drawn.
class Canvas {
 public:
  /// @pre width and height are in [1, 32768]
  Canvas(int width, int height, Colour background);

  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  [[nodiscard]] Colour at(int x, int y) const { return pixels_[index(x, y)]; }
  void set(int x, int y, Colour colour) { pixels_[index(x, y)] = colour; }

  void line(PixelPoint from, PixelPoint to, const Pen& pen);
  void polyline(const std::vector<PixelPoint>& points, const Pen& pen);
  void disc(PixelPoint centre, double radius_pixels, Colour colour, double opacity = 1.0);
  void rectangle(PixelPoint corner, PixelPoint opposite, Colour colour, double opacity = 1.0);

  /// Text in strokes, beginning at the left end of the base line. Letters of Latin-1 lose their
  /// accents; what the font does not have shows as '?'.
  void text(PixelPoint base, double height_pixels, const std::string& text, const Pen& pen);
  /// Width of that text.
  [[nodiscard]] static double text_width(double height_pixels, const std::string& text);

 private:
  [[nodiscard]] std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(x);
  }
  void blend(int x, int y, Colour colour, double share);
  void stroke(PixelPoint from, PixelPoint to, const Pen& pen);

  int width_;
  int height_;
  std::vector<Colour> pixels_;
};

/// Writes a picture as PNG. Throws Failure(kCannotCreate) if the file cannot be written.
void write_png(const Canvas& canvas, const std::filesystem::path& path);

}  // namespace cairn::clients
