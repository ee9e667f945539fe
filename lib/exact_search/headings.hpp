#pragma once

#include <cstdint>
#include <vector>

#include "topology/working_map.hpp"

namespace cairn {

/// The heading of every gateway in quarter turns clockwise, if corridors are straight and the slots
/// of every star point to the four directions of the compass. The first place's slot 0 has heading
/// 0.
class Headings {
 public:
  explicit Headings(const WorkingMap& map) : map_(&map) {}

  void add_start() { append(PlaceId{0}, 0); }
  /// After the map has applied the change.
  void add_place(const MapChange& change);
  void remove_place(const MapChange& change);

  /// Whether a traveller can leave by one, keep the heading, and come in by the other.
  [[nodiscard]] bool are_opposite(GatewayIndex a, GatewayIndex b) const {
    return (of(a) + 2 - of(b)) % 4 == 0;
  }
  /// The same where only north-south and east-west are told apart.
  [[nodiscard]] bool are_in_line(GatewayIndex a, GatewayIndex b) const {
    return (of(a) - of(b)) % 2 == 0;
  }

 private:
  [[nodiscard]] int of(GatewayIndex at) const { return headings_[static_cast<std::size_t>(at)]; }
  /// @param zero heading of the place's slot 0
  void append(PlaceId place, std::size_t zero);

  const WorkingMap* map_;
  std::vector<std::uint8_t> headings_;
};

}  // namespace cairn
