#pragma once

#include <cairn_lcm/assertions_t.hpp>
#include <cairn_lcm/grid_map_t.hpp>
#include <cairn_lcm/hypotheses_t.hpp>
#include <cairn_lcm/hypothesis_map_t.hpp>
#include <cairn_lcm/perceived_place_t.hpp>
#include <cairn_lcm/topology_t.hpp>
#include <cairn_lcm/trajectory_t.hpp>
#include <cairn_lcm/visit_places_t.hpp>

namespace cairn::clients {

/// Where a command reads a map from: a running daemon, or a map file without one. The documents are
/// the same ones either way, checked before they are decoded.
///
/// Every function throws Failure: kBadData for a document that is not there or not sound,
/// kNoService when no daemon answers.
class MapSource {
 public:
  MapSource() = default;
  MapSource(const MapSource&) = delete;
  MapSource& operator=(const MapSource&) = delete;
  virtual ~MapSource() = default;

  [[nodiscard]] virtual cairn_lcm::topology_t topology() = 0;
  [[nodiscard]] virtual cairn_lcm::hypotheses_t hypotheses() = 0;
  [[nodiscard]] virtual cairn_lcm::grid_map_t global_map() = 0;
  [[nodiscard]] virtual cairn_lcm::trajectory_t trajectory() = 0;
  [[nodiscard]] virtual cairn_lcm::assertions_t assertions() = 0;
  [[nodiscard]] virtual cairn_lcm::visit_places_t visit_places() = 0;
  /// What was seen of a place at a visit.
  [[nodiscard]] virtual cairn_lcm::perceived_place_t perceived_place(std::int64_t visit) = 0;
  /// All of the map of one live hypothesis. kBadData where it is not live, or not at hand.
  [[nodiscard]] virtual cairn_lcm::hypothesis_map_t hypothesis_map(std::int64_t hypothesis_id) = 0;
};

}  // namespace cairn::clients
