#include "region/clearance_basins.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace cairn {
namespace {

/// Indices of the free cells, the largest clearance first, then the lowest index.
std::vector<std::int32_t> by_falling_clearance(const std::vector<std::int32_t>& squared) {
  std::int32_t most = 0;
  for (const std::int32_t value : squared) {
    if (value != DistanceTransform::kUnbounded) {
      most = std::max(most, value);
    }
  }
  // A counting sort; what nothing bounds has a bucket of its own.
  const auto bucket_of = [most](std::int32_t value) {
    return static_cast<std::size_t>(value == DistanceTransform::kUnbounded ? 0 : most + 1 - value);
  };
  std::vector<std::size_t> begin(static_cast<std::size_t>(most) + 3, 0);
  for (const std::int32_t value : squared) {
    ++begin[bucket_of(value) + 1];
  }
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  std::vector<std::int32_t> order(squared.size());
  for (std::size_t i = 0; i < squared.size(); ++i) {
    order[begin[bucket_of(squared[i])]++] = static_cast<std::int32_t>(i);
  }
  while (!order.empty() && squared[static_cast<std::size_t>(order.back())] == 0) {
    order.pop_back();
  }
  return order;
}

class Flood {
 public:
  Flood(const DistanceTransform& distances, const RegionOptions& options)
      : window_(distances.window()), narrowing_(options.max_narrowing * options.max_narrowing) {
    basins_.width = window_.width;
    basins_.height = window_.height;
    const double line_cells = options.max_line_m / distances.geometry().cell_m;
    most_at_saddle_ = 0.25 * line_cells * line_cells;
    squared_.reserve(static_cast<std::size_t>(window_.width) *
                     static_cast<std::size_t>(window_.height));
    for (int y = 0; y < window_.height; ++y) {
      for (int x = 0; x < window_.width; ++x) {
        squared_.push_back(
            distances.squared_clearance_cells({window_.lower.x + x, window_.lower.y + y}));
      }
    }
    basins_.basin_of.assign(squared_.size(), ClearanceBasins::kNone);
  }

  ClearanceBasins run() {
    for (const std::int32_t index : by_falling_clearance(squared_)) {
      take_in(static_cast<std::size_t>(index));
    }
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

  /// Joins the basins around a cell that nothing parts, and puts the cell into the one it rises to.
  void take_in(std::size_t index) {
    const int x = static_cast<int>(index % static_cast<std::size_t>(window_.width));
    const int y = static_cast<int>(index / static_cast<std::size_t>(window_.width));
    std::array<std::int32_t, 8> around{};
    std::size_t count = 0;
    std::int32_t steepest = ClearanceBasins::kNone;
    double best_rise = -1.0;
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        if (x + dx < 0 || y + dy < 0 || x + dx >= window_.width || y + dy >= window_.height) {
          continue;
        }
        const std::size_t next =
            static_cast<std::size_t>(y + dy) * static_cast<std::size_t>(window_.width) +
            static_cast<std::size_t>(x + dx);
        if (basins_.basin_of[next] == ClearanceBasins::kNone) {
          continue;
        }
        const std::int32_t root = root_of(basins_.basin_of[next]);
        around[count++] = root;
        const double rise =
            (std::sqrt(squared_[next]) - std::sqrt(squared_[index])) / std::hypot(dx, dy);
        if (rise > best_rise) {
          best_rise = rise;
          steepest = root;
        }
      }
    }
    if (count == 0) {
      basins_.basin_of[index] = static_cast<std::int32_t>(parent_.size());
      parent_.push_back(basins_.basin_of[index]);
      peak_.push_back(squared_[index]);
      return;
    }
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        join(squared_[index], around[i], around[j]);
      }
    }
    basins_.basin_of[index] = root_of(steepest);
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
  std::vector<std::int32_t> squared_;
  ClearanceBasins basins_;
  std::vector<std::int32_t> parent_;
  std::vector<std::int32_t> peak_;  ///< Largest squared clearance, by root.
};

}  // namespace

ClearanceBasins clearance_basins(const DistanceTransform& distances, const RegionOptions& options) {
  return Flood(distances, options).run();
}

}  // namespace cairn
