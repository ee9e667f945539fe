#pragma once

#include <string>

#include <cairn_lcm/topology_t.hpp>
#include <cairn_lcm/trajectory_t.hpp>

namespace cairn::clients {

/// The map as a drawing to scale: places with their star as tooltip, paths in colours, gateways,
/// pending ones as dashed stubs, a scale bar. Well-formed XML whatever the names hold.
[[nodiscard]] std::string topology_svg(const cairn_lcm::topology_t& topology);

/// The map for Graphviz, places at their positions (neato -n).
[[nodiscard]] std::string topology_dot(const cairn_lcm::topology_t& topology);

/// The map as GraphML: undirected edges, positions in metres, number and order of gateways kept.
[[nodiscard]] std::string topology_graphml(const cairn_lcm::topology_t& topology);

/// Lines `t x y theta`: seconds with six decimals as the scans were stamped, metres, radians in the
/// global frame.
[[nodiscard]] std::string trajectory_text(const cairn_lcm::trajectory_t& trajectory);

/// Lines `t xx xy yy x-theta y-theta theta-theta`, in m^2, m rad and rad^2, at the key scans of the
/// trajectory: how sure the poses are, as against the first of them.
[[nodiscard]] std::string covariances_text(const cairn_lcm::trajectory_t& trajectory);

}  // namespace cairn::clients
