#include "grid/axis_graph.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <utility>

namespace cairn {
namespace {

/// Walks over a skeleton and collects its nodes and edges.
class AxisTracer {
 public:
  AxisTracer(const PaddedCells& skeleton,
             std::vector<std::uint32_t> cells,
             const DistanceTransform& distances)
      : skeleton_(skeleton),
        distances_(distances),
        cells_(std::move(cells)),
        node_of_(std::make_unique_for_overwrite<std::uint32_t[]>(skeleton.size())),
        walked_(std::make_unique_for_overwrite<std::uint8_t[]>(skeleton.size())) {
    std::sort(cells_.begin(), cells_.end());
    for (const std::size_t i : cells_) {
      node_of_[i] = kNone;
      walked_[i] = 0;
    }
  }

  MedialAxis trace() {
    for (const std::size_t i : cells_) {
      if (node_of_[i] == kNone && count_neighbours(i) != 2) {
        add_node(i);
      }
    }
    for (const std::size_t i : cells_) {
      if (node_of_[i] != kNone) {
        walk_all_from(i);
      }
    }
    add_closed_lines();
    return std::move(axis_);
  }

 private:
  static constexpr std::uint32_t kNone = static_cast<std::uint32_t>(-1);
  /// A bump on a node is no loop: a loop encloses at least a cell.
  static constexpr std::size_t kShortestLoop = 5;

  /// At most eight indices, ascending.
  class Neighbours {
   public:
    void add(std::size_t index) { cells_[count_++] = index; }
    [[nodiscard]] std::size_t size() const { return count_; }
    [[nodiscard]] std::size_t operator[](std::size_t i) const { return cells_[i]; }
    [[nodiscard]] const std::size_t* begin() const { return cells_.data(); }
    [[nodiscard]] const std::size_t* end() const { return cells_.data() + count_; }

   private:
    std::array<std::size_t, 8> cells_{};
    std::size_t count_ = 0;
  };

  [[nodiscard]] Neighbours neighbours(std::size_t index) const {
    const std::size_t stride = skeleton_.stride();
    Neighbours result;
    for (const std::size_t row : {index - stride, index, index + stride}) {
      for (const std::size_t next : {row - 1, row, row + 1}) {
        if (next != index && skeleton_.has(next)) {
          result.add(next);
        }
      }
    }
    return result;
  }

  [[nodiscard]] int count_neighbours(std::size_t index) const {
    return std::popcount(skeleton_.neighbours_of(index));
  }

  [[nodiscard]] Cell cell(std::size_t index) const {
    const Cell lower = distances_.window().lower;
    const Cell at = skeleton_.cell_of(index);
    return {lower.x + at.x, lower.y + at.y};
  }

  /// Makes a node of a cell and, where edges meet, of all such cells around it. It lies at the one
  /// with the most clearance.
  void add_node(std::size_t first) {
    const auto node = static_cast<std::uint32_t>(axis_.nodes.size());
    std::vector<std::size_t> open{first};
    node_of_[first] = node;
    std::size_t best = first;
    while (!open.empty()) {
      const std::size_t index = open.back();
      open.pop_back();
      if (distances_.squared_clearance_cells(cell(index)) >
          distances_.squared_clearance_cells(cell(best))) {
        best = index;
      }
      for (const std::size_t next : neighbours(index)) {
        if (node_of_[next] == kNone && count_neighbours(index) > 2 && count_neighbours(next) > 2) {
          node_of_[next] = node;
          open.push_back(next);
        }
      }
    }
    axis_.nodes.push_back({cell(best), distances_.clearance_m(cell(best)), AxisEnd::kMeets, {}});
  }

  void walk_all_from(std::size_t start) {
    for (const std::size_t next : neighbours(start)) {
      if (node_of_[next] != kNone) {
        if (node_of_[next] != node_of_[start] && start < next) {
          add_edge(node_of_[start], node_of_[next], {});
        }
      } else if (walked_[next] == 0) {
        walk(start, next);
      }
    }
  }

  void walk(std::size_t start, std::size_t first) {
    std::vector<std::size_t> chain;
    std::size_t previous = start;
    std::size_t current = first;
    while (node_of_[current] == kNone) {
      chain.push_back(current);
      walked_[current] = 1;
      const Neighbours both = neighbours(current);
      const std::size_t next = both[0] == previous ? both[1] : both[0];
      previous = current;
      current = next;
    }
    if (node_of_[start] != node_of_[current] || chain.size() >= kShortestLoop) {
      add_edge(node_of_[start], node_of_[current], chain);
    }
  }

  void add_edge(std::size_t from, std::size_t to, const std::vector<std::size_t>& chain) {
    AxisEdge edge{from, to, {axis_.nodes[from].cell}, {}};
    edge.cells.reserve(chain.size() + 2);
    for (const std::size_t index : chain) {
      edge.cells.push_back(cell(index));
    }
    edge.cells.push_back(axis_.nodes[to].cell);
    edge.clearance_m.reserve(edge.cells.size());
    for (const Cell c : edge.cells) {
      edge.clearance_m.push_back(distances_.clearance_m(c));
    }
    axis_.nodes[from].edges.push_back(axis_.edges.size());
    axis_.nodes[to].edges.push_back(axis_.edges.size());
    axis_.edges.push_back(std::move(edge));
  }

  void add_closed_lines() {
    for (const std::size_t i : cells_) {
      if (node_of_[i] == kNone && walked_[i] == 0) {
        add_node(i);
        walk_all_from(i);
      }
    }
  }

  const PaddedCells& skeleton_;
  const DistanceTransform& distances_;
  std::vector<std::uint32_t> cells_;  ///< Of the skeleton, ascending.
  /// By cell, of the skeleton only: most of the window is never asked for.
  std::unique_ptr<std::uint32_t[]> node_of_;
  std::unique_ptr<std::uint8_t[]> walked_;
  MedialAxis axis_;
};

}  // namespace

MedialAxis traced_axis(const PaddedCells& skeleton,
                       std::vector<std::uint32_t> cells,
                       const DistanceTransform& distances) {
  return AxisTracer(skeleton, std::move(cells), distances).trace();
}

double step_cells(Cell a, Cell b) {
  constexpr double kDiagonal = 1.4142135623730951;
  const int dx = std::abs(b.x - a.x);
  const int dy = std::abs(b.y - a.y);
  if (std::max(dx, dy) <= 1) {
    return dx + dy == 2 ? kDiagonal : dx + dy;
  }
  return std::hypot(dx, dy);  // To the node, where that is made of several cells.
}

double length_m(const AxisEdge& edge, std::size_t from, std::size_t to, double cell_m) {
  double cells = 0.0;
  for (std::size_t i = std::min(from, to); i < std::max(from, to); ++i) {
    cells += step_cells(edge.cells[i], edge.cells[i + 1]);
  }
  return cell_m * cells;
}

}  // namespace cairn
