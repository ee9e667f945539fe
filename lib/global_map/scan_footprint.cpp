#include "global_map/scan_footprint.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

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
      row_words_((2 * reach_cells_ + 1) / kWordCells + 2) {
  const auto rows = static_cast<std::size_t>(2 * reach_cells_ + 1);
  marks_.resize(rows * static_cast<std::size_t>(row_words_), 0);
  outline_.resize(marks_.size(), 0);
}

const TouchedCells& ScanFootprint::of(const LaserScan& scan, const Pose2& T_global_laser) {
  look_up_directions(scan.bearings_rad);
  const Vector2d laser_cells = T_global_laser.translation() / cell_m_;
  // Words begin at multiples of their length, where tiles of a common size begin too.
  const int left = static_cast<int>(std::floor(laser_cells.x())) - reach_cells_;
  const Cell corner{left & -kWordCells,
                    static_cast<int>(std::floor(laser_cells.y())) - reach_cells_};
  laser_cells_ = laser_cells - Vector2d(corner.x, corner.y);
  ahead_ = {std::cos(T_global_laser.theta()), std::sin(T_global_laser.theta())};
  look_up_beams(scan);
  mark_beams();
  fill_between_beams();
  // Whatever passes there, it is a hit; the first of several stands for all.
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
  const std::size_t count = bearings_rad.size();
  directions_.clear();
  for (const float bearing_rad : bearings_rad) {
    const auto rad = static_cast<double>(bearing_rad);
    directions_.emplace_back(std::cos(rad), std::sin(rad));
  }
  dense_cells_.assign(count, 0.0);
  const auto gap_after = [&](std::size_t i) {
    return static_cast<double>(bearings_rad[i + 1]) - static_cast<double>(bearings_rad[i]);
  };
  for (std::size_t i = 1; i + 1 < count; ++i) {
    if (gap_after(i - 1) * gap_after(i) <= 0.0) {
      dense_cells_.assign(count, 0.0);  // Not in order: neighbours may lie anywhere.
      return;
    }
    dense_cells_[i] = 1.0 / std::max(std::abs(gap_after(i - 1)), std::abs(gap_after(i)));
  }
}

void ScanFootprint::look_up_beams(const LaserScan& scan) {
  const std::size_t count = scan.ranges_m.size();
  const double reach_m = std::min(draw_range_m_, scan.max_range_m);
  beams_.assign(count, {});
  for (std::size_t i = 0; i < count; ++i) {
    const auto range_m = static_cast<double>(scan.ranges_m[i]);
    if (std::isnan(range_m)) {
      continue;
    }
    const double free_m =
        std::isinf(range_m) ? free_range_m(scan.ranges_m, i, reach_m) : std::min(range_m, reach_m);
    beams_[i].free_cells = free_m / cell_m_;
    beams_[i].is_hit = range_m <= reach_m;
  }
  for (std::size_t i = 1; i + 1 < count; ++i) {
    beams_[i].filled_cells = std::min({dense_cells_[i], beams_[i - 1].free_cells,
                                       beams_[i].free_cells, beams_[i + 1].free_cells});
  }
}

void ScanFootprint::mark_beams() {
  constexpr double kMarginCells = 1.0;
  low_row_ = high_row_ = static_cast<int>(laser_cells_.y());
  touched_.hits.clear();
  for (std::size_t i = 0; i < beams_.size(); ++i) {
    const Beam& beam = beams_[i];
    if (beam.free_cells <= 0.0) {
      continue;
    }
    double from_cells = 0.0;
    if (beam.filled_cells > 0.0) {  // Not at the ends.
      const double filled_cells =
          std::min({beams_[i - 1].filled_cells, beam.filled_cells, beams_[i + 1].filled_cells});
      from_cells = std::max(0.0, filled_cells - kMarginCells);
    }
    const Vector2d to = point_on(i, beam.free_cells);
    mark_line(from_cells > 0.0 ? point_on(i, from_cells) : laser_cells_, to);
    if (beam.is_hit) {
      touched_.hits.push_back({static_cast<int>(to.x()), static_cast<int>(to.y())});
    }
  }
}

