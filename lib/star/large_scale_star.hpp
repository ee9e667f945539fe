#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "star/star.hpp"

namespace cairn {

/// A distinctive state: the robot at the place, facing along a path in one direction.
struct Dstate {
  int path = 0;             ///< 1, 2, ... within the place: Pa1, Pa2, ...
  bool is_forward = true;   ///< The + direction of that path.
  bool terminates = false;  ///< The path ends at the place in this direction.
  std::size_t slot = 0;     ///< The slot of the small-scale star that it stands for.
  friend bool operator==(const Dstate&, const Dstate&) = default;
};

/// The local topology of a place in terms of large-scale space: its dstates ds1, ds2, ... in
/// clockwise order, one for each direction of each path.
///
/// Source: Kuipers et al., ICRA 2004, Sec. III-C, Fig. 3(f).
struct LargeScaleStar {
  std::vector<Dstate> dstates;
  friend bool operator==(const LargeScaleStar&, const LargeScaleStar&) = default;
};

/// Binds every path fragment to a path and defines a dstate for each direction.
/// @param first_slot the slot that becomes ds1
/// @pre star is valid, first_slot < star.slots.size()
[[nodiscard]] LargeScaleStar abstracted(const Star& star, std::size_t first_slot = 0);

/// The dstates a robot at one of them may take by the action "turn right": those met clockwise
/// before the opposite direction of its own path. "Turn left" gives the others (Sec. III-C).
/// @return positions in star.dstates, clockwise
/// @pre dstate < star.dstates.size()
[[nodiscard]] std::vector<std::size_t> right_of(const LargeScaleStar& star, std::size_t dstate);

/// As Fig. 3(f) prints it, one dstate a line: "((ds1, Pa1+),", a path that terminates in
/// parentheses:
/// "(ds3, (Pa3+)),".
[[nodiscard]] std::string to_text(const LargeScaleStar& star);

/// to_text(abstracted(star, first_slot))
[[nodiscard]] std::string large_scale_text(const Star& star, std::size_t first_slot);

}  // namespace cairn
