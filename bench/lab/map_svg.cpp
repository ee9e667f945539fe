#include <algorithm>
#include <cmath>
#include <sstream>

#include "bench/lab/map_files.hpp"
#include "bench/lab/map_layout.hpp"
#include "clients/common/text.hpp"

namespace cairn::lab {
namespace {

using Index = std::size_t;
using clients::fixed;

constexpr double kScale = 130.0;  // Pixels of a link.
constexpr double kMargin = 70.0;
constexpr double kHeader = 58.0;
constexpr double kRadius = 17.0;
constexpr double kStub = 44.0;

struct Pixel {
  double x = 0.0;
  double y = 0.0;
};

std::string text_of(Pixel p) {
  return fixed(p.x, 1) + "," + fixed(p.y, 1);
}

Pixel moved(Pixel from, double direction_rad, double distance) {
  return {from.x + distance * std::sin(direction_rad), from.y - distance * std::cos(direction_rad)};
}

/// Told apart by the golden angle, however many there are.
std::string colour(int path) {
  const double hue = std::fmod(137.508 * path + 210.0, 360.0);
  // As numbers of red, green and blue: not every viewer knows hsl().
  const auto part = [hue](double shift) {
    const double k = std::fmod(shift + hue / 30.0, 12.0);
    const double value = 0.42 - 0.34 * std::max(-1.0, std::min({k - 3.0, 9.0 - k, 1.0}));
    return fixed(255.0 * value, 0);
  };
  return "rgb(" + part(0.0) + "," + part(8.0) + "," + part(4.0) + ")";
}

std::string label(Pixel at, const std::string& attributes, const std::string& text) {
  return "<text x=\"" + fixed(at.x, 1) + "\" y=\"" + fixed(at.y, 1) + "\" " + attributes + ">" +
         clients::xml_escaped(text) + "</text>\n";
}

class Drawing {
 public:
  explicit Drawing(const DrawnMap& map) : map_(map), positions_(laid_out(map)) {
    for (const DrawnPosition& position : positions_) {
      left_ = std::min(left_, position.x);
      top_ = std::min(top_, position.y);
      right_ = std::max(right_, position.x);
      bottom_ = std::max(bottom_, position.y);
    }
  }

  std::string svg() {
    const double wanted = 8.7 * static_cast<double>(map_.title.size()) + 30.0;
    const double width = std::max({kScale * (right_ - left_) + 2.0 * kMargin, wanted, 560.0});
    const double height = kScale * (bottom_ - top_) + 2.0 * kMargin + kHeader;
    shift_ = (width - kScale * (right_ - left_)) / 2.0;
    out_ << "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" << fixed(width, 0)
         << "\" height=\"" << fixed(height, 0) << "\" font-family=\"sans-serif\">\n"
         << "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n"
         << label({14.0, 22.0}, "font-size=\"14\" font-weight=\"bold\"", map_.title)
         << label({14.0, 40.0}, "font-size=\"11\" fill=\"#555\"",
                  "Circles: places with number and type of star. Small numbers: gateways, as the "
                  "star has them.")
         << label({14.0, 55.0}, "font-size=\"11\" fill=\"#555\"",
                  "Colours: paths. Dashed: pending. Yellow: the robot and its heading.");
    for (const DrawnLink& link : map_.links) {
      draw(link);
    }
    for (Index place = 0; place < map_.places.size(); ++place) {
      draw_place(static_cast<int>(place));
    }
    out_ << "</svg>\n";
    return out_.str();
  }

 private:
  [[nodiscard]] Pixel pixel(int place) const {
    const DrawnPosition& at = positions_[static_cast<Index>(place)];
    return {shift_ + kScale * (at.x - left_), kHeader + kMargin + kScale * (at.y - top_)};
  }
  [[nodiscard]] double direction(int place, int gateway) const {
    return direction_rad(map_.places[static_cast<Index>(place)],
                         positions_[static_cast<Index>(place)].turned_rad, gateway);
  }

