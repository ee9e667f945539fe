#pragma once

#include <filesystem>
#include <vector>

#include "place/place_options.hpp"
#include "place/place_stay.hpp"

namespace cairn::lab {

/// Draws what was perceived of each visit, one tile beside the other: the local map, its medial
/// axis, the gateways with their width and how far the passage beyond was seen, the robot's entry
/// and exit, and the star in words. Throws clients::Failure(kCannotCreate).
void draw_places(const std::vector<PlaceVisit>& visits,
                 const PlaceOptions& options,
                 const std::filesystem::path& png);

}  // namespace cairn::lab
