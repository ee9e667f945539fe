#include <algorithm>
#include <cmath>
#include <cstdio>
#include <sstream>

#include "clients/cairn/drawing.hpp"
#include "clients/cairn/topology_files.hpp"
#include "clients/common/planar_pose.hpp"
#include "clients/common/text.hpp"

namespace cairn::clients {
namespace {

constexpr int kLongestSide = 1000;
constexpr int kFooter = 40;
constexpr int kLeastWidth = 240;

std::string hex(Colour colour) {
  char text[8];
  std::snprintf(text, sizeof text, "#%02x%02x%02x", colour.red, colour.green, colour.blue);
  return text;
}

bool is_drawable(PixelPoint p) {
  return std::isfinite(p.x) && std::isfinite(p.y);
}

std::string point(PixelPoint p) {
  return fixed(p.x, 1) + "," + fixed(p.y, 1);
}

std::string line(PixelPoint a, PixelPoint b, const std::string& attributes) {
  if (!is_drawable(a) || !is_drawable(b)) {
    return "";
  }
  return "  <line x1=\"" + fixed(a.x, 1) + "\" y1=\"" + fixed(a.y, 1) + "\" x2=\"" + fixed(b.x, 1) +
         "\" y2=\"" + fixed(b.y, 1) + "\" " + attributes + "/>\n";
}

std::string segment_svg(const Viewport& view,
                        const cairn_lcm::topology_t& topology,
                        const cairn_lcm::segment_t& segment) {
  std::string points;
  for (const MapPoint& p : course_of(topology, segment)) {
    const PixelPoint pixel = view.pixel(p.x_m, p.y_m);
    if (!is_drawable(pixel)) {
      return "";
    }
    points += (points.empty() ? "" : " ") + point(pixel);
  }
  if (points.empty()) {
    return "";
  }
  const std::int64_t path = path_of(topology, segment);
  return "  <polyline points=\"" + points + "\" fill=\"none\" stroke=\"" + hex(path_colour(path)) +
         "\" stroke-width=\"4\" stroke-linejoin=\"round\"" +
         (segment.is_broken != 0 ? " stroke-dasharray=\"6 5\"" : "") + "><title>" +
         (segment.is_broken != 0 ? "broken, " : "") + "path " + std::to_string(path) + ": place " +
         std::to_string(segment.from_place) + " gateway " + std::to_string(segment.from_gateway) +
         " to place " + std::to_string(segment.to_place) + " gateway " +
         std::to_string(segment.to_gateway) + ", " + fixed(segment.length_m, 1) +
         " m</title></polyline>\n";
}

std::string gateway_svg(const Viewport& view,
                        const cairn_lcm::place_t& place,
                        const cairn_lcm::gateway_t& gateway) {
  const PlanarPose middle = pose_of(place, gateway);
  const double half_m = std::clamp(gateway.width_m, 0.3, 4.0) / 2.0;
  const auto at = [&](double ahead_m, double left_m) {
    const PlanarPose p = compound(middle, {ahead_m, left_m, 0.0});
    return view.pixel(p.x_m, p.y_m);
  };
  const bool is_pending = gateway.is_pending != 0;
  const std::string stroke = "stroke=\"" + hex(is_pending ? kPendingColour : kGatewayColour) +
                             "\" class=\"" + (is_pending ? "pending" : "gateway") + "\"";
  std::string svg = line(at(0.0, -half_m), at(0.0, half_m), stroke + " stroke-width=\"3\"");
  if (is_pending) {
    svg += line(at(0.0, 0.0), at(kStubM, 0.0),
                stroke + " stroke-width=\"2\" stroke-dasharray=\"5 4\"");
  }
  return svg;
}

std::string place_svg(const Viewport& view, const cairn_lcm::place_t& place, bool is_here) {
  const PixelPoint centre = view.pixel(place.x_m, place.y_m);
  if (!is_drawable(centre)) {
    return "";
  }
  const std::string id = std::to_string(place.id);
  const double radius = std::max(13.0, 4.0 * static_cast<double>(id.size()) + 6.0);
  const std::string at = "cx=\"" + fixed(centre.x, 1) + "\" cy=\"" + fixed(centre.y, 1) + "\"";
  std::string svg = "  <g class=\"place\">\n    <title>place " + id +
                    (place.name.empty() ? "" : " " + xml_escaped(place.name)) + ": " +
                    xml_escaped(place.star) + "</title>\n";
  if (is_here) {
    svg += "    <circle " + at + " r=\"" + fixed(radius + 6.0, 1) + "\" fill=\"" +
           hex(kPlaceColour) + "\" opacity=\"0.35\"/>\n";
  }
  svg += "    <circle " + at + " r=\"" + fixed(radius, 1) + "\" fill=\"" + hex(kPlaceColour) +
         "\" stroke=\"#ffffff\" stroke-width=\"2\"/>\n    <text x=\"" + fixed(centre.x, 1) +
         "\" y=\"" + fixed(centre.y + 4.5, 1) + "\" fill=\"#ffffff\" font-weight=\"bold\">" + id +
         "</text>\n";
  if (!place.name.empty()) {
    svg += "    <text x=\"" + fixed(centre.x, 1) + "\" y=\"" + fixed(centre.y + radius + 15.0, 1) +
           "\" fill=\"" + hex(kInkColour) + "\">" + xml_escaped(place.name) + "</text>\n";
  }
  return svg + "  </g>\n";
}

std::string scale_bar_svg(const Viewport& view, int width) {
  const double bar_m = scale_bar_m(0.3 * width / view.pixels_per_m());
  const double right = 16.0 + bar_m * view.pixels_per_m();
  const double y = view.height() + kFooter / 2.0;
  const std::string ink = "stroke=\"" + hex(kInkColour) + "\" stroke-width=\"2\"";
  return line({16.0, y}, {right, y}, ink) + line({16.0, y - 5.0}, {16.0, y + 5.0}, ink) +
         line({right, y - 5.0}, {right, y + 5.0}, ink) + "  <text x=\"" + fixed(right + 8.0, 1) +
         "\" y=\"" + fixed(y + 4.5, 1) + "\" fill=\"" + hex(kInkColour) +
         "\" text-anchor=\"start\">" + length_text(bar_m) + "</text>\n";
}

}  // namespace

std::string topology_svg(const cairn_lcm::topology_t& topology) {
  MapLayers layers;
  layers.topology = topology;
  const Viewport view(layers, kLongestSide);
  const int width = std::max(view.width(), kLeastWidth);
  const int height = view.height() + kFooter;
  std::ostringstream svg;
  svg << "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      << "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" << width << "\" height=\"" << height
      << "\" viewBox=\"0 0 " << width << " " << height
      << "\" font-family=\"sans-serif\" font-size=\"13\" text-anchor=\"middle\">\n"
      << "  <title>cairn map " << topology.map_id << ", revision " << topology.revision
      << "</title>\n  <rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n";
  for (const cairn_lcm::segment_t& segment : topology.segments) {
    svg << segment_svg(view, topology, segment);
  }
  for (const cairn_lcm::place_t& place : topology.places) {
    for (const cairn_lcm::gateway_t& gateway : place.gateways) {
      svg << gateway_svg(view, place, gateway);
    }
  }
  for (const cairn_lcm::place_t& place : topology.places) {
    svg << place_svg(view, place, place.id == topology.at_place);
  }
  svg << scale_bar_svg(view, width) << "</svg>\n";
  return svg.str();
}

}  // namespace cairn::clients
