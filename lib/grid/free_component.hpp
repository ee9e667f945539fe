#pragma once

#include <cstdint>
#include <vector>

#include "grid/distance_transform.hpp"
#include "grid/thinning.hpp"

namespace cairn {

/// Cells of one row that lie side by side.
struct CellRun {
  int y = 0;      ///< In the window.
  int first = 0;  ///< Column in the window.
  int last = 0;   ///< Behind the last one.
  friend auto operator<=>(const CellRun&, const CellRun&) = default;
};

/// The connected piece of passable free space around a cell.
class FreeComponent {
 public:
  /// Finds the 8-connected piece of cells with at least some clearance that holds `start`, or,
  /// where that is too narrow, the nearest such cell within 0.5 m. Empty where there is none.
  void find(const DistanceTransform& distances, Cell start, double min_clearance_m);

  /// From below, and from the left.
  [[nodiscard]] const std::vector<CellRun>& runs() const { return runs_; }

 private:
  void mark_passable(const DistanceTransform& distances, double min_clearance_m);
  [[nodiscard]] std::size_t nearest_passable(int x0, int y0, int slack_cells) const;
  void take_run(std::size_t seed);
  void add_runs(std::size_t from, std::size_t to);

  std::size_t width_ = 0;
  std::size_t height_ = 0;
  std::vector<std::uint8_t> passable_;  ///< Of the window; what was taken is taken out.
  std::vector<std::size_t> open_;
  std::vector<CellRun> runs_;
};

}  // namespace cairn
