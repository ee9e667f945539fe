#pragma once

#include <filesystem>
#include <iosfwd>
#include <vector>

#include "place/place_options.hpp"
#include "place/place_stay.hpp"

namespace cairn::lab {

/// Draws what was perceived of each visit, one tile beside the other. Throws
/// clients::Failure(kCannotCreate).
void draw_place_sheet(const std::vector<PlaceVisit>& visits,
                      const PlaceOptions& options,
                      const std::filesystem::path& png);

/// Draws each visit by itself, with why each opening is a gateway or none: visit-0.png and so on.
/// Makes the folder where there is none. Throws clients::Failure(kCannotCreate).
void draw_places(const std::vector<PlaceVisit>& visits,
                 const PlaceOptions& options,
                 const std::filesystem::path& folder);

}  // namespace cairn::lab
