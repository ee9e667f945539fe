#pragma once

#include <filesystem>
#include <string>

#include <cairn_lcm/assertions_t.hpp>
#include <cairn_lcm/grid_map_t.hpp>
#include <cairn_lcm/hypotheses_t.hpp>
#include <cairn_lcm/hypothesis_map_t.hpp>
#include <cairn_lcm/perceived_place_t.hpp>
#include <cairn_lcm/status_t.hpp>
#include <cairn_lcm/topology_t.hpp>
#include <cairn_lcm/trajectory_t.hpp>
#include <cairn_lcm/visit_places_t.hpp>

namespace cairn::clients {

// A building to draw and to ask about: a loop of corridors 16 m by 10 m with four crossings (places
// 1 to 4), and a dead-end arm to the east of place 2 with a room at its end (place 5, "Büro &
// Lab"). Place 4 has a pending gateway to the west.
[[nodiscard]] cairn_lcm::grid_map_t sample_grid();
[[nodiscard]] cairn_lcm::topology_t sample_topology();
[[nodiscard]] cairn_lcm::hypotheses_t sample_hypotheses();
/// Of hypothesis 8, which has the fifth place called "annexe".
[[nodiscard]] cairn_lcm::hypothesis_map_t sample_hypothesis_map();
/// Two, the first taken back.
[[nodiscard]] cairn_lcm::assertions_t sample_assertions();
[[nodiscard]] cairn_lcm::trajectory_t sample_trajectory();
[[nodiscard]] cairn_lcm::status_t sample_status();
/// Six visits, to the places 1 to 5 and to place 1 once more.
[[nodiscard]] cairn_lcm::visit_places_t sample_visits();
/// What was seen there: the gateways of the place, and an alcove that is none.
[[nodiscard]] cairn_lcm::perceived_place_t sample_perceived(std::int64_t visit);

/// Writes the sample as a map file of format 2, with three visits in the journal.
void write_sample_map(const std::filesystem::path& path);

}  // namespace cairn::clients
