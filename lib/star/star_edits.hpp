#pragma once

#include <optional>

#include "star/star.hpp"

namespace cairn {

/// What is seen of the place by one who overlooks the gateway: its slot is a terminated end
/// (control law kDeadEnd), or is gone together with its partner where the fragment has no other
/// gateway. The other gateways stay in their order and are numbered anew: those after the gateway
/// one lower. A crossing becomes a T; a T without its stem a corridor, without an arm a corner.
/// @return nothing if it is the only gateway
/// @pre star is valid and has the gateway
[[nodiscard]] std::optional<Star> without_gateway(const Star& star, int gateway);

/// The star with one more gateway, which terminates at the place: it gets this number, those from
/// there on one more. Its terminated end is put opposite.
/// @pre star is valid; 0 <= number <= gateway_count(star)
[[nodiscard]] Star with_gateway(const Star& star, int number);

/// The same star with its slots listed, and its gateways numbered, clockwise from this gateway on.
/// @pre star is valid and has the gateway
[[nodiscard]] Star rotated_to(const Star& star, int first_gateway);

}  // namespace cairn
