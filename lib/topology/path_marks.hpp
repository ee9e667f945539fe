#pragma once

#include <cstdint>
#include <vector>

#include "topology/working_map.hpp"

namespace cairn {

/// How the paths of two pending gateways lie to each other, and so what linking them would do.
enum class PathMeeting : std::uint8_t {
  kSharePlace,  ///< The joined path would pass a place twice: against the axiom.
  kTwice,       ///< It would meet another path twice.
  kTriangle,    ///< It would form a triangle with two paths that meet.
  kApart,       ///< Neither.
};

/// Tells how the path of one pending gateway lies to those of others. The first is marked once for
/// all of them. Cost: the lengths of the two paths, and of all paths that cross them.
///
/// Paths are chains of linked fragments; one-way gateways end them.
class PathMarks {
 public:
  explicit PathMarks(const WorkingMap& map) : map_(&map) {}

  /// Marks the path that ends at `departure`. The map must not change until the last meeting().
  void depart(GatewayIndex departure);
  /// @param with_crossings false: looks for shared places only, else returns kApart
  [[nodiscard]] PathMeeting meeting(GatewayIndex target, bool with_crossings);

 private:
  void mark_crossings();

  const WorkingMap* map_;
  GatewayIndex departure_ = kNoGateway;
  std::uint64_t now_ = 0;
  bool crossings_marked_ = false;
  std::vector<std::uint64_t> on_path_;  // By place: when it was marked last.
  std::vector<std::uint64_t> on_crossing_;
};

/// The next place of a path: the gateway by which a traveller enters it who goes straight on from
/// `entry` across its place. kNoGateway where the path ends; a one-way gateway ends it too.
[[nodiscard]] inline GatewayIndex next_entry(const WorkingMap& map, GatewayIndex entry) {
  const GatewayIndex onward = map.through(entry);
  if (onward == kNoGateway) {
    return kNoGateway;
  }
  const GatewayIndex end = map.leads_to(onward);
  return end != kNoGateway && map.leads_to(end) == onward ? end : kNoGateway;
}

/// Whether a link between the two would close a path to a ring. @pre both are pending
[[nodiscard]] inline bool are_ends_of_one_path(const WorkingMap& map,
                                               GatewayIndex a,
                                               GatewayIndex b) {
  GatewayIndex onward = map.through(a);
  while (onward != kNoGateway && !map.is_pending(onward) && map.is_linked(onward)) {
    onward = map.through(map.leads_to(onward));
  }
  return onward == b;
}

}  // namespace cairn
