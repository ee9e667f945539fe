#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "place/local_view.hpp"

namespace cairn {

/// One end of an edge of the axis: the way that leaves a node along the edge.
struct AxisWay {
  std::size_t edge = 0;
  bool forward = true;  ///< From the edge's `from` to its `to`.
};

/// Nodes of the axis that belong to one place, since no constriction separates them.
struct AxisSite {
  std::vector<std::size_t> nodes;  ///< Ascending.
  std::vector<AxisWay> ways;       ///< That lead out of the site.
};

/// The axis with a node added wherever it turns a corner.
[[nodiscard]] MedialAxis with_corner_nodes(const MedialAxis& axis,
                                           double cell_m,
                                           double min_turn_rad);

/// What bounds the edges of the view's axis, and how long their steps are.
[[nodiscard]] std::vector<EdgeProfile> edge_profiles(const LocalView& view);

/// Whether the axis, at this position of a way, is bounded by a wall on one side at least.
[[nodiscard]] bool is_along_wall(const LocalView& view, AxisWay way, std::size_t position);

/// Whether it is bounded by walls on both sides. Where it runs along unknown space its clearance
/// says how far was seen, not how wide the passage is.
[[nodiscard]] bool is_between_walls(const LocalView& view, AxisWay way, std::size_t position);

/// Position on a way, in cells from its start, of the first constriction: where clearance has come
/// down to within the tolerance of what it is at least between walls on the stretch ahead, outside
/// of the clearance disc of the node the way starts from. None where the way ends before.
[[nodiscard]] std::optional<std::size_t> first_constriction(const LocalView& view,
                                                            AxisWay way,
                                                            const PlaceOptions& options);

/// Groups the nodes where the axis branches, turns or ends at walls. Two nodes at the ends of an
/// edge are one site when the constrictions found from either of them overlap; a doorway between
/// them keeps them apart nevertheless.
[[nodiscard]] std::vector<AxisSite> axis_sites(const LocalView& view, const PlaceOptions& options);

/// Where on its edge a position of a way lies.
[[nodiscard]] std::size_t index_on_edge(const MedialAxis& axis, AxisWay way, std::size_t position);

}  // namespace cairn
