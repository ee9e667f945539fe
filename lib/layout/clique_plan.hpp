#pragma once

#include <vector>

namespace cairn {

/// Places that are eliminated together, and those that are left which their travels touch.
struct CliqueShape {
  /// Those eliminated, in their order, then those left over, in theirs.
  std::vector<int> places;
  int eliminated = 0;
  int parent = -1;  ///< Among the shapes; -1 for a root.
};

/// In which order to eliminate the places of a graph, and the cliques that come of it: those of
/// least degree first, and of these the ones with the lowest tree below, so that chains become
/// shallow trees. Part of the place layout; not for other layers.
///
/// Source: minimum degree by explicit elimination; the constraint is that of iSAM2 (Kaess et al.,
/// IJRR 2012, Sec. 4.3), which keeps what changes next near the root.
/// @param neighbors by place, sorted, without the place itself; symmetric
/// @param comes_last by place, whether it is eliminated after all others
/// @return each before its parent
[[nodiscard]] std::vector<CliqueShape> plan_cliques(std::vector<std::vector<int>> neighbors,
                                                    const std::vector<char>& comes_last);

}  // namespace cairn
