#pragma once

#include <cstdint>
#include <memory>

#include "clients/common/map_source.hpp"

namespace cairn::clients {

/// One live hypothesis of a map, in place of the best one: all documents of the map are of it, and
/// of one moment.
class HypothesisSource final : public MapSource {
 public:
  /// Throws Failure as MapSource::hypothesis_map does.
  HypothesisSource(std::unique_ptr<MapSource> source, std::int64_t hypothesis_id);

  [[nodiscard]] cairn_lcm::topology_t topology() override { return map_.topology; }
  [[nodiscard]] cairn_lcm::grid_map_t global_map() override { return map_.global_map; }
  [[nodiscard]] cairn_lcm::trajectory_t trajectory() override { return map_.trajectory; }
  [[nodiscard]] cairn_lcm::visit_places_t visit_places() override { return map_.visits; }

  [[nodiscard]] cairn_lcm::hypotheses_t hypotheses() override { return source_->hypotheses(); }
  [[nodiscard]] cairn_lcm::assertions_t assertions() override { return source_->assertions(); }
  [[nodiscard]] cairn_lcm::perceived_place_t perceived_place(std::int64_t visit) override {
    return source_->perceived_place(visit);
  }
  [[nodiscard]] cairn_lcm::hypothesis_map_t hypothesis_map(std::int64_t hypothesis_id) override {
    return source_->hypothesis_map(hypothesis_id);
  }

 private:
  std::unique_ptr<MapSource> source_;
  cairn_lcm::hypothesis_map_t map_;
};

}  // namespace cairn::clients
