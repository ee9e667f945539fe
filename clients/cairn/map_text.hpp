#pragma once

#include <ostream>

#include <cairn_lcm/hypotheses_t.hpp>
#include <cairn_lcm/plan_t.hpp>
#include <cairn_lcm/status_t.hpp>
#include <cairn_lcm/topology_t.hpp>

namespace cairn::clients {

// What people read on a terminal. Names from the bus or a file are made safe to print.

void print_status(std::ostream& out, const cairn_lcm::status_t& status);
/// One row a place. A gateway shows as "0>5" where it leads to place 5, "1?" where nobody knows,
/// "2!5" where a travel led to place 5 that the map does not explain.
void print_places(std::ostream& out, const cairn_lcm::topology_t& topology);
/// One row a hypothesis, and whether every consistent map is still among them.
void print_hypotheses(std::ostream& out, const cairn_lcm::hypotheses_t& hypotheses);
void print_plan(std::ostream& out, const cairn_lcm::plan_t& plan);

/// "kept: …", or since which visit it is given up, and why.
[[nodiscard]] std::string guarantee_text(std::int64_t given_up_at, const std::string& reason);

}  // namespace cairn::clients
