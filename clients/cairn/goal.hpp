#pragma once

#include <optional>
#include <string>

#include <cairn_lcm/place_ref_t.hpp>
#include <cairn_lcm/plan_request_t.hpp>

namespace cairn::clients {

/// Where to go, as typed: a number is a place; `X,Y` or `X,Y,THETA_DEG` a pose in the global frame;
/// everything else the name of a place. Nothing for an empty text, or numbers that are not finite.
[[nodiscard]] std::optional<cairn_lcm::plan_request_t> parse_goal(const std::string& text);

/// A place, as typed: a number; `visit:N`, the place of that visit; everything else a name. Nothing
/// for an empty text, or a number that is negative or too large.
[[nodiscard]] std::optional<cairn_lcm::place_ref_t> parse_place(const std::string& text);

}  // namespace cairn::clients
