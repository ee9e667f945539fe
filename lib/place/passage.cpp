#include "place/passage.hpp"

#include <algorithm>
#include <utility>

namespace cairn {
namespace {

/// A line is taken so much longer at either end, as walls have no exact place.
constexpr double kLineSlack_m = 0.3;
/// At least this share of a passage runs along walls, or between them: one that is seen again only
/// behind a hall of unknown shape is another one.
constexpr double kWalledShare = 0.7;

/// Where a way has come to.
struct Reached {
  std::size_t node = 0;
  WalledLengths::Lengths lengths;
};

WalledLengths::Lengths operator+(const WalledLengths::Lengths& a, const WalledLengths::Lengths& b) {
  return {a.all_m + b.all_m, a.along_wall_m + b.along_wall_m,
          a.between_walls_m + b.between_walls_m};
}

/// Whether an end of the axis is where the map ends.
bool is_at_edge(const LocalView& view, const AxisNode& node) {
  constexpr double kNear_m = 0.5;
  if (node.end != AxisEnd::kUnknown && node.end != AxisEnd::kBorder) {
    return false;
  }
  const Vector2d p = view.grid.geometry().center_of(node.cell);
  return (p - view.p_map_low).minCoeff() < kNear_m + node.clearance_m ||
         (view.p_map_high - p).minCoeff() < kNear_m + node.clearance_m;
}

/// Takes the way up where enough of it runs along walls.
void take_in(const WalledLengths::Lengths& way, Passage* passage) {
  if (way.along_wall_m >= kWalledShare * way.all_m) {
    passage->along_wall_m = std::max(passage->along_wall_m, way.along_wall_m);
  }
  if (way.between_walls_m >= kWalledShare * way.all_m) {
    passage->between_walls_m = std::max(passage->between_walls_m, way.between_walls_m);
  }
}

}  // namespace

WalledLengths::WalledLengths(const LocalView& view) {
  since_start_.reserve(view.profiles.size());
  for (const EdgeProfile& profile : view.profiles) {
    std::vector<Lengths> since_start(profile.is_along_wall.size());
    for (std::size_t i = 0; i < profile.step_m.size(); ++i) {
      const double step_m = profile.step_m[i];
      const double along_m = profile.is_along_wall[i] != 0 ? step_m : 0.0;
      const double between_m = profile.is_between_walls[i] != 0 ? step_m : 0.0;
      since_start[i + 1] = since_start[i] + Lengths{step_m, along_m, between_m};
    }
    since_start_.push_back(std::move(since_start));
  }
}

WalledLengths::Lengths WalledLengths::between(AxisWay way,
                                              std::size_t first,
                                              std::size_t last) const {
  const std::vector<Lengths>& since_start = since_start_[way.edge];
  const std::size_t end = since_start.size() - 1;
  const Lengths& a = since_start[way.forward ? first : end - last];
  const Lengths& b = since_start[way.forward ? last : end - first];
  return {b.all_m - a.all_m, b.along_wall_m - a.along_wall_m,
          b.between_walls_m - a.between_walls_m};
}

Passage passage_beyond(const LocalView& view,
                       const WalledLengths& walled,
                       const AxisSite& site,
                       AxisWay way,
                       std::size_t position,
                       double enough_m) {
  const MedialAxis& axis = view.axis;
  std::vector<bool> is_seen(axis.nodes.size(), false);
  for (const std::size_t n : site.nodes) {
    is_seen[n] = true;
  }
  const auto end_of = [&](AxisWay w) {
    return w.forward ? axis.edges[w.edge].to : axis.edges[w.edge].from;
  };
  Passage best;
  std::vector<Reached> open;
  const auto reach = [&](const Reached& from, AxisWay onward, std::size_t start) {
    const std::size_t next = end_of(onward);
    Reached reached{next, from.lengths};
    for (std::size_t i = start; i < axis.edges[onward.edge].cells.size(); ++i) {
      reached.lengths = from.lengths + walled.between(onward, start, i);
      take_in(reached.lengths, &best);
    }
    best.goes_beyond_map = best.goes_beyond_map ||
                           (is_at_edge(view, axis.nodes[next]) &&
                            reached.lengths.along_wall_m >= kWalledShare * reached.lengths.all_m);
    if (axis.nodes[next].end == AxisEnd::kBlocked) {
      best.to_end_m =
          std::max(best.to_end_m, reached.lengths.along_wall_m + axis.nodes[next].clearance_m);
    }
    if (!is_seen[next]) {
      is_seen[next] = true;
      open.push_back(reached);
    }
  };
  reach({}, way, position);
  while (!open.empty()) {
    const auto nearest = std::max_element(
        open.begin(), open.end(),
        [](const Reached& a, const Reached& b) { return a.lengths.all_m > b.lengths.all_m; });
    const Reached here = *nearest;
    open.erase(nearest);
    if (here.lengths.all_m >= enough_m) {
      break;
    }
    for (const std::size_t e : axis.nodes[here.node].edges) {
      const AxisWay onward{e, axis.edges[e].from == here.node};
      if (!is_seen[end_of(onward)]) {
        reach(here, onward, 0);
      }
    }
  }
  return best;
}

bool is_driven_through(const Gateway& line, const std::vector<Vector2d>& robot_way) {
  for (std::size_t i = 1; i < robot_way.size(); ++i) {
    if (crossing(line, robot_way[i - 1], robot_way[i], kLineSlack_m) != 0) {
      return true;
    }
  }
  return false;
}

}  // namespace cairn
