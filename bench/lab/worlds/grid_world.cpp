#include <algorithm>

#include "base/check.hpp"
#include "bench/lab/worlds/world.hpp"

namespace cairn::lab {
namespace {

using Index = std::size_t;

constexpr std::array<int, 4> kRowStep{-1, 0, 1, 0};
constexpr std::array<int, 4> kColumnStep{0, 1, 0, -1};
constexpr char kHeadings[] = "NESW";

/// The place that lies next to this one, or -1.
int neighbour(const GridWorld& grid, int place, Index heading) {
  const int row = place / grid.columns + kRowStep[heading];
  const int column = place % grid.columns + kColumnStep[heading];
  const bool is_inside = row >= 0 && row < grid.rows && column >= 0 && column < grid.columns;
  return is_inside ? row * grid.columns + column : -1;
}

/// For each slot, clockwise, its heading: opposite streets, or a street and its end, are one
/// fragment. Begins where gateways come first and ends last.
std::vector<Index> headings_of_slots(const GridWorld& grid, int place) {
  const auto is_open = [&](Index heading) { return neighbour(grid, place, heading) >= 0; };
  std::vector<Index> best;
  for (Index first = 0; first < 4; ++first) {
    std::vector<Index> slots;
    for (Index step = 0; step < 4; ++step) {
      const Index heading = (first + step) % 4;
      if (is_open(heading) || is_open((heading + 2) % 4)) {
        slots.push_back(heading);
      }
    }
    const auto openness = [&is_open](const std::vector<Index>& headings) {
      std::vector<bool> open;
      for (const Index heading : headings) {
        open.push_back(is_open(heading));
      }
      return open;
    };
    if (best.empty() || openness(slots) > openness(best)) {
      best = slots;
    }
  }
  return best;
}

void add_place(GridWorld* grid, int place) {
  WorldPlace added;
  std::array<int, 4> gateways{-1, -1, -1, -1};
  const std::vector<Index> slots = headings_of_slots(*grid, place);
  int next = 0;
  for (Index slot = 0; slot < slots.size(); ++slot) {
    const bool leaves = neighbour(*grid, place, slots[slot]) >= 0;
    if (leaves) {
      gateways[slots[slot]] = next;
    }
    added.star.slots.push_back({leaves ? next++ : -1, (slot + slots.size() / 2) % slots.size(),
                                leaves ? ControlLaw::kMidline : ControlLaw::kDeadEnd});
  }
  added.leads_to.resize(static_cast<Index>(next));
  grid->world.places.push_back(added);
  grid->gateways.push_back(gateways);
}

}  // namespace

GridWorld grid_world(int rows, int columns) {
  CAIRN_CHECK(rows >= 1 && columns >= 1 && rows * columns >= 2);
  GridWorld grid{{}, rows, columns, {}};
  for (int place = 0; place < rows * columns; ++place) {
    add_place(&grid, place);
  }
  for (int place = 0; place < rows * columns; ++place) {
    for (Index heading = 0; heading < 4; ++heading) {
      const int other = neighbour(grid, place, heading);
      if (other >= 0) {
        const int gateway = grid.gateways[static_cast<Index>(place)][heading];
        const int arrival = grid.gateways[static_cast<Index>(other)][(heading + 2) % 4];
        WorldPlace& here = grid.world.places[static_cast<Index>(place)];
        here.leads_to[static_cast<Index>(gateway)] = {other, arrival};
      }
    }
  }
  return grid;
}

std::string snake_moves(int rows, int columns) {
  std::string moves;
  for (int row = 0; row < rows; ++row) {
    moves += std::string(row > 0 ? 1 : 0, 'S');
    moves += std::string(static_cast<Index>(columns - 1), row % 2 == 0 ? 'E' : 'W');
  }
  if (rows == 1 || columns == 1) {
    return moves;
  }
  const char sideways = rows % 2 == 0 ? 'E' : 'W';
  for (int column = 0; column < columns; ++column) {
    moves += std::string(column > 0 ? 1 : 0, sideways);
    moves += std::string(static_cast<Index>(rows - 1), column % 2 == 0 ? 'N' : 'S');
  }
  return moves;
}

Result<Walk> walk_grid(const GridWorld& grid, int start, const std::string& moves) {
  const std::string letters = kHeadings;
  std::vector<int> departures;
  int place = start;
  for (Index move = 0; move < moves.size(); ++move) {
    const std::string name = "move " + std::to_string(move + 1) + " ('" + moves[move] + "')";
    const std::string::size_type heading = letters.find(moves[move]);
    if (heading == std::string::npos) {
      return Error{ErrorCode::kMalformed, name + ": expected one of N, E, S, W"};
    }
    const int next = neighbour(grid, place, heading);
    if (next < 0) {
      return Error{ErrorCode::kInvalidValue,
                   name + " leaves the grid of " + std::to_string(grid.rows) + "x" +
                       std::to_string(grid.columns) + " from row " +
                       std::to_string(place / grid.columns) + ", column " +
                       std::to_string(place % grid.columns) + " (counted from 0)"};
    }
    departures.push_back(grid.gateways[static_cast<Index>(place)][heading]);
    place = next;
  }
  return walk_through(grid.world, {start, 0}, departures);
}

}  // namespace cairn::lab
