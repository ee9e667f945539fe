#include "bench/lab/map_files.hpp"

#include <cmath>
#include <sstream>

#include "bench/lab/map_layout.hpp"
#include "bench/lab/text.hpp"
#include "clients/common/text.hpp"

namespace cairn::lab {
namespace {

using Index = std::size_t;
using clients::fixed;

/// Told apart by the golden angle, however many there are.
std::string dot_colour(int path) {
  const double hue = 0.618034 * path;
  return "\"" + fixed(hue - static_cast<int>(hue), 3) + " 0.85 0.70\"";
}

std::string pending_text(const DrawnPlace& place) {
  std::vector<std::size_t> pending;
  for (Index gateway = 0; gateway < place.is_pending.size(); ++gateway) {
    if (place.is_pending[gateway]) {
      pending.push_back(gateway);
    }
  }
  return joined(pending);
}

std::string datum(const char* key, const std::string& value) {
  return "      <data key=\"" + std::string(key) + "\">" + clients::xml_escaped(value) +
         "</data>\n";
}

std::string key(const char* name, const char* of, const char* type) {
  return "  <key id=\"" + std::string(name) + "\" for=\"" + of + "\" attr.name=\"" + name +
         "\" attr.type=\"" + type + "\"/>\n";
}

}  // namespace

std::string dot_quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '\n') {
      result += "\\n";
    } else {
      result += c == '"' || c == '\\' ? std::string("\\") + c : std::string(1, c);
    }
  }
  return result + "\"";
}

std::string map_dot(const DrawnMap& map) {
  const std::vector<DrawnPosition> positions = laid_out(map);
  std::ostringstream dot;
  dot << "// Positions are set: neato -n2 -Tpng\n"
      << "// Gateways are numbered as in the star seen first at their place.\ngraph map {\n  label="
      << dot_quoted(map.title) << ";\n  node [shape=circle, fontname=\"sans-serif\"];\n"
      << "  edge [penwidth=2, fontsize=9, fontname=\"sans-serif\"];\n";
  for (Index place = 0; place < map.places.size(); ++place) {
    const DrawnPlace& drawn = map.places[place];
    const bool is_robot = static_cast<int>(place) == map.robot_place;
    const std::string label = std::to_string(place) + "\n" + drawn.star;
    const double x = 100.0 * positions[place].x;
    const double y = -100.0 * positions[place].y;
    dot << "  p" << place << " [label=" << dot_quoted(label) << ", pos=\"" << fixed(x, 1) << ","
        << fixed(y, 1) << "\""
        << (is_robot ? ", style=filled, fillcolor=\"#ffe08a\", tooltip=\"the robot\"" : "")
        << "];\n";
    for (Index gateway = 0; gateway < drawn.is_pending.size(); ++gateway) {
      if (drawn.is_pending[gateway]) {
        const double direction =
            direction_rad(drawn, positions[place].turned_rad, static_cast<int>(gateway));
        dot << "  p" << place << "g" << gateway << " [label=\"?\", shape=none, pos=\""
            << fixed(x + 55.0 * std::sin(direction), 1) << ","
            << fixed(y + 55.0 * std::cos(direction), 1) << "\"];\n  p" << place << " -- p" << place
            << "g" << gateway << " [style=dashed, taillabel=\"" << gateway
            << "\", color=" << dot_colour(drawn.path_of_gateway[gateway]) << "];\n";
      }
    }
  }
  for (const DrawnLink& link : map.links) {
    dot << "  p" << link.from_place << " -- p" << link.to_place << " [taillabel=\""
        << link.from_gateway << "\", headlabel=\"" << link.to_gateway << "\", label=\"path "
        << link.path << "\", color=" << dot_colour(link.path) << "];\n";
  }
  dot << "}\n";
  return dot.str();
}

std::string map_graphml(const DrawnMap& map) {
  const std::vector<DrawnPosition> positions = laid_out(map);
  std::ostringstream xml;
  xml << "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      << "<!-- " << clients::xml_escaped(map.title)
      << ". Gateways are numbered as in the star seen first at their place; x to the right, y "
         "down, links about 1 long. -->\n"
      << "<graphml xmlns=\"http://graphml.graphdrawing.org/xmlns\">\n"
      << key("star", "node", "string") << key("num_gateways", "node", "int")
      << key("pending_gateways", "node", "string") << key("is_robot_here", "node", "boolean")
      << key("x", "node", "double") << key("y", "node", "double")
      << key("from_gateway", "edge", "int") << key("to_gateway", "edge", "int")
      << key("path", "edge", "int") << "  <graph id=\"map\" edgedefault=\"undirected\">\n";
  for (Index place = 0; place < map.places.size(); ++place) {
    const DrawnPlace& drawn = map.places[place];
    const bool is_robot = static_cast<int>(place) == map.robot_place;
    xml << "    <node id=\"p" << place << "\">\n"
        << datum("star", drawn.star)
        << datum("num_gateways", std::to_string(drawn.is_pending.size()))
        << datum("pending_gateways", pending_text(drawn))
        << datum("is_robot_here", is_robot ? "true" : "false")
        << datum("x", fixed(positions[place].x, 3)) << datum("y", fixed(positions[place].y, 3))
        << "    </node>\n";
  }
  for (const DrawnLink& link : map.links) {
    xml << "    <edge source=\"p" << link.from_place << "\" target=\"p" << link.to_place << "\">\n"
        << datum("from_gateway", std::to_string(link.from_gateway))
        << datum("to_gateway", std::to_string(link.to_gateway))
        << datum("path", std::to_string(link.path)) << "    </edge>\n";
  }
  xml << "  </graph>\n</graphml>\n";
  return xml.str();
}

}  // namespace cairn::lab
