#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "star/star.hpp"

namespace cairn {

/// The names that Fig. 3 of Kuipers et al., ICRA 2004 gives to what a star holds when it is read
/// clockwise from one of its slots: fragments and gateways are counted from 1 in the order in which
/// they come, and a fragment's + direction is the one that comes first.
struct SlotNames {
  std::vector<int> fragment;  ///< By slot: 1, 2, ... of PF1, PF2, ... (and of Pa1, Pa2, ...).
  std::vector<bool> is_plus;  ///< By slot: whether it is the + direction of its fragment.
  std::vector<int> gateway;   ///< By gateway: 1, 2, ... of gw1, gw2, ...
};

/// @pre star is valid, first_slot < star.slots.size()
[[nodiscard]] SlotNames names_from(const Star& star, std::size_t first_slot);

/// The small-scale star as Fig. 3(e) of Kuipers et al., ICRA 2004 prints it, one tuple a line:
///
///     ((PF1+, (gw1,out) & (gw4,in), MIDLINE),
///     (PF2+, (gw2,out), MIDLINE),
///     ...
///
/// @param first_slot where the reading begins
/// @pre star is valid, first_slot < star.slots.size()
[[nodiscard]] std::string small_scale_text(const Star& star, std::size_t first_slot);

}  // namespace cairn
