#pragma once

#include <string>

#include "place/gateway.hpp"
#include "place/passage.hpp"

namespace cairn {

/// What became of a way that leaves a place.
enum class OpeningState {
  kGateway,
  kUnsure,    ///< May be one: the place has readings with and without it.
  kRejected,  ///< Belongs to the place, or bounds it as a wall does.
  kUndecided  ///< Ends in unknown space: the place is not complete.
};

/// Why an opening is a gateway, or is not.
enum class OpeningReason {
  kDrivenThrough,    ///< Gateway: the robot has gone through it of late.
  kCutByMap,         ///< Gateway: its walls go on to the edge of the map.
  kSeenToEnd,        ///< Gateway: seen up to an end with walls all around.
  kWalledFar,        ///< Gateway: walls far enough behind it.
  kDoorway,          ///< So narrow that a door may close it; it takes driving through.
  kTooShallow,       ///< Walls were not seen far enough behind it.
  kTooWide,          ///< Far enough for a passage, but not for one so wide.
  kFan,              ///< Far enough, but mostly not between walls: glass, or a fan of beams.
  kNotBetweenWalls,  ///< An end of the line is at no wall: the narrow end of a wedge that is known.
  kTooClose,         ///< Cannot be told by its bearing from another one, which was kept.
  kBlindAlcove,      ///< Ends at walls before it narrows.
  kUnknownBehind,    ///< Ends in unknown space before it narrows.
  kNotKept,          ///< What was judged at the visit is not known any more.
};

/// A way out of a place as it was looked at, with the figures that decided. Coordinates in the
/// frame that the holder names.
struct ConsideredOpening {
  /// Where the way never narrows: no width, all points at the end of what is known of it.
  Gateway line;
  OpeningState state = OpeningState::kRejected;
  OpeningReason reason = OpeningReason::kBlindAlcove;
  Passage behind;         ///< What was seen behind the line.
  double needed_m = 0.0;  ///< Way along walls that makes one so wide a gateway.
  double log_odds = 0.0;  ///< ln p(passage) - ln p(no passage) of what is between walls.
};

/// Of the way along walls behind it the share with walls on both sides, [0, 1]; 0 without any.
[[nodiscard]] double wall_share(const ConsideredOpening& opening);

/// "gateway", "unsure", "rejected", "undecided".
[[nodiscard]] std::string to_string(OpeningState state);

/// Why, for people, with the figures: "walls seen 2.1 m behind it, 4.0 needed".
[[nodiscard]] std::string why(const ConsideredOpening& opening);

}  // namespace cairn
