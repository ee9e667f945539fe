#pragma once

#include <string>

#include "bench/lab/drawn_map.hpp"

namespace cairn::lab {

/// The map for Graphviz: places with their stars, links in the colours of their paths, pending
/// gateways as dashed stubs.
[[nodiscard]] std::string map_dot(const DrawnMap& map);

/// The map as GraphML: gateway numbers, clockwise as in their stars, and paths kept; every place
/// says which of its gateways are pending.
[[nodiscard]] std::string map_graphml(const DrawnMap& map);

/// The map as a drawing that keeps the order of gateways around their places: paths in colours and
/// with numbers, pending gateways as dashed stubs, the robot where it is, a key.
[[nodiscard]] std::string map_svg(const DrawnMap& map);

/// In quotes, what is special escaped.
[[nodiscard]] std::string dot_quoted(const std::string& text);

}  // namespace cairn::lab
