#pragma once

#include <cstdint>
#include <vector>

#include <cairn_lcm/perceived_place_t.hpp>
#include <cairn_lcm/topology_t.hpp>
#include <cairn_lcm/visit_places_t.hpp>

#include "clients/common/map_source.hpp"

namespace cairn::clients {

/// For each place of the map, in their order, what was seen at the visit whose reading the map
/// shows: the one with the map's gateways; failing that the first visit. Shows its progress. Throws
/// Failure as the source does.
[[nodiscard]] std::vector<cairn_lcm::perceived_place_t> shown_visits(
    MapSource& source, const cairn_lcm::topology_t& topology);

/// What was seen at every visit to a place of the map, in the order of visits.
[[nodiscard]] std::vector<cairn_lcm::perceived_place_t> all_visits(MapSource& source);

/// Whether what was seen has the gateways that the map gives the place, in the place's frame.
[[nodiscard]] bool is_shown_by(const cairn_lcm::place_t& place,
                               const cairn_lcm::perceived_place_t& perceived);

}  // namespace cairn::clients
