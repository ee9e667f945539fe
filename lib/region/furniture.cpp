#include "region/furniture.hpp"

#include <algorithm>

namespace cairn {
namespace {

/// An 8-connected piece of what is not free.
struct Piece {
  std::vector<std::size_t> cells;
  Cell lower;
  Cell upper;

  [[nodiscard]] int side_cells() const {
    return std::max(upper.x - lower.x, upper.y - lower.y) + 1;
  }
};

class PieceFlood {
 public:
  explicit PieceFlood(const OccupancyGrid& grid)
      : geometry_(grid.geometry()), open_(grid.cells().size()) {
    for (std::size_t i = 0; i < open_.size(); ++i) {
      open_[i] = grid.cells()[i] < OccupancyGrid::kFreeBelow ? 0 : 1;
    }
  }

  [[nodiscard]] bool is_open(std::size_t index) const { return open_[index] != 0; }

  /// The piece that holds a cell, left into *piece.
  void flood(std::size_t start, Piece* piece) {
    piece->cells.assign(1, start);
    piece->lower = piece->upper = cell(start);
    open_[start] = 0;
    for (std::size_t next = 0; next < piece->cells.size(); ++next) {
      const Cell at = cell(piece->cells[next]);
      piece->lower = {std::min(piece->lower.x, at.x), std::min(piece->lower.y, at.y)};
      piece->upper = {std::max(piece->upper.x, at.x), std::max(piece->upper.y, at.y)};
      for (int y = std::max(at.y - 1, 0); y <= std::min(at.y + 1, geometry_.height - 1); ++y) {
        for (int x = std::max(at.x - 1, 0); x <= std::min(at.x + 1, geometry_.width - 1); ++x) {
          const std::size_t index = geometry_.index_of({x, y});
          if (open_[index] != 0) {
            open_[index] = 0;
            piece->cells.push_back(index);
          }
        }
      }
    }
  }

  [[nodiscard]] bool touches_border(const Piece& piece) const {
    return piece.lower.x == 0 || piece.lower.y == 0 || piece.upper.x == geometry_.width - 1 ||
           piece.upper.y == geometry_.height - 1;
  }

 private:
  [[nodiscard]] Cell cell(std::size_t index) const {
    const auto width = static_cast<std::size_t>(geometry_.width);
    return {static_cast<int>(index % width), static_cast<int>(index / width)};
  }

  GridGeometry geometry_;
  std::vector<std::uint8_t> open_;
};

}  // namespace

OccupancyGrid without_furniture(const OccupancyGrid& grid, double size_m) {
  OccupancyGrid result = grid;
  PieceFlood flood(grid);
  Piece piece;
  for (std::size_t i = 0; i < grid.cells().size(); ++i) {
    if (!flood.is_open(i)) {
      continue;
    }
    flood.flood(i, &piece);
    if (piece.side_cells() * grid.geometry().cell_m > size_m || flood.touches_border(piece)) {
      continue;
    }
    for (const std::size_t index : piece.cells) {
      result.cells()[index] = OccupancyGrid::kFreeBelow - 1;
    }
  }
  return result;
}

}  // namespace cairn
