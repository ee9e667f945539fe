#include "global_map/scan_footprint.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace cairn {
namespace {

constexpr int kWordCells = 64;

/// How far a beam without return is free. One or a few such beams between two that hit something
/// are glass or a dark surface, not a hole: they are free no farther than their neighbours.
double free_range_m(const std::vector<float>& ranges_m, std::size_t beam, double reach_m) {
  constexpr std::size_t kNeighbours = 3;
  const auto nearest_return_m = [&](bool ahead) {
    for (std::size_t step = 1; step <= kNeighbours; ++step) {
      if (ahead ? beam + step >= ranges_m.size() : step > beam) {
        break;
      }
      const float range_m = ranges_m[ahead ? beam + step : beam - step];
      if (std::isfinite(range_m)) {
        return static_cast<double>(range_m);
      }
    }
    return std::numeric_limits<double>::infinity();
  };
  const double before_m = nearest_return_m(false);
  const double after_m = nearest_return_m(true);
  const bool is_between_returns = std::isfinite(before_m) && std::isfinite(after_m);
  return is_between_returns ? std::min({before_m, after_m, reach_m}) : reach_m;
}

}  // namespace

ScanFootprint::ScanFootprint(double cell_m, double draw_range_m)
    : cell_m_(cell_m),
      draw_range_m_(draw_range_m),
      reach_cells_(static_cast<int>(std::ceil(draw_range_m / cell_m)) + 2),
      row_words_((2 * reach_cells_ + 1) / kWordCells + 2),
      low_row_(2 * reach_cells_ + 1) {
  marks_.resize(static_cast<std::size_t>(low_row_) * static_cast<std::size_t>(row_words_), 0);
}

const TouchedCells& ScanFootprint::of(const LaserScan& scan, const Pose2& T_global_laser) {
  look_up_directions(scan.bearings_rad);
  const Vector2d laser_cells = T_global_laser.translation() / cell_m_;
  // Words begin at multiples of their length, where tiles of a common size begin too.
  const int left = static_cast<int>(std::floor(laser_cells.x())) - reach_cells_;
  const Cell corner{left & -kWordCells,
                    static_cast<int>(std::floor(laser_cells.y())) - reach_cells_};
  const Vector2d from_cells = laser_cells - Vector2d(corner.x, corner.y);
  const Vector2d ahead(std::cos(T_global_laser.theta()) / cell_m_,
                       std::sin(T_global_laser.theta()) / cell_m_);
  const double reach_m = std::min(draw_range_m_, scan.max_range_m);
  touched_.hits.clear();
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    const double range_m = static_cast<double>(scan.ranges_m[i]);
    if (std::isnan(range_m)) {
      continue;
    }
    const double free_m =
        std::isinf(range_m) ? free_range_m(scan.ranges_m, i, reach_m) : std::min(range_m, reach_m);
    const Vector2d& direction = directions_[i];
    const Vector2d to_cells =
        from_cells + free_m * Vector2d(ahead.x() * direction.x() - ahead.y() * direction.y(),
                                       ahead.y() * direction.x() + ahead.x() * direction.y());
    mark_beam(from_cells, to_cells);
    if (range_m <= reach_m) {
      touched_.hits.push_back({static_cast<int>(to_cells.x()), static_cast<int>(to_cells.y())});
    }
  }
  // Whatever passes there; the first of several beams stands for all.
  std::erase_if(touched_.hits, [this](Cell hit) { return !take_mark(hit); });
  for (Cell& hit : touched_.hits) {
    hit = {corner.x + hit.x, corner.y + hit.y};
  }
  collect(corner);
  return touched_;
}

void ScanFootprint::look_up_directions(const std::vector<float>& bearings_rad) {
  if (bearings_rad == bearings_rad_) {
    return;
  }
  bearings_rad_ = bearings_rad;
  directions_.clear();
  for (const float bearing_rad : bearings_rad) {
    const auto rad = static_cast<double>(bearing_rad);
    directions_.emplace_back(std::cos(rad), std::sin(rad));
  }
}

/// Row by row: the cells of a row lie between where the beam enters and where it leaves it.
void ScanFootprint::mark_beam(const Vector2d& from_cells, const Vector2d& to_cells) {
  // Coordinates are > 0, so that whole numbers are the floor.
  const int last_row = static_cast<int>(to_cells.y());
  int row = static_cast<int>(from_cells.y());
  low_row_ = std::min({low_row_, row, last_row});
  high_row_ = std::max({high_row_, row, last_row});
  int column = static_cast<int>(from_cells.x());
  if (row != last_row) {
    const int step = last_row > row ? 1 : -1;
    const double slope = (to_cells.x() - from_cells.x()) / (to_cells.y() - from_cells.y());
    const double low_x = std::min(from_cells.x(), to_cells.x());
    const double high_x = std::max(from_cells.x(), to_cells.x());
    double border_y = last_row > row ? row + 1.0 : row;
    for (; row != last_row; row += step, border_y += step) {
      const double leaves_x = from_cells.x() + slope * (border_y - from_cells.y());
      const int next = static_cast<int>(std::min(std::max(leaves_x, low_x), high_x));
      mark(row, column, next);
      column = next;
    }
  }
  mark(last_row, column, static_cast<int>(to_cells.x()));
}

/// Both columns and those between them.
inline void ScanFootprint::mark(int row, int column, int other_column) {
  const auto low = static_cast<unsigned>(std::min(column, other_column));
  const auto high = static_cast<unsigned>(std::max(column, other_column));
  Word* word = marks_.data() + row * row_words_ + low / kWordCells;
  Word* const last_word = marks_.data() + row * row_words_ + high / kWordCells;
  Word bits = ~Word{0} << (low % kWordCells);
  for (; word != last_word; ++word) {
    *word |= bits;
    bits = ~Word{0};
  }
  *word |= bits & (~Word{0} >> (kWordCells - 1 - high % kWordCells));
}

bool ScanFootprint::take_mark(Cell cell) {
  Word& word = marks_[static_cast<std::size_t>(cell.y * row_words_ + cell.x / kWordCells)];
  const Word bit = Word{1} << (cell.x % kWordCells);
  const bool is_marked = (word & bit) != 0;
  word &= ~bit;
  return is_marked;
}

/// Empties the window row by row.
void ScanFootprint::collect(Cell corner) {
  touched_.passed.clear();
  for (int row = low_row_; row <= high_row_; ++row) {
    Word* const words = marks_.data() + row * row_words_;
    for (int i = 0; i < row_words_; ++i) {
      int x = corner.x + kWordCells * i;
      for (Word word = words[i]; word != 0;) {
        const int gap = std::countr_zero(word);
        const int length = std::countr_one(word >> gap);
        touched_.passed.push_back({corner.y + row, x + gap, x + gap + length});
        x += gap + length;
        // In two steps, as a shift by all of a word is undefined.
        word = (word >> gap >> (length - 1)) >> 1;
      }
      words[i] = 0;
    }
  }
  low_row_ = 2 * reach_cells_ + 1;
  high_row_ = -1;
}

}  // namespace cairn
