#pragma once

#include <vector>

#include "layout/place_layout.hpp"
#include "service/experience.hpp"
#include "service/map_state.hpp"
#include "service/visit_matcher.hpp"
#include "topology/hypothesis_tree.hpp"

namespace cairn {

/// Where everything lies under one hypothesis.
struct MetricalMap {
  PlaceLayout layout;                 ///< In the global frame.
  std::vector<Pose2> T_global_visit;  ///< Place frame of every visit.
  std::vector<Pose2> trajectory;      ///< H(x): the robot at every scan, as they were when made.
  Pose2 T_global_lpm;                 ///< From the last visit on, the local map moves rigidly.
};

/// Lays a hypothesis out and bends the trajectory to it. The global frame is the one in which place
/// 0 lies where the local map had it at its first visit, so the robot starts near the origin.
///
/// Source: Modayil et al., IROS 2004, Sec. IV-C to IV-E.
/// @pre the map has at least one visit
[[nodiscard]] Result<MetricalMap> metrical_map(const TopologicalMap& map,
                                               const Experience& experience,
                                               const VisitMatcher& matcher,
                                               const LayoutOptions& options);

/// The poses of all scans and, interpolated between each two along the odometry, of all odometry
/// samples.
/// @pre as many trajectory poses as scans
[[nodiscard]] std::vector<TimedPose> with_poses_between(const std::vector<PerceivedScan>& scans,
                                                        const std::vector<PosedScan>& trajectory);

/// Places with gateways and stars, as they are published.
[[nodiscard]] std::vector<MappedPlace> mapped_places(const TopologicalMap& map,
                                                     const Experience& experience,
                                                     const MetricalMap& metrical);

/// Segments that were travelled, as they are published, in the order of their first travel.
[[nodiscard]] std::vector<MappedSegment> mapped_segments(
    const TopologicalMap& map,
    const Experience& experience,
    const PlaceLayout& layout,
    const std::vector<TravelConstraint>& constraints);

/// Where the layout takes two visits to have been to one place: each later visit with the first.
[[nodiscard]] std::vector<SamePlace> same_places(const TopologicalMap& map,
                                                 const Experience& experience,
                                                 const VisitMatcher& matcher);

/// The best hypotheses of the fringe, at most `count`.
[[nodiscard]] std::vector<HypothesisSummary> summaries(const HypothesisTree& tree,
                                                       std::size_t count);

/// The gateway through which the robot left, in the numbering of the visit's star: the one that was
/// crossed, or else the one that best points to where the robot went next.
[[nodiscard]] int departure_gateway(const PlaceVisit& visit, const PlaceVisit& next);

}  // namespace cairn
