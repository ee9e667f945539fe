#pragma once

#include <cstdint>
#include <vector>

#include "exact_search/corner_bound.hpp"
#include "exact_search/look_ahead.hpp"
#include "exact_search/observed_walk.hpp"
#include "exact_search/quadrangulation.hpp"
#include "topology/working_map.hpp"

namespace cairn {

/// Tells which planar maps cannot be without pending gateways at the end of a known experience,
/// face by face: what is pending on a face must be linked within it, to each other or to places
/// that are added there.
///
/// Views that are never joined by a travel, not even through others, belong to different groups;
/// links stay within a group. So
/// - a place of a kind that has an odd number of gateways in a group is needed on every face where
///   that group's number is odd;
/// - a group whose fragments neither end nor leave the group cannot begin on a face that has none
///   of it: its paths would be circular;
/// - where all faces must have four corners, a face that links alone cannot finish
/// (Quadrangulation)
///   needs a place.
/// LookAhead bounds how many places of each kind can still be added.
class FaceLookAhead {
 public:
  FaceLookAhead(const WorkingMap& map,
                const ObservedWalk& walk,
                const LookAhead& look_ahead,
                const CornerBound& bound);

  /// @param corners_left how many places of type L may still be added
  /// @param quadrangles whether every face must have four corners in the end
  [[nodiscard]] bool allows(int corners_left, bool quadrangles);

 private:
  using Groups = std::uint64_t;  // A bit each; more than 64 groups share bits, which is sound.
  /// Stars that are rotations of each other.
  struct Kind {
    StarId star;
    Groups groups = 0;
    Groups odd = 0;     ///< Groups of which it has an odd number of gateways.
    Groups begins = 0;  ///< Groups that a fragment ends in, or leaves.
    int room = 0;       ///< How many places of it can still be added.
  };
  /// Of all faces whose pending gateways are of the same groups.
  struct Demand {
    Groups present = 0;
    int places_left = 0;      ///< Places that can still be added to such faces.
    int odd_places_left = 0;  ///< Those that change whether a group's number is odd.
  };

  void group_views();
  void list_links();
  void list_kinds();
  void find_room(int corners_left);
  [[nodiscard]] bool allows_face(GatewayIndex first, bool quadrangles);
  [[nodiscard]] bool meets_demand(Groups present, bool is_odd);
  [[nodiscard]] bool can_link(ViewClassId a, ViewClassId b) const {
    return links_[a.index() * group_.size() + b.index()];
  }
  [[nodiscard]] Groups bit(ViewClassId view) const {
    return Groups{1} << (group_[view.index()] % 64);
  }

  const WorkingMap* map_;
  const ObservedWalk* walk_;
  const LookAhead* look_ahead_;
  const CornerBound* bound_;
  std::vector<std::size_t> group_;  // By view class.
  std::vector<bool> links_;         // Pairs of view classes that a travel joins.
  std::vector<Kind> kinds_;
  std::vector<Demand> demands_;
  std::uint64_t now_ = 0;
  std::vector<std::uint64_t> seen_;  // By gateway: when its face was looked at last.
  FaceRing ring_;
  Quadrangulation quadrangulation_;
};

}  // namespace cairn
