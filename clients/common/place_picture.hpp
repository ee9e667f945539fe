#pragma once

#include <string>
#include <vector>

#include <cairn_lcm/perceived_place_t.hpp>

#include "clients/common/canvas.hpp"

namespace cairn::clients {

/// What stands above the picture of a place besides what was seen.
struct PlaceCaption {
  std::string name;  ///< Of the place; empty: none.
};

/// What was seen of a place at one visit, for a person to judge: the local map with its medial
/// axis; gateways with number, width and direction, those that are not sure dashed; what was no
/// gateway, dashed and lettered; path fragments as curves, a bar where a path ends; the robot at
/// entry and exit. Below it, why each opening is a gateway or none, and the star. 900 pixels wide.
///
/// Throws Failure(kBadData) for a message whose numbers do not fit together.
[[nodiscard]] Canvas draw_perceived_place(const cairn_lcm::perceived_place_t& place,
                                          const PlaceCaption& caption);

/// Many visits on one sheet, the maps alone, in tiles.
[[nodiscard]] Canvas draw_place_sheet(const std::vector<cairn_lcm::perceived_place_t>& places);

}  // namespace cairn::clients
