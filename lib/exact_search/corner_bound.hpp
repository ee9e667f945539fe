#pragma once

#include <cstdint>
#include <vector>

#include "exact_search/observed_walk.hpp"
#include "topology/working_map.hpp"

namespace cairn {

/// How many further corners (places of type L) the unfinished faces of a planar and qualitatively
/// perpendicular map need at least.
///
/// Call a corner a gap between clockwise neighbouring gateways of one place that belong to
/// different fragments. A closed planar map of dead-end-free 4-slot stars and plain corridors has
/// 2 nL - 8 corners more than four per face, and a perpendicular one has four or more on every
/// face. A face with C corners so far and m pending gateways will be cut into faces that have C - 2
/// m - 4 + 2 l corners above four in all, l being the places of type L that are added inside. None
/// of them may have fewer than four, and a stretch of w corners between two pending gateways stays
/// together, so
///
///     need = max(0, ceil((sum over stretches of max(0, w - 4) + 4 + 2 m - C) / 2)).
///
/// Every ring member carries the corners of the stretch to the next one.
class CornerBound {
 public:
  CornerBound(const WorkingMap& map, const ObservedWalk& walk) : map_(&map), walk_(&walk) {}

  /// @pre the map is the one place at which the robot starts
  void start();
  /// Further corners needed by a map of one place.
  [[nodiscard]] int need_at_start() const;

  /// Looks at the face of a pending gateway; what follows refers to it until the map changes.
  void survey(GatewayIndex departure);
  /// Whether linking departure with the ring member `position` places after it leaves no finished
  /// face with fewer than four corners.
  [[nodiscard]] bool finishes_no_small_face(int position) const;
  /// By how much the need grows over all faces.
  [[nodiscard]] int growth_by_link(int position) const;
  [[nodiscard]] int growth_by_place(StarId star, int arrival_gateway) const;

  /// To the next ring member. @pre at is pending
  [[nodiscard]] int corners_after(GatewayIndex at) const {
    return corners_[static_cast<std::size_t>(at)];
  }

  /// Before the map applies the change (kPlace or kLink only).
  void apply(const MapChange& change);
  /// After the map has taken the change back.
  void undo(const MapChange& change);

 private:
  struct Ring {
    int pending = 0;
    int corners = 0;
    int excess = 0;  ///< Sum over stretches of what is above four.
    [[nodiscard]] int need() const;
  };
  [[nodiscard]] std::int32_t& after(GatewayIndex at) {
    return corners_[static_cast<std::size_t>(at)];
  }
  [[nodiscard]] int stretch(int position) const {
    return stretches_[static_cast<std::size_t>(position)];
  }
  [[nodiscard]] int excess_between(int first, int last) const;

  const WorkingMap* map_;
  const ObservedWalk* walk_;
  std::vector<std::int32_t> corners_;  // By gateway: to the next ring member.
  Ring ring_;
  std::vector<int> stretches_;       // From the departing gateway on.
  std::vector<int> corners_before_;  // Sums over the stretches before a position.
  std::vector<int> excess_before_;
};

}  // namespace cairn
