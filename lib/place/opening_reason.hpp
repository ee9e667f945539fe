#pragma once

#include "place/opening.hpp"
#include "place/place_options.hpp"

namespace cairn {

/// Of the depth of a passage of which there is no doubt, as much was seen between walls.
inline constexpr double kPlainWallShare = 0.7;

/// Why an opening between walls, which was not driven through, is a gateway or would need more.
/// @param is_plain whether there is no doubt that it is a passage
[[nodiscard]] OpeningReason reason_between_walls(const ConsideredOpening& opening,
                                                 bool is_plain,
                                                 const PlaceOptions& options);

}  // namespace cairn
