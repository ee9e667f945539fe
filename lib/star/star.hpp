#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "base/result.hpp"

namespace cairn {

/// How to travel away from a place along a directed path fragment (Kuipers et al., ICRA 2004,
/// Sec. III-C, step 1). kDeadEnd: further travel is blocked. kNone: no control law applies.
enum class ControlLaw { kMidline, kLeftWall, kRightWall, kDeadEnd, kNone };

/// One directed path fragment of a star. Its opposite direction is the partner slot.
struct StarSlot {
  /// Number of the gateway through which this direction leaves the place; -1 where the fragment
  /// terminates at the place in this direction.
  int gateway = -1;
  std::size_t partner = 0;  ///< Slot of the same fragment's other direction.
  ControlLaw law = ControlLaw::kMidline;
  friend bool operator==(const StarSlot&, const StarSlot&) = default;
};

/// The local topology of a place: its directed path fragments in clockwise order, terminated ends
/// included. Gateways are numbered 0, 1, ... clockwise: in the order of the slots that leave.
///
/// Source: Kuipers et al., ICRA 2004, Sec. III-C (small-scale star, Fig. 3(e)). As both ends of
/// each fragment are listed, left and right can be told without angles.
struct Star {
  std::vector<StarSlot> slots;
  friend bool operator==(const Star&, const Star&) = default;
};

/// Whether the star is one of a place: at least one gateway; gateways numbered 0, 1, ... in the
/// order of the slots; every slot has another one as its partner, and each is the other's; no
/// fragment without a gateway. Control laws are not looked at.
///
/// Everything below needs a valid star.
Status validate(const Star& star);

[[nodiscard]] int gateway_count(const Star& star);

/// @pre 0 <= gateway < gateway_count(star)
[[nodiscard]] std::size_t slot_of_gateway(const Star& star, int gateway);

/// The gateway through which a traveller who came in by this one goes straight on; nothing where
/// the fragment terminates at the place.
/// @pre 0 <= gateway < gateway_count(star)
[[nodiscard]] std::optional<int> through_partner(const Star& star, int gateway);

/// As the papers print it: MIDLINE, LEFTWALL, RIGHTWALL, DEADEND, NONE.
[[nodiscard]] std::string_view name_of(ControlLaw law);

}  // namespace cairn
