#include "place/opening.hpp"

#include <algorithm>
#include <array>
#include <cstdio>

#include "place/opening_reason.hpp"

namespace cairn {
namespace {

std::string metres(double length_m) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.1f", std::clamp(length_m, -1e6, 1e6));
  return text.data();
}

}  // namespace

double wall_share(const ConsideredOpening& opening) {
  const Passage& behind = opening.behind;
  return behind.along_wall_m > 0.0
             ? std::clamp(behind.between_walls_m / behind.along_wall_m, 0.0, 1.0)
             : 0.0;
}

OpeningReason reason_between_walls(const ConsideredOpening& opening,
                                   bool is_plain,
                                   const PlaceOptions& options) {
  if (opening.line.width_m < options.doorway_below_m) {
    return OpeningReason::kDoorway;
  }
  const Passage& behind = opening.behind;
  const bool is_far = behind.along_wall_m >= opening.needed_m;
  const bool is_walled = behind.between_walls_m >= kPlainWallShare * opening.needed_m;
  if (!is_plain) {
    return is_far                                           ? OpeningReason::kFan
           : behind.along_wall_m >= options.passage_depth_m ? OpeningReason::kTooWide
                                                            : OpeningReason::kTooShallow;
  }
  return is_far && is_walled                         ? OpeningReason::kWalledFar
         : behind.goes_beyond_map                    ? OpeningReason::kCutByMap
         : behind.to_end_m >= 0.5 * opening.needed_m ? OpeningReason::kSeenToEnd
                                                     : OpeningReason::kWalledFar;
}

std::string to_string(OpeningState state) {
  switch (state) {
    case OpeningState::kGateway:
      return "gateway";
    case OpeningState::kUnsure:
      return "unsure";
    case OpeningState::kUndecided:
      return "undecided";
    case OpeningState::kRejected:
      break;
  }
  return "rejected";
}

std::string why(const ConsideredOpening& opening) {
  const std::string seen = metres(opening.behind.along_wall_m);
  const std::string needed = metres(opening.needed_m);
  switch (opening.reason) {
    case OpeningReason::kDrivenThrough:
      return "driven through";
    case OpeningReason::kCutByMap:
      return "its walls go on to the map's edge";
    case OpeningReason::kSeenToEnd:
      return "seen to its end, " + metres(opening.behind.to_end_m) + " m behind it";
    case OpeningReason::kWalledFar:
      // Less than needed suffices for what was a gateway at the look before.
      return opening.behind.along_wall_m >= opening.needed_m
                 ? "walls seen " + seen + " m behind it, " + needed + " needed"
                 : "a gateway before, walls still seen " + seen + " m behind it";
    case OpeningReason::kDoorway:
      return "a doorway nobody drove through, seen " + seen + " m behind it";
    case OpeningReason::kTooShallow:
      return "walls seen only " + seen + " m behind it, " + needed + " needed";
    case OpeningReason::kTooWide:
      return "too wide: " + metres(opening.line.width_m) + " m across need " + needed +
             " m behind it, seen " + seen;
    case OpeningReason::kFan:
      return "glass or fan: walls on both sides for only " +
             metres(opening.behind.between_walls_m) + " of " + seen + " m";
    case OpeningReason::kNotBetweenWalls:
      return "not between two walls";
    case OpeningReason::kTooClose:
      return "too close to another in bearing";
    case OpeningReason::kUnknownBehind:
      return "ends in unknown space";
    case OpeningReason::kNotKept:
      return "no reason was kept";
    case OpeningReason::kBlindAlcove:
      break;
  }
  return "blind alcove";
}

}  // namespace cairn
