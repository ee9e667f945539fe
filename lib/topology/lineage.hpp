#pragma once

#include <vector>

#include "topology/experience_log.hpp"
#include "topology/tree_nodes.hpp"

namespace cairn {

/// Follows one hypothesis through its experience again, visit by visit.
class Lineage {
 public:
  /// Stands at visit 0. All outlive it.
  /// @param node the hypothesis
  Lineage(const TreeNodes& nodes,
          const ExperienceLog& experience,
          const StarCatalogue& stars,
          WorkingMap::Rings rings,
          NodeIndex node);

  /// To the next visit. @pre the hypothesis explains it
  void advance();
  [[nodiscard]] VisitId visit() const { return {static_cast<std::int32_t>(arrivals_.size()) - 1}; }
  [[nodiscard]] WorkingMap& map() { return map_; }
  [[nodiscard]] GatewayIndex position() const { return position_; }
  /// The node on which the map stands.
  [[nodiscard]] NodeIndex node() const { return branch_[next_ - 1]; }
  /// By visit, the gateway of arrival at its place, as the place is now.
  [[nodiscard]] const std::vector<GatewayRef>& arrivals() const { return arrivals_; }
  /// By visit, the gateway by which the robot left, as the place is now; no place where no step
  /// tells it.
  [[nodiscard]] const std::vector<GatewayRef>& departures() const { return departures_; }

 private:
  void take(const TreeNode& node);
  void leave(const TreeNode& node);
  void renumber(PlaceId place, int before, const MapChange& change);

  const TreeNodes* nodes_;
  const ExperienceLog* experience_;
  WorkingMap map_;
  std::vector<NodeIndex> branch_;
  std::size_t next_ = 1;
  GatewayIndex position_ = kNoGateway;
  std::vector<GatewayRef> arrivals_;
  std::vector<GatewayRef> departures_;
};

}  // namespace cairn
