#pragma once

#include <cstdint>
#include <vector>

#include "topology/working_map.hpp"

namespace cairn {

/// Whether a region-consistent map stays so (is_region_consistent()) when two gateways are linked.
/// Only the joined path and those that cross it are looked at: no other changes.
/// Cost: the sum over these paths of the lengths of the paths that cross them.
class LinkRegions {
 public:
  explicit LinkRegions(const WorkingMap& map) : map_(&map) {}

  /// @pre both are pending and lie on different paths without a common place
  [[nodiscard]] bool stay_consistent(GatewayIndex a, GatewayIndex b);

 private:
  struct Stop {
    PlaceId place;
    std::size_t forward_slot = 0;
    std::size_t backward_slot = 0;
  };

  [[nodiscard]] const Star& star(PlaceId place) const {
    return map_->stars().star(map_->star(place));
  }
  [[nodiscard]] GatewayIndex leads_to(GatewayIndex at) const;
  [[nodiscard]] Stop stop_entered_by(GatewayIndex entry) const;
  [[nodiscard]] GatewayIndex exit_of(PlaceId place, std::size_t slot) const;
  void follow(PlaceId place, std::size_t slot, bool forward, std::vector<Stop>* stops) const;
  [[nodiscard]] bool divides(const std::vector<Stop>& stops);
  [[nodiscard]] bool marks_around(const Stop& stop);
  [[nodiscard]] bool marks_outward(PlaceId place, std::size_t slot, std::uint64_t side);

  const WorkingMap* map_;
  GatewayIndex a_ = kNoGateway;
  GatewayIndex b_ = kNoGateway;
  std::uint64_t now_ = 0;
  std::vector<std::uint64_t> side_;  // By place: when it was marked, times 4, plus the side.
  std::vector<Stop> joined_;
  std::vector<Stop> crossing_;
};

}  // namespace cairn
