#include "grid/axis_graph.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace cairn {
namespace {

/// Walks over a skeleton and collects its nodes and edges.
class AxisTracer {
 public:
  AxisTracer(const CellMask& skeleton, const DistanceTransform& distances)
      : skeleton_(skeleton),
        distances_(distances),
        node_of_(skeleton.cells.size(), kNone),
        walked_(skeleton.cells.size(), 0) {
    for (std::size_t i = 0; i < skeleton.cells.size(); ++i) {
      if (skeleton.cells[i] != 0) {
        cells_.push_back(i);
      }
    }
  }

  MedialAxis trace() {
    for (const std::size_t i : cells_) {
      if (node_of_[i] == kNone && neighbours(i).size() != 2) {
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
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);
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
    const int x = static_cast<int>(index % static_cast<std::size_t>(skeleton_.width));
    const int y = static_cast<int>(index / static_cast<std::size_t>(skeleton_.width));
    Neighbours result;
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        if ((dx != 0 || dy != 0) && skeleton_.has(x + dx, y + dy)) {
          result.add(skeleton_.index_of(x + dx, y + dy));
        }
      }
    }
    return result;
  }

  [[nodiscard]] Cell cell(std::size_t index) const {
    const auto width = static_cast<std::size_t>(skeleton_.width);
    const Cell lower = distances_.window().lower;
    return {lower.x + static_cast<int>(index % width), lower.y + static_cast<int>(index / width)};
  }

  /// Makes a node of a cell and, where edges meet, of all such cells around it. It lies at the one
  /// with the most clearance.
  void add_node(std::size_t first) {
    const std::size_t node = axis_.nodes.size();
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
        if (node_of_[next] == kNone && neighbours(index).size() > 2 &&
            neighbours(next).size() > 2) {
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
    for (const std::size_t index : chain) {
      edge.cells.push_back(cell(index));
    }
    edge.cells.push_back(axis_.nodes[to].cell);
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

  const CellMask& skeleton_;
  const DistanceTransform& distances_;
  std::vector<std::size_t> cells_;  ///< Of the skeleton.
  std::vector<std::size_t> node_of_;
  std::vector<std::uint8_t> walked_;
  MedialAxis axis_;
};

}  // namespace

MedialAxis traced_axis(const CellMask& skeleton, const DistanceTransform& distances) {
  return AxisTracer(skeleton, distances).trace();
}

double length_m(const AxisEdge& edge, std::size_t from, std::size_t to, double cell_m) {
  double cells = 0.0;
  for (std::size_t i = std::min(from, to); i < std::max(from, to); ++i) {
    cells +=
        std::hypot(edge.cells[i + 1].x - edge.cells[i].x, edge.cells[i + 1].y - edge.cells[i].y);
  }
  return cell_m * cells;
}

}  // namespace cairn