  /// Leaves both places as their stars say, so that the order around them is kept even where the
  /// map cannot be drawn with straight streets.
  void draw(const DrawnLink& link) {
    const Pixel a = pixel(link.from_place);
    const Pixel b = pixel(link.to_place);
    const double reach = 0.4 * std::max(std::hypot(b.x - a.x, b.y - a.y), 0.6 * kScale);
    const Pixel from = moved(a, direction(link.from_place, link.from_gateway), reach);
    const Pixel to = moved(b, direction(link.to_place, link.to_gateway), reach);
    out_ << "<path d=\"M" << text_of(a) << " C" << text_of(from) << " " << text_of(to) << " "
         << text_of(b) << "\" fill=\"none\" stroke=\"" << colour(link.path)
         << "\" stroke-width=\"5\"><title>path " << link.path << ": place " << link.from_place
         << " gateway " << link.from_gateway << " to place " << link.to_place << " gateway "
         << link.to_gateway << "</title></path>\n";
    const Pixel middle{(a.x + 3.0 * from.x + 3.0 * to.x + b.x) / 8.0,
                       (a.y + 3.0 * from.y + 3.0 * to.y + b.y) / 8.0};
    const std::string name = "path " + std::to_string(link.path);
    const double width = 6.2 * static_cast<double>(name.size()) + 4.0;
    out_ << "<rect x=\"" << fixed(middle.x - width / 2.0, 1) << "\" y=\""
         << fixed(middle.y - 7.0, 1) << "\" width=\"" << fixed(width, 1)
         << "\" height=\"14\" fill=\"white\"/>\n"
         << label({middle.x, middle.y + 4.0},
                  "font-size=\"11\" text-anchor=\"middle\" fill=\"" + colour(link.path) + "\"",
                  name);
  }

  void draw_gateway(int place, int gateway) {
    const DrawnPlace& drawn = map_.places[static_cast<Index>(place)];
    const double out = direction(place, gateway);
    const Pixel at = pixel(place);
    if (drawn.is_pending[static_cast<Index>(gateway)]) {
      const int path = drawn.path_of_gateway[static_cast<Index>(gateway)];
      out_ << "<path d=\"M" << text_of(moved(at, out, kRadius)) << " L"
           << text_of(moved(at, out, kStub)) << "\" stroke=\"" << colour(path)
           << "\" stroke-width=\"4\" stroke-dasharray=\"6 5\"><title>path " << path << ": gateway "
           << gateway << " of place " << place << " is pending</title></path>\n"
           << label({moved(at, out, kStub + 9.0).x, moved(at, out, kStub + 9.0).y + 5.0},
                    "font-size=\"13\" text-anchor=\"middle\" fill=\"#c81e78\"", "?");
    }
    // Beside the street, on its right as one leaves.
    const Pixel beside = moved(moved(at, out, kRadius + 8.0), out + 1.5708, 8.0);
    out_ << label({beside.x, beside.y + 3.0},
                  "font-size=\"9\" text-anchor=\"middle\" fill=\"#555\"", std::to_string(gateway));
  }

  void draw_place(int place) {
    const DrawnPlace& drawn = map_.places[static_cast<Index>(place)];
    const Pixel at = pixel(place);
    const bool is_robot = place == map_.robot_place;
    for (int gateway = 0; gateway < static_cast<int>(drawn.is_pending.size()); ++gateway) {
      draw_gateway(place, gateway);
    }
    out_ << "<circle cx=\"" << fixed(at.x, 1) << "\" cy=\"" << fixed(at.y, 1) << "\" r=\""
         << fixed(kRadius, 0) << "\" fill=\"" << (is_robot ? "#ffd75e" : "#f4f4f0")
         << "\" stroke=\"#333\" stroke-width=\"1.5\"><title>place " << place << ", star "
         << clients::xml_escaped(drawn.star) << (is_robot ? ", the robot is here" : "")
         << "</title></circle>\n";
    // A long name does not fit into the circle.
    const bool fits = drawn.star.size() <= 2;
    out_ << label({at.x, at.y + (fits ? -1.0 : 4.0)},
                  "font-size=\"12\" font-weight=\"bold\" text-anchor=\"middle\"",
                  std::to_string(place))
         << label({at.x, at.y + (fits ? 11.0 : kRadius + 11.0)},
                  "font-size=\"10\" text-anchor=\"middle\" fill=\"#444\"", drawn.star);
    if (is_robot) {
      draw_robot(at, direction(place, map_.robot_gateway) + 3.14159);
    }
  }

  /// An arrow head on the edge of the place, in the direction in which the robot came in.
  void draw_robot(Pixel at, double heading_rad) {
    out_ << "<path d=\"M" << text_of(moved(at, heading_rad, kRadius + 11.0)) << " L"
         << text_of(moved(at, heading_rad + 0.5, kRadius + 1.0)) << " L"
         << text_of(moved(at, heading_rad - 0.5, kRadius + 1.0))
         << " Z\" fill=\"#e0a000\" stroke=\"#333\"><title>the robot's heading</title></path>\n";
  }

  const DrawnMap& map_;
  std::vector<DrawnPosition> positions_;
  std::ostringstream out_;
  double left_ = 0.0;
  double top_ = 0.0;
  double right_ = 0.0;
  double bottom_ = 0.0;
  double shift_ = 0.0;
};

}  // namespace

std::string map_svg(const DrawnMap& map) {
  return Drawing(map).svg();
}

}  // namespace cairn::lab
