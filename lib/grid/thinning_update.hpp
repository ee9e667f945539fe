#pragma once

#include <cstdint>
#include <vector>

#include "grid/thinning.hpp"

namespace cairn {

/// Thins a set to lines, and follows the set from one state to the next: only what a change can
/// have reached is done again. The result is that of thinning the whole set.
///
/// Cells are removed one by one, those with the least clearance first, in as many passes as there
/// is anything to remove, where that changes the topology of neither the set (8-connected) nor its
/// complement (4-connected); cells that are kept stay. What becomes of a cell depends on those
/// beside it and on when they are removed, on nothing else. So for every cell the pass in which it
/// was removed is remembered, and the course of things is gone through again in the order of time
/// for the cells at the changes, and from there for whichever cells a different course has reached.
///
/// Source: distance-ordered homotopic thinning, Pudney, CVIU 72(3), 1998.
class ThinningUpdate {
 public:
  /// Starts anew with a set.
  /// @param order indices of all cells of the set, the first to be removed first
  void thin(const std::vector<std::uint32_t>& order);

  /// Goes on with what has become of the set.
  /// @param seeds cells that joined or left the set, are kept now or no longer, have another
  ///     clearance, or lost a neighbour to the border of the window
  void update(const std::vector<std::uint32_t>& seeds);

  [[nodiscard]] bool is_of_size(int width, int height) const;
  /// Makes it a window of that size, with nothing in it.
  void clear(int width, int height);
  /// Moves the window over the ground; see shift_rows.
  void shift(Cell moved);

  /// By index in the window with its rim: to be changed along with the seeds.
  PaddedCells set;
  PaddedCells kept;
  std::vector<std::int32_t> squared;  ///< Clearance.

  /// What stays of the set.
  [[nodiscard]] const PaddedCells& left() const { return left_; }
  /// Of two cells of the set the one that is looked at first has the lower rank.
  [[nodiscard]] std::uint64_t rank_of(std::uint32_t at) const {
    return std::uint64_t{static_cast<std::uint32_t>(squared[at])} << 32U | at;
  }

 private:
  using Pass = std::uint32_t;
  static constexpr Pass kStays = UINT32_MAX;

  static constexpr Pass kPassesNoted = 32;

  /// When a cell is looked at.
  struct Moment {
    Pass pass = 0;
    std::uint64_t rank = 0;
    friend auto operator<=>(const Moment&, const Moment&) = default;
  };

  [[nodiscard]] static std::uint32_t cell_of(Moment at) {
    return static_cast<std::uint32_t>(at.rank);
  }
  [[nodiscard]] std::uint32_t neighbour(std::uint32_t at, unsigned side) const {
    return at + static_cast<std::uint32_t>(offsets_[side]);
  }
  [[nodiscard]] Moment next_look(std::uint32_t at, Moment after) const;
  [[nodiscard]] bool is_there(std::uint32_t at, Moment now) const;
  void doubt(std::uint32_t at, Moment from);
  void doubt_neighbours(std::uint32_t at, Moment from);
  void schedule(Moment look);
  void look(Moment now);

  PaddedCells left_;
  std::vector<Pass> pass_;                ///< In which a cell was removed.
  std::vector<std::int32_t> offsets_;     ///< To the eight neighbours, as bits are numbered.
  std::vector<std::uint8_t> is_doubted_;  ///< Cells that are gone through again.
  std::vector<Pass> was_;                 ///< In which such a cell was removed before.
  /// By cell, bit p: a look in pass p is to come, or has been.
  std::vector<std::uint32_t> pending_;
  std::vector<std::uint32_t> doubted_;
  std::vector<Moment> looks_;  ///< To come: a heap, the first one on top.
};

}  // namespace cairn
