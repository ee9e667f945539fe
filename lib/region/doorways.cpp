#include "region/doorways.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace cairn {
namespace {

constexpr double kMostWidening = 1.0;
constexpr double kOpposite = -0.9;  ///< Cosine between basis points, seen from the diagram.

struct Line {
  Vector2d middle;
  Vector2d along;  ///< Unit length.
  double length = 0.0;

  explicit Line(const Doorway& doorway) {
    const auto& [a, b] = doorway.basis_points;
    middle = {0.5 * (a.x + b.x), 0.5 * (a.y + b.y)};
    length = doorway.length_cells;
    along = (1.0 / length) * Vector2d(b.x - a.x, b.y - a.y);
  }
  [[nodiscard]] Vector2d normal() const { return {-along.y(), along.x()}; }
};

/// Lines between the basis points of neighbouring cells that look to opposite sides.
std::vector<Doorway> candidates(const DistanceTransform& distances, double max_cells) {
  std::vector<Doorway> lines;
  const GridWindow& window = distances.window();
  const auto consider = [&](Cell a, Cell b) {
    const std::int32_t squared = distances.squared_clearance_cells(a);
    if (squared == 0 || squared == DistanceTransform::kUnbounded ||
        4.0 * squared > 1.5 * max_cells * max_cells || distances.squared_clearance_cells(b) == 0) {
      return;
    }
    const Cell p = distances.basis_point(a);
    const Cell q = distances.basis_point(b);
    const Vector2d to_p(p.x - a.x, p.y - a.y);
    const Vector2d to_q(q.x - a.x, q.y - a.y);
    if (to_p.dot(to_q) < kOpposite * to_p.norm() * to_q.norm() &&
        (to_p - to_q).norm() <= max_cells) {
      lines.push_back({{std::min(p, q), std::max(p, q)}, (to_p - to_q).norm()});
    }
  };
  for (int y = window.lower.y; y < window.lower.y + window.height; ++y) {
    for (int x = window.lower.x; x < window.lower.x + window.width; ++x) {
      for (const Cell next : {Cell{x + 1, y}, Cell{x, y + 1}}) {
        if (window.contains(next)) {
          consider({x, y}, next);
        }
      }
    }
  }
  const auto key = [](const Doorway& d) { return std::tuple(d.length_cells, d.basis_points); };
  std::sort(lines.begin(), lines.end(),
            [&](const Doorway& a, const Doorway& b) { return key(a) < key(b); });
  lines.erase(std::unique(lines.begin(), lines.end(),
                          [&](const Doorway& a, const Doorway& b) { return key(a) == key(b); }),
              lines.end());
  return lines;
}

class WallProbe {
 public:
  WallProbe(const DistanceTransform& distances, const RegionOptions& options)
      : distances_(distances),
        depth_cells_(options.doorway_depth_m / distances.geometry().cell_m),
        obstacles_(distances.geometry().cell_count()) {
    const GridWindow& window = distances.window();
    for (int y = window.lower.y; y < window.lower.y + window.height; ++y) {
      for (int x = window.lower.x; x < window.lower.x + window.width; ++x) {
        obstacles_[distances.geometry().index_of({x, y})] =
            distances.state({x, y}) == CellState::kFree ? 0 : 1;
      }
    }
  }

  void shut(const Doorway& doorway) {
    for (const Cell cell : cells_of(doorway)) {
      ++obstacles_[distances_.geometry().index_of(cell)];
    }
  }
  void open(const Doorway& doorway) {
    for (const Cell cell : cells_of(doorway)) {
      --obstacles_[distances_.geometry().index_of(cell)];
    }
  }

  /// By what share of the line's length free space widens on the side where it does less; at most
  /// kMostWidening, and 0 where clearance falls or something blocks the way.
  [[nodiscard]] double widening(const Line& line) const {
    const double one = widening(line, line.normal());
    return one > 0.0 ? std::min(one, widening(line, -1.0 * line.normal())) : 0.0;
  }

 private:
  [[nodiscard]] static Cell cell_at(const Vector2d& p) {
    return {static_cast<int>(std::lround(p.x())), static_cast<int>(std::lround(p.y()))};
  }

  [[nodiscard]] bool is_free(const Vector2d& p) const {
    const Cell cell = cell_at(p);
    return distances_.window().contains(cell) &&
           obstacles_[distances_.geometry().index_of(cell)] == 0;
  }

  /// How far free space goes on from a point, at most so far.
  [[nodiscard]] double reach(const Vector2d& from, const Vector2d& along, double most) const {
    double far = 0.0;
    while (far < most && is_free(from + (far + 1.0) * along)) {
      far += 1.0;
    }
    return far;
  }

