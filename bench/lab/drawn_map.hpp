#pragma once

#include <string>
#include <vector>

#include "exact_search/exploration.hpp"

namespace cairn::lab {

/// A place as it is drawn.
struct DrawnPlace {
  std::string star;  ///< Its type.
  int slots = 0;
  std::vector<int> slot_of_gateway;  ///< Of all slots, clockwise from the same one for all.
  std::vector<int> path_of_gateway;  ///< Position in the list of paths.
  std::vector<bool> is_pending;      ///< By gateway.
};

struct DrawnLink {
  int from_place = 0;
  int from_gateway = 0;
  int to_place = 0;
  int to_gateway = 0;
  int path = 0;
};

/// Plain data of a map, for pictures. Places are numbered from the robot's on; gateways as in the
/// star that was seen when the robot first came to their place, as in the experience: the one of
/// arrival has the number that the step says.
struct DrawnMap {
  std::string title;
  std::vector<DrawnPlace> places;
  std::vector<DrawnLink> links;
  int path_count = 0;  ///< With those that have no link.
  int robot_place = 0;
  int robot_gateway = 0;  ///< By which it came in.
};

/// The map that a canonical code stands for.
/// @param seen the exploration that the map explains: where the stars are found
/// @pre the code was made from a map of that whole exploration
[[nodiscard]] DrawnMap drawn_map(const std::string& code,
                                 const Exploration& seen,
                                 const std::string& title);

}  // namespace cairn::lab
