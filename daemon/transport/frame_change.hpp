#pragma once

#include <optional>

#include <cairn_lcm/frame_change_t.hpp>

#include "service/map_state.hpp"
#include "transport/map_messages.hpp"

namespace cairn {

/// How a newer picture of the map has moved against an older one; nothing where neither the robot
/// nor a place moved by as much as 2 cm or 0.005 rad. Places are the same where they were first
/// seen with the same scan, whatever their numbers.
[[nodiscard]] std::optional<cairn_lcm::frame_change_t> to_frame_change(const MapState& older,
                                                                       const MapState& newer,
                                                                       const Sender& sender);

}  // namespace cairn
