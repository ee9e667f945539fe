#include "topology/regions.hpp"

#include <algorithm>
#include <cstdint>

#include "topology/paths.hpp"

namespace cairn {
namespace {

enum class Side : std::uint8_t { kNone, kOn, kRight, kLeft };

/// Where one path puts the other places of its map.
class Sides {
 public:
  explicit Sides(const TopologicalMap& map) : map_(map) {}

  /// False on a contradiction.
  [[nodiscard]] bool divide_by(const Path& path) {
    side_.assign(static_cast<std::size_t>(map_.place_count()), Side::kNone);
    for (const PathStop& stop : path.stops) {
      side_[stop.place.index()] = Side::kOn;
    }
    return std::all_of(path.stops.begin(), path.stops.end(),
                       [&](const PathStop& stop) { return mark_around(stop); });
  }

 private:
  bool mark_around(const PathStop& stop) {
    const std::size_t slots = map_.star(stop.place).slots.size();
    Side side = Side::kRight;
    for (std::size_t step = 1; step < slots; ++step) {
      const std::size_t slot = (stop.forward_slot + step) % slots;
      if (slot == stop.backward_slot) {
        side = Side::kLeft;
      } else if (!mark_outward(stop.place, slot, side)) {
        return false;
      }
    }
    return true;
  }

  bool mark_outward(PlaceId place, std::size_t slot, Side side) {
    const int gateway = map_.star(place).slots[slot].gateway;
    std::optional<GatewayRef> exit;
    if (gateway >= 0) {
      exit = GatewayRef{place, gateway};
    }
    while (exit) {
      const std::optional<GatewayRef> entry = map_.linked_to(*exit);
      if (!entry) {
        return true;
      }
      Side& known = side_[entry->place.index()];
      if (known != Side::kNone && known != side) {
        return false;
      }
      known = side;
      exit = map_.through(*entry);
    }
    return true;
  }

  const TopologicalMap& map_;
  std::vector<Side> side_;
};

/// By place, the paths that pass it.
std::vector<std::vector<std::size_t>> paths_by_place(const TopologicalMap& map,
                                                     const std::vector<Path>& paths) {
  std::vector<std::vector<std::size_t>> passing(static_cast<std::size_t>(map.place_count()));
  for (std::size_t path = 0; path < paths.size(); ++path) {
    for (const PathStop& stop : paths[path].stops) {
      passing[stop.place.index()].push_back(path);
    }
  }
  return passing;
}

/// How many places two paths share, for every pair of paths.
class Meetings {
 public:
  Meetings(std::size_t paths, const std::vector<std::vector<std::size_t>>& passing)
      : paths_(paths), count_(paths * paths, 0) {
    for (const std::vector<std::size_t>& here : passing) {
      for (const std::size_t a : here) {
        for (const std::size_t b : here) {
          count_[a * paths_ + b] += a == b ? 0 : 1;
        }
      }
    }
  }
  [[nodiscard]] int operator()(std::size_t a, std::size_t b) const {
    return count_[a * paths_ + b];
  }
  [[nodiscard]] int most() const {
    return count_.empty() ? 0 : *std::max_element(count_.begin(), count_.end());
  }

 private:
  std::size_t paths_;
  std::vector<int> count_;
};

bool share_a_place(const std::vector<std::vector<std::size_t>>& passing,
                   std::size_t a,
                   std::size_t b,
                   std::size_t c) {
  return std::any_of(passing.begin(), passing.end(), [&](const auto& here) {
    const auto passes = [&](std::size_t path) {
      return std::find(here.begin(), here.end(), path) != here.end();
    };
    return passes(a) && passes(b) && passes(c);
  });
}

}  // namespace

bool is_region_consistent(const TopologicalMap& map) {
  const std::vector<Path> paths = trace_paths(map);
  Sides sides(map);
  return std::all_of(paths.begin(), paths.end(),
                     [&](const Path& path) { return sides.divide_by(path); });
}

bool has_double_meeting(const TopologicalMap& map) {
  const std::vector<Path> paths = trace_paths(map);
  return Meetings(paths.size(), paths_by_place(map, paths)).most() > 1;
}

bool has_triangle(const TopologicalMap& map) {
  const std::vector<Path> paths = trace_paths(map);
  const auto passing = paths_by_place(map, paths);
  const Meetings meetings(paths.size(), passing);
  for (std::size_t a = 0; a < paths.size(); ++a) {
    for (std::size_t b = a + 1; b < paths.size(); ++b) {
      for (std::size_t c = b + 1; meetings(a, b) > 0 && c < paths.size(); ++c) {
        if (meetings(a, c) > 0 && meetings(b, c) > 0 && !share_a_place(passing, a, b, c)) {
          return true;
        }
      }
    }
  }
  return false;
}

bool is_perpendicular(const TopologicalMap& map) {
  return !has_double_meeting(map) && !has_triangle(map);
}

}  // namespace cairn