  [[nodiscard]] double widening(const Line& line, const Vector2d& aside) const {
    constexpr double kFirst = 2.0;  // Cells: as far as the grid can tell.
    if (distances_.clearance_m(cell_at(line.middle + kFirst * aside)) <
        distances_.clearance_m(cell_at(line.middle)) - 0.5 * distances_.geometry().cell_m) {
      return 0.0;
    }
    const double most = (0.5 + kMostWidening) * line.length;
    double widest = line.length;
    for (double depth = 1.0; depth <= depth_cells_; depth += 1.0) {
      const Vector2d at = line.middle + depth * aside;
      if (!is_free(at)) {
        break;
      }
      widest =
          std::max(widest, 1.0 + reach(at, line.along, most) + reach(at, -1.0 * line.along, most));
    }
    return std::min(widest / line.length - 1.0, kMostWidening);
  }

  const DistanceTransform& distances_;
  double depth_cells_;
  std::vector<std::uint16_t> obstacles_;  ///< How many, for every cell of the grid.
};

double cross(const Vector2d& a, const Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// Whether two lines cross, or are two lines in one doorway.
bool rival(const Line& a, const Line& b) {
  const Vector2d apart = b.middle - a.middle;
  const double sine = cross(a.along, b.along);
  if (apart.norm() < 0.5 * std::min(a.length, b.length) && std::abs(sine) < 0.7) {
    return true;
  }
  if (std::abs(sine) < 1e-9) {
    return false;
  }
  const double on_a = cross(apart, b.along) / sine;
  const double on_b = cross(apart, a.along) / sine;
  return std::abs(on_a) < 0.45 * a.length && std::abs(on_b) < 0.45 * b.length;
}

/// Finds doorways among candidates, with those already found shut.
class DoorwaySearch {
 public:
  DoorwaySearch(const DistanceTransform& distances, const RegionOptions& options)
      : probe_(distances, options), least_(options.widening) {}

  /// Adds what may be a doorway as long as the new ones are open.
  void add(const std::vector<Doorway>& candidates) {
    const std::size_t before = doors_.size();
    for (const Doorway& candidate : candidates) {
      const Line line(candidate);
      const bool has_rival = std::any_of(lines_.begin(), lines_.end(),
                                         [&](const Line& other) { return rival(line, other); });
      if (!has_rival && probe_.widening(line) >= least_) {
        doors_.push_back(candidate);
        lines_.push_back(line);
      }
    }
    for (std::size_t i = before; i < doors_.size(); ++i) {
      probe_.shut(doors_[i]);
    }
  }

  /// Takes back, the least first, what is no doorway while all others are shut.
  void reconsider() {
    std::vector<double> widenings(doors_.size());
    for (std::size_t i = 0; i < doors_.size(); ++i) {
      widenings[i] = widening_alone(i);
    }
    while (!widenings.empty()) {
      const auto least = std::min_element(widenings.rbegin(), widenings.rend());
      if (*least >= least_) {
        return;
      }
      const auto which = static_cast<std::size_t>(widenings.rend() - least) - 1;
      const Line gone = lines_[which];
      probe_.open(doors_[which]);
      const auto at = static_cast<std::ptrdiff_t>(which);
      doors_.erase(doors_.begin() + at);
      lines_.erase(lines_.begin() + at);
      widenings.erase(widenings.begin() + at);
      for (std::size_t i = 0; i < doors_.size(); ++i) {
        const double reach = (1.0 + kMostWidening) * (gone.length + lines_[i].length);
        if ((lines_[i].middle - gone.middle).norm() <= reach) {
          widenings[i] = widening_alone(i);
        }
      }
    }
  }

  [[nodiscard]] std::vector<Doorway> found() && { return std::move(doors_); }

 private:
  double widening_alone(std::size_t which) {
    probe_.open(doors_[which]);
    const double widening = probe_.widening(lines_[which]);
    probe_.shut(doors_[which]);
    return widening;
  }

  WallProbe probe_;
  double least_;
  std::vector<Doorway> doors_;
  std::vector<Line> lines_;
};

}  // namespace

std::vector<Cell> cells_of(const Doorway& doorway) {
  const auto& [a, b] = doorway.basis_points;
  const int steps = 2 * std::max(std::abs(b.x - a.x), std::abs(b.y - a.y));
  std::vector<Cell> cells;
  for (int i = 0; i <= steps; ++i) {
    const double share = static_cast<double>(i) / std::max(steps, 1);
    const Cell next{static_cast<int>(std::lround(a.x + share * (b.x - a.x))),
                    static_cast<int>(std::lround(a.y + share * (b.y - a.y)))};
    if (!cells.empty() && cells.back().x != next.x && cells.back().y != next.y) {
      cells.push_back({cells.back().x, next.y});
    }
    cells.push_back(next);
  }
  return cells;
}

std::vector<Doorway> doorways(const DistanceTransform& distances, const RegionOptions& options) {
  constexpr int kRounds = 2;  // What had a rival that was taken back gets another chance.
  const std::vector<Doorway> all =
      candidates(distances, options.max_line_m / distances.geometry().cell_m + 1.0);
  DoorwaySearch search(distances, options);
  for (int round = 0; round < kRounds; ++round) {
    search.add(all);
    search.reconsider();
  }
  return std::move(search).found();
}

}  // namespace cairn
