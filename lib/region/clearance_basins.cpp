#include "region/clearance_basins.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "grid/clearance_order.hpp"

namespace cairn {
namespace {

CellMask free_cells(const DistanceTransform& distances) {
  CellMask free(distances.window().width, distances.window().height);
  for (std::size_t i = 0; i < free.cells.size(); ++i) {
    free.cells[i] = distances.squared_clearances_cells()[i] > 0 ? 1 : 0;
  }
  return free;
}

class Flood {
 public:
  Flood(const DistanceTransform& distances, const RegionOptions& options)
      : window_(distances.window()),
        narrowing_(options.max_narrowing * options.max_narrowing),
        order_(cells_by_clearance(distances, free_cells(distances))),
        squared_(distances.squared_clearances_cells()) {
    basins_.width = window_.width;
    basins_.height = window_.height;
    const double line_cells = options.max_line_m / distances.geometry().cell_m;
    most_at_saddle_ = 0.25 * line_cells * line_cells;
    basins_.basin_of.assign(squared_.size(), ClearanceBasins::kNone);
  }

  ClearanceBasins run() {
    std::for_each(order_.rbegin(), order_.rend(), [this](std::size_t index) { take_in(index); });
    number_basins();
    return std::move(basins_);
  }

 private:
  std::int32_t root_of(std::int32_t basin) {
    while (parent_[static_cast<std::size_t>(basin)] != basin) {
      auto& parent = parent_[static_cast<std::size_t>(basin)];
      parent = parent_[static_cast<std::size_t>(parent)];
      basin = parent;
    }
    return basin;
  }

  [[nodiscard]] bool parts(std::int32_t saddle, std::int32_t a, std::int32_t b) const {
    const double lower =
        std::min(peak_[static_cast<std::size_t>(a)], peak_[static_cast<std::size_t>(b)]);
    return saddle <= most_at_saddle_ && saddle <= narrowing_ * lower;
  }

  /// The cells around one that lie in a basin already.
  struct Around {
    std::array<std::size_t, 8> cells{};
    std::array<std::int32_t, 8> roots{};
    std::size_t count = 0;
  };

  Around around(int x, int y) {
    Around result;
    const auto width = static_cast<std::size_t>(window_.width);
    for (int row = std::max(y - 1, 0); row <= std::min(y + 1, window_.height - 1); ++row) {
      for (int column = std::max(x - 1, 0); column <= std::min(x + 1, window_.width - 1);
           ++column) {
        const std::size_t next =
            static_cast<std::size_t>(row) * width + static_cast<std::size_t>(column);
        if (basins_.basin_of[next] != ClearanceBasins::kNone) {
          result.cells[result.count] = next;
          result.roots[result.count++] = root_of(basins_.basin_of[next]);
        }
      }
    }
    return result;
  }

  /// Joins the basins around a cell that nothing parts, and puts the cell into the one it rises to.
  void take_in(std::size_t index) {
    const auto width = static_cast<std::size_t>(window_.width);
    const Around near = around(static_cast<int>(index % width), static_cast<int>(index / width));
    if (near.count == 0) {
      basins_.basin_of[index] = static_cast<std::int32_t>(parent_.size());
      parent_.push_back(basins_.basin_of[index]);
      peak_.push_back(squared_[index]);
      return;
    }
    bool meets = false;
    for (std::size_t i = 1; i < near.count; ++i) {
      for (std::size_t j = 0; j < i && near.roots[i] != near.roots[i - 1]; ++j) {
        join(squared_[index], near.roots[i], near.roots[j]);
        meets = true;
      }
    }
    basins_.basin_of[index] = meets ? root_of(steepest(index, near)) : near.roots[0];
  }

  /// The basin of the neighbour that clearance rises to most steeply.
  [[nodiscard]] std::int32_t steepest(std::size_t index, const Around& near) const {
    std::int32_t best = near.roots[0];
    double best_rise = -1.0;
    for (std::size_t i = 0; i < near.count; ++i) {
      const std::size_t apart = std::max(near.cells[i], index) - std::min(near.cells[i], index);
      const bool is_side = apart == 1 || apart == static_cast<std::size_t>(window_.width);
      const double rise = (std::sqrt(squared_[near.cells[i]]) - std::sqrt(squared_[index])) /
                          (is_side ? 1.0 : std::sqrt(2.0));
      if (rise > best_rise) {
        best_rise = rise;
        best = near.roots[i];
      }
    }
    return best;
  }

  void join(std::int32_t saddle, std::int32_t a, std::int32_t b) {
    a = root_of(a);
    b = root_of(b);
    if (a == b || parts(saddle, a, b)) {
      return;
    }
    const bool first = peak_[static_cast<std::size_t>(a)] >= peak_[static_cast<std::size_t>(b)];
    parent_[static_cast<std::size_t>(first ? b : a)] = first ? a : b;
  }

  void number_basins() {
    std::vector<std::int32_t> number(parent_.size(), ClearanceBasins::kNone);
    for (std::int32_t& basin : basins_.basin_of) {
      if (basin == ClearanceBasins::kNone) {
        continue;
      }
      std::int32_t& name = number[static_cast<std::size_t>(root_of(basin))];
      if (name == ClearanceBasins::kNone) {
        name = basins_.count++;
      }
      basin = name;
    }
  }

  GridWindow window_;
  double narrowing_;
  double most_at_saddle_ = 0.0;
  std::vector<std::size_t> order_;
  const std::vector<std::int32_t>& squared_;
  ClearanceBasins basins_;
  std::vector<std::int32_t> parent_;
  std::vector<std::int32_t> peak_;  ///< Largest squared clearance, by root.
};

}  // namespace

ClearanceBasins clearance_basins(const DistanceTransform& distances, const RegionOptions& options) {
  return Flood(distances, options).run();
}

}  // namespace cairn