Vector2d ScanFootprint::point_on(std::size_t beam, double range_cells) const {
  const Vector2d& way = directions_[beam];
  return laser_cells_ + range_cells * Vector2d(ahead_.x() * way.x() - ahead_.y() * way.y(),
                                               ahead_.y() * way.x() + ahead_.x() * way.y());
}

/// Row by row: the cells of a row lie between where the line enters and where it leaves it.
void ScanFootprint::mark_line(const Vector2d& from, const Vector2d& to) {
  // Coordinates are > 0, so that whole numbers are the floor.
  const int last_row = static_cast<int>(to.y());
  int row = static_cast<int>(from.y());
  low_row_ = std::min({low_row_, row, last_row});
  high_row_ = std::max({high_row_, row, last_row});
  int column = static_cast<int>(from.x());
  if (row != last_row) {
    const int step = last_row > row ? 1 : -1;
    const double slope = (to.x() - from.x()) / (to.y() - from.y());
    const double low_x = std::min(from.x(), to.x());
    const double high_x = std::max(from.x(), to.x());
    double border_y = last_row > row ? row + 1.0 : row;
    for (; row != last_row; row += step, border_y += step) {
      const double leaves_x = from.x() + slope * (border_y - from.y());
      const int next = static_cast<int>(std::min(std::max(leaves_x, low_x), high_x));
      mark(row, column, next);
      column = next;
    }
  }
  mark(last_row, column, static_cast<int>(to.x()));
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

/// Marks the cells whose centres lie in the star-shaped polygon that ends each beam where it is
/// filled: where the outline has been crossed an odd number of times from the left.
void ScanFootprint::fill_between_beams() {
  int low_row = 2 * reach_cells_ + 1;
  int high_row = -1;
  Vector2d from = laser_cells_;  // As the first and the last beam are not filled.
  for (std::size_t i = 1; i < beams_.size(); ++i) {
    const Vector2d to = point_on(i, beams_[i].filled_cells);
    const bool is_up = from.y() < to.y();
    const Vector2d& low = is_up ? from : to;
    const Vector2d& high = is_up ? to : from;
    const int first_row = static_cast<int>(low.y() + 0.5);
    const int end_row = static_cast<int>(high.y() + 0.5);
    if (first_row < end_row) {
      cross_rows(low, high, first_row, end_row);
      low_row = std::min(low_row, first_row);
      high_row = std::max(high_row, end_row - 1);
    }
    from = to;
  }
  for (int row = low_row; row <= high_row; ++row) {
    Word* const outline = outline_.data() + row * row_words_;
    Word* const marks = marks_.data() + row * row_words_;
    Word before = 0;  // All ones where the word before ends within.
    for (int i = 0; i < row_words_; ++i) {
      Word within = std::exchange(outline[i], 0);
      for (int shift = 1; shift < kWordCells; shift *= 2) {
        within ^= within << shift;
      }
      within ^= before;
      before = Word{0} - (within >> (kWordCells - 1));
      marks[i] |= within;
    }
  }
}

/// Turns over the first cell of each row whose centre lies right of the edge.
void ScanFootprint::cross_rows(const Vector2d& low,
                               const Vector2d& high,
                               int first_row,
                               int end_row) {
  const double slope = (high.x() - low.x()) / (high.y() - low.y());
  const double low_x = std::min(low.x(), high.x());
  const double high_x = std::max(low.x(), high.x());
  for (int row = first_row; row < end_row; ++row) {
    const double x = low.x() + slope * (row + 0.5 - low.y());
    const auto column = static_cast<unsigned>(std::min(std::max(x, low_x), high_x) + 0.5);
    outline_[static_cast<unsigned>(row * row_words_) + column / kWordCells] ^=
        Word{1} << (column % kWordCells);
  }
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
}

}  // namespace cairn
