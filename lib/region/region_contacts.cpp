#include "region/region_contacts.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

namespace cairn {
namespace {

/// Basins as nodes, with the clearance of the widest opening to every neighbour.
struct Openings {
  std::vector<std::map<std::int32_t, std::int32_t>> widest;
  std::vector<std::size_t> cells;
};

Openings openings_of(const ClearanceBasins& basins, const DistanceTransform& distances) {
  Openings openings;
  openings.widest.resize(static_cast<std::size_t>(basins.count));
  openings.cells.resize(static_cast<std::size_t>(basins.count));
  for (const std::int32_t basin : basins.basin_of) {
    if (basin != ClearanceBasins::kNone) {
      ++openings.cells[static_cast<std::size_t>(basin)];
    }
  }
  for (const BasinContact& contact : contacts_of(basins, distances)) {
    for (const auto& [a, b] : {std::pair(contact.from, contact.to), {contact.to, contact.from}}) {
      auto& widest = openings.widest[static_cast<std::size_t>(a)][b];
      widest = std::max(widest, contact.squared_cells);
    }
  }
  return openings;
}

/// The neighbour across the widest opening; the lowest of equals; kNone without any.
std::int32_t widest_neighbour(const std::map<std::int32_t, std::int32_t>& widest) {
  std::int32_t best = ClearanceBasins::kNone;
  std::int32_t most = -1;
  for (const auto& [neighbour, squared] : widest) {
    if (squared > most) {
      most = squared;
      best = neighbour;
    }
  }
  return best;
}

void join(std::int32_t small, std::int32_t large, Openings* openings) {
  auto& from = openings->widest[static_cast<std::size_t>(small)];
  auto& into = openings->widest[static_cast<std::size_t>(large)];
  for (const auto& [neighbour, squared] : from) {
    auto& theirs = openings->widest[static_cast<std::size_t>(neighbour)];
    theirs.erase(small);
    if (neighbour != large) {
      into[neighbour] = std::max(into[neighbour], squared);
      theirs[large] = into[neighbour];
    }
  }
  from.clear();
  openings->cells[static_cast<std::size_t>(large)] +=
      openings->cells[static_cast<std::size_t>(small)];
}

/// The basin that each becomes part of.
std::vector<std::int32_t> joined(Openings openings, std::size_t min_cells) {
  std::vector<std::int32_t> into(openings.cells.size());
  std::set<std::pair<std::size_t, std::int32_t>> small;
  for (std::size_t i = 0; i < into.size(); ++i) {
    into[i] = static_cast<std::int32_t>(i);
    if (openings.cells[i] < min_cells) {
      small.emplace(openings.cells[i], into[i]);
    }
  }
  while (!small.empty()) {
    const auto [cells, basin] = *small.begin();
    small.erase(small.begin());
    const std::int32_t large = widest_neighbour(openings.widest[static_cast<std::size_t>(basin)]);
    if (large == ClearanceBasins::kNone) {
      into[static_cast<std::size_t>(basin)] = ClearanceBasins::kNone;
      continue;
    }
    small.erase({openings.cells[static_cast<std::size_t>(large)], large});
    join(basin, large, &openings);
    into[static_cast<std::size_t>(basin)] = large;
    if (openings.cells[static_cast<std::size_t>(large)] < min_cells) {
      small.emplace(openings.cells[static_cast<std::size_t>(large)], large);
    }
  }
  return into;
}

std::int32_t end_of(const std::vector<std::int32_t>& into, std::int32_t basin) {
  while (basin != ClearanceBasins::kNone && into[static_cast<std::size_t>(basin)] != basin) {
    basin = into[static_cast<std::size_t>(basin)];
  }
  return basin;
}

}  // namespace

std::vector<BasinContact> contacts_of(const ClearanceBasins& basins,
                                      const DistanceTransform& distances) {
  std::vector<BasinContact> contacts;
  const Cell lower = distances.window().lower;
  const auto basin_at = [&](int x, int y) {
    return basins.basin_of[static_cast<std::size_t>(y) * static_cast<std::size_t>(basins.width) +
                           static_cast<std::size_t>(x)];
  };
  const auto add = [&](Cell one, Cell two) {
    const std::int32_t a = basin_at(one.x, one.y);
    const std::int32_t b = basin_at(two.x, two.y);
    if (a == b || a == ClearanceBasins::kNone || b == ClearanceBasins::kNone) {
      return;
    }
    const auto [from, to] = std::minmax(a, b);
    const Cell cell{lower.x + one.x, lower.y + one.y};
    const Cell other{lower.x + two.x, lower.y + two.y};
    const std::int32_t squared =
        std::min(distances.squared_clearance_cells(cell), distances.squared_clearance_cells(other));
    contacts.push_back({from, to, cell, squared});
    contacts.push_back({from, to, other, squared});
  };
  for (int y = 0; y < basins.height; ++y) {
    for (int x = 0; x < basins.width; ++x) {
      if (x + 1 < basins.width) {
        add({x, y}, {x + 1, y});
      }
      if (y + 1 < basins.height) {
        add({x, y}, {x, y + 1});
      }
    }
  }
  const auto key = [](const BasinContact& c) { return std::tuple(c.from, c.to, c.cell); };
  std::sort(contacts.begin(), contacts.end(), [&](const BasinContact& a, const BasinContact& b) {
    return std::pair(key(a), -a.squared_cells) < std::pair(key(b), -b.squared_cells);
  });
  contacts.erase(
      std::unique(contacts.begin(), contacts.end(),
                  [&](const BasinContact& a, const BasinContact& b) { return key(a) == key(b); }),
      contacts.end());
  return contacts;
}

void join_small_basins(const DistanceTransform& distances,
                       double min_area_m2,
                       ClearanceBasins* basins) {
  const double cell_m = distances.geometry().cell_m;
  const auto min_cells = static_cast<std::size_t>(min_area_m2 / (cell_m * cell_m));
  const std::vector<std::int32_t> into = joined(openings_of(*basins, distances), min_cells);
  std::vector<std::int32_t> number(into.size(), ClearanceBasins::kNone);
  basins->count = 0;
  for (std::int32_t& basin : basins->basin_of) {
    if (basin == ClearanceBasins::kNone) {
      continue;
    }
    const std::int32_t end = end_of(into, basin);
    if (end != ClearanceBasins::kNone &&
        number[static_cast<std::size_t>(end)] == ClearanceBasins::kNone) {
      number[static_cast<std::size_t>(end)] = basins->count++;
    }
    basin = end == ClearanceBasins::kNone ? end : number[static_cast<std::size_t>(end)];
  }
}

}  // namespace cairn
