#include <algorithm>
#include <array>
#include <cstdio>
#include <sstream>

#include "clients/cairn/drawing.hpp"
#include "clients/cairn/topology_files.hpp"
#include "clients/common/text.hpp"

namespace cairn::clients {
namespace {

std::string dot_quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : printable(text)) {
    result += c == '"' || c == '\\' ? std::string("\\") + c : std::string(1, c);
  }
  return result + "\"";
}

int num_pending(const cairn_lcm::place_t& place) {
  int count = 0;
  for (const cairn_lcm::gateway_t& gateway : place.gateways) {
    count += gateway.is_pending != 0 ? 1 : 0;
  }
  return count;
}

// GraphML wants every attribute declared: its key, of what, and its type.
struct Attribute {
  const char* name;
  const char* of;
  const char* type;
};
constexpr std::array<Attribute, 14> kAttributes{{{"name", "node", "string"},
                                                 {"x_m", "node", "double"},
                                                 {"y_m", "node", "double"},
                                                 {"theta_rad", "node", "double"},
                                                 {"star", "node", "string"},
                                                 {"num_visits", "node", "int"},
                                                 {"num_gateways", "node", "int"},
                                                 {"num_pending", "node", "int"},
                                                 {"from_gateway", "edge", "int"},
                                                 {"to_gateway", "edge", "int"},
                                                 {"path_id", "edge", "long"},
                                                 {"length_m", "edge", "double"},
                                                 {"num_travels", "edge", "int"},
                                                 {"is_broken", "edge", "boolean"}}};

std::string datum(const char* key, const std::string& value) {
  return "      <data key=\"" + std::string(key) + "\">" + xml_escaped(value) + "</data>\n";
}

std::string node(const cairn_lcm::place_t& place) {
  return "    <node id=\"p" + std::to_string(place.id) + "\">\n" + datum("name", place.name) +
         datum("x_m", fixed(place.x_m, 6)) + datum("y_m", fixed(place.y_m, 6)) +
         datum("theta_rad", fixed(place.theta_rad, 6)) + datum("star", place.star) +
         datum("num_visits", std::to_string(place.num_visits)) +
         datum("num_gateways", std::to_string(place.gateways.size())) +
         datum("num_pending", std::to_string(num_pending(place))) + "    </node>\n";
}

std::string edge(const cairn_lcm::topology_t& topology, const cairn_lcm::segment_t& segment) {
  return "    <edge source=\"p" + std::to_string(segment.from_place) + "\" target=\"p" +
         std::to_string(segment.to_place) + "\">\n" +
         datum("from_gateway", std::to_string(segment.from_gateway)) +
         datum("to_gateway", std::to_string(segment.to_gateway)) +
         datum("path_id", std::to_string(path_of(topology, segment))) +
         datum("length_m", fixed(segment.length_m, 6)) +
         datum("num_travels", std::to_string(segment.num_travels)) +
         datum("is_broken", segment.is_broken != 0 ? "true" : "false") + "    </edge>\n";
}

// An edge to a place that is not listed would make a file that no reader takes.
bool has_both_ends(const cairn_lcm::topology_t& topology, const cairn_lcm::segment_t& segment) {
  return find_place(topology, segment.from_place) != nullptr &&
         find_place(topology, segment.to_place) != nullptr;
}

std::string stamp_text(std::int64_t utime) {
  // In whole numbers: a double would lose microseconds of today's dates.
  const std::uint64_t size =
      utime < 0 ? 0 - static_cast<std::uint64_t>(utime) : static_cast<std::uint64_t>(utime);
  char stamp[40];
  std::snprintf(stamp, sizeof stamp, "%s%llu.%06llu", utime < 0 ? "-" : "",
                static_cast<unsigned long long>(size / 1'000'000),
                static_cast<unsigned long long>(size % 1'000'000));
  return stamp;
}

}  // namespace

std::string topology_dot(const cairn_lcm::topology_t& topology) {
  std::ostringstream dot;
  dot << "graph cairn {\n  node [shape=circle];\n";
  for (const cairn_lcm::place_t& place : topology.places) {
    const std::string label =
        std::to_string(place.id) + (place.name.empty() ? "" : " " + place.name);
    dot << "  " << place.id << " [label=" << dot_quoted(label)
        << ", tooltip=" << dot_quoted(place.star) << ", pos=\"" << fixed(72.0 * place.x_m, 2) << ","
        << fixed(72.0 * place.y_m, 2) << "!\"];\n";
  }
  for (const cairn_lcm::segment_t& segment : topology.segments) {
    if (has_both_ends(topology, segment)) {
      dot << "  " << segment.from_place << " -- " << segment.to_place << " [taillabel=\""
          << segment.from_gateway << "\", headlabel=\"" << segment.to_gateway << "\", label=\""
          << fixed(segment.length_m, 1)
          << (segment.is_broken != 0 ? " m, broken\", style=dashed" : " m\"") << "];\n";
    }
  }
  dot << "}\n";
  return dot.str();
}

std::string topology_graphml(const cairn_lcm::topology_t& topology) {
  std::ostringstream xml;
  xml << "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      << "<graphml xmlns=\"http://graphml.graphdrawing.org/xmlns\">\n";
  for (const Attribute& attribute : kAttributes) {
    xml << "  <key id=\"" << attribute.name << "\" for=\"" << attribute.of << "\" attr.name=\""
        << attribute.name << "\" attr.type=\"" << attribute.type << "\"/>\n";
  }
  xml << "  <graph id=\"map" << topology.map_id << "\" edgedefault=\"undirected\">\n";
  for (const cairn_lcm::place_t& place : topology.places) {
    xml << node(place);
  }
  for (const cairn_lcm::segment_t& segment : topology.segments) {
    if (has_both_ends(topology, segment)) {
      xml << edge(topology, segment);
    }
  }
  xml << "  </graph>\n</graphml>\n";
  return xml.str();
}

std::string trajectory_text(const cairn_lcm::trajectory_t& trajectory) {
  std::string text;
  for (std::size_t i = 0; i < trajectory.pose_utime.size(); ++i) {
    text += stamp_text(trajectory.pose_utime[i]) + " " + fixed(trajectory.x_m[i], 9) + " " +
            fixed(trajectory.y_m[i], 9) + " " + fixed(trajectory.theta_rad[i], 9) + "\n";
  }
  return text;
}

std::string covariances_text(const cairn_lcm::trajectory_t& trajectory) {
  constexpr std::size_t kEntries = 6;
  std::string text = "# t xx xy yy x-theta y-theta theta-theta\n";
  const std::size_t whole = trajectory.covariance_m2_rad2.size() / kEntries;
  for (std::size_t i = 0; i < std::min(trajectory.key_utime.size(), whole); ++i) {
    text += stamp_text(trajectory.key_utime[i]);
    for (std::size_t k = 0; k < kEntries; ++k) {
      text += " " + fixed(trajectory.covariance_m2_rad2[kEntries * i + k], 12);
    }
    text += "\n";
  }
  return text;
}

}  // namespace cairn::clients
