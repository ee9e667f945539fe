#pragma once

#include <cstdint>
#include <vector>

#include "bench/lab/grey_picture.hpp"
#include "region/region_graph.hpp"

namespace cairn::lab {

/// The rooms of a true segmentation: 4-connected pieces of what is free in it.
struct TrueRooms {
  int width = 0;
  int height = 0;
  std::vector<std::int32_t> room_of;  ///< For every cell, rows from below; -1: none.
  std::vector<std::size_t> cells;     ///< Of each room.
};

/// Pieces of at most 100 cells are specks of the drawing, and no rooms, as in the evaluation of
/// Bormann et al.
[[nodiscard]] TrueRooms true_rooms(const GreyPicture& truth);

/// How well regions agree with rooms, in percent.
struct RoomsScore {
  std::size_t rooms = 0;
  double recall = 0.0;     ///< Mean over rooms: share of the room its largest region covers.
  double precision = 0.0;  ///< Mean over regions: share of the region within its room.
  /// Recall where a region counts for no room but the one it overlaps most: a room that shares a
  /// region with a larger one has none.
  double credited_recall = 0.0;
};

/// A region is credited to the true room it overlaps most.
///
/// Source: Bormann, Jordan, Li, Hampp, Hägele, "Room segmentation: survey, implementation, and
/// analysis", ICRA 2016, Sec. IV.
/// @pre both have the same size
[[nodiscard]] RoomsScore score_of(const RegionGraph& graph, const TrueRooms& truth);

}  // namespace cairn::lab
