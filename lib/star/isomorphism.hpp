#pragma once

#include <string>
#include <vector>

#include "star/star.hpp"

namespace cairn {

/// What a traveller who comes in by one gateway can tell about a place: for every slot, clockwise
/// from that gateway's, whether it leaves and how many slots further clockwise its partner lies.
/// Two gateways have equal codes exactly if they are alike.
using ViewCode = std::vector<int>;

/// @pre star is valid and has the gateway
[[nodiscard]] ViewCode view_code(const Star& star, int gateway);

/// Whether two local topologies look the same when each is entered by the given gateway: the test
/// (a) of matching views in Kuipers et al., ICRA 2004, Sec. III-D. Terminated ends count, so left
/// and right are told apart; control laws do not count.
/// @pre both stars are valid and have the gateways
[[nodiscard]] bool are_alike(const Star& star_a, int gateway_a, const Star& star_b, int gateway_b);

/// For every gateway the lowest gateway that looks the same on arrival (by a rotation of the star
/// onto itself): 0 0 0 0 for a crossing, 0 1 2 for a T.
/// @pre star is valid
[[nodiscard]] std::vector<int> view_classes(const Star& star);

/// A short name for people, equal exactly for stars that are rotations of one another: D dead end,
/// I corridor, L corner, T, +; any other star gets a code of its slots clockwise, `g` for one that
/// leaves and `x` for a terminated end, each with the distance to its partner: "g3x3g3x3g3x3".
/// @pre star is valid
[[nodiscard]] std::string type_name(const Star& star);

}  // namespace cairn
