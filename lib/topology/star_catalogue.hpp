#pragma once

#include <map>
#include <optional>
#include <vector>

#include "star/isomorphism.hpp"
#include "star/star.hpp"
#include "topology/ids.hpp"

namespace cairn {

using StarId = Id<struct StarTag>;            ///< A star of a StarCatalogue.
using ViewClassId = Id<struct ViewClassTag>;  ///< Gateways that look alike have the same one.

/// Every star that was seen, once, with what the search asks of it at each step. Matching two views
/// becomes a comparison of two numbers, and a map holds one number for each place.
class StarCatalogue {
 public:
  /// The id under which the very same star (control laws included) is known; a new one if need be.
  /// @pre star is valid
  StarId add(const Star& star);
  [[nodiscard]] std::optional<StarId> find(const Star& star) const;
  [[nodiscard]] std::size_t count() const { return entries_.size(); }

  [[nodiscard]] const Star& star(StarId id) const { return entries_[id.index()].star; }
  [[nodiscard]] int gateway_count(StarId id) const { return entries_[id.index()].gateway_count; }
  [[nodiscard]] int fragment_count(StarId id) const {
    return static_cast<int>(star(id).slots.size() / 2);
  }
  [[nodiscard]] std::size_t slot_of(StarId id, int gateway) const {
    return gateway_of(id, gateway).slot;
  }
  /// The gateway straight on, or -1 where the fragment terminates.
  [[nodiscard]] int through(StarId id, int gateway) const {
    return gateway_of(id, gateway).through;
  }
  [[nodiscard]] ViewClassId view_class(StarId id, int gateway) const {
    return gateway_of(id, gateway).view_class;
  }

 private:
  struct GatewayEntry {
    std::size_t slot = 0;
    int through = -1;
    ViewClassId view_class;
  };
  struct Entry {
    Star star;
    int gateway_count = 0;
    std::vector<GatewayEntry> gateways;
  };

  [[nodiscard]] const GatewayEntry& gateway_of(StarId id, int gateway) const {
    return entries_[id.index()].gateways[static_cast<std::size_t>(gateway)];
  }

  std::vector<Entry> entries_;
  std::map<ViewCode, ViewClassId> view_classes_;
};

}  // namespace cairn
