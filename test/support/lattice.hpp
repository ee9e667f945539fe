#pragma once

#include <cstddef>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "star/star.hpp"
#include "topology/experience.hpp"

namespace cairn::test {

/// Every row, alternately east and west, from the north-west corner; then, from the corner reached,
/// every column: how Savelli and Kuipers, IROS 2004, explore grids.
inline std::string snake_moves(int rows, int columns) {
  std::string moves;
  for (int row = 0; row < rows; ++row) {
    moves += std::string(row > 0 ? 1 : 0, 'S');
    moves += std::string(static_cast<std::size_t>(columns - 1), row % 2 == 0 ? 'E' : 'W');
  }
  const char sideways = rows % 2 == 0 ? 'E' : 'W';
  for (int column = 0; column < columns; ++column) {
    moves += std::string(column > 0 ? 1 : 0, sideways);
    moves += std::string(static_cast<std::size_t>(rows - 1), column % 2 == 0 ? 'N' : 'S');
  }
  return moves;
}

/// A travel and the view at its end.
struct Experienced {
  Action action;
  View view;
};

/// A walk: what a robot sees that makes it.
struct Walk {
  View start;
  std::vector<Experienced> steps;
  /// For the start and each step: the lattice place and the direction (N E S W = 0 to 3) one looks
  /// back into. Nothing but tests may know them.
  std::vector<std::pair<int, int>> truth;
};

/// A world of streets that run north-south and east-west between places on a lattice. Rows go
/// south, columns east. Opposite streets of a place are one path fragment.
class Lattice {
 public:
  Lattice(int rows, int columns) : rows_(rows), columns_(columns) {}

  void remove_street(int place, int direction) {
    removed_.insert({place, direction});
    removed_.insert({neighbour(place, direction), (direction + 2) % 4});
  }
  [[nodiscard]] int place_count() const { return rows_ * columns_; }
  [[nodiscard]] int place_at(int row, int column) const { return row * columns_ + column; }
  [[nodiscard]] bool is_open(int place, int direction) const {
    const int row = place / columns_ + kRowStep[direction];
    const int column = place % columns_ + kColumnStep[direction];
    return row >= 0 && row < rows_ && column >= 0 && column < columns_ &&
           removed_.count({place, direction}) == 0;
  }
  [[nodiscard]] int neighbour(int place, int direction) const {
    return place + kRowStep[direction] * columns_ + kColumnStep[direction];
  }
  [[nodiscard]] int degree(int place) const { return gateway_of(place, 4); }

  /// Number of the gateway that leaves in this direction.
  [[nodiscard]] int gateway_of(int place, int direction) const {
    int gateway = 0;
    for (int other = 0; other < direction; ++other) {
      gateway += is_open(place, other) ? 1 : 0;
    }
    return gateway;
  }

  [[nodiscard]] Star star_at(int place) const {
    Star star;
    int gateways = 0;
    for (int direction = 0; direction < 4; ++direction) {
      if (is_open(place, direction)) {
        star.slots.push_back({gateways++, 0, ControlLaw::kMidline});
      } else if (is_open(place, (direction + 2) % 4)) {
        star.slots.push_back({-1, 0, ControlLaw::kDeadEnd});
      }
    }
    // Each fragment has two slots that face each other.
    for (std::size_t slot = 0; slot < star.slots.size(); ++slot) {
      star.slots[slot].partner = (slot + star.slots.size() / 2) % star.slots.size();
    }
    return star;
  }

  /// The walk by compass directions from a place. At the start the robot looks back into its first
  /// gateway.
  [[nodiscard]] Walk walk(int start, const std::string& moves) const {
    Walk walk;
    int place = start;
    int back = 0;
    while (!is_open(place, back)) {
      ++back;
    }
    walk.start = view_at(place, back, 0);
    walk.truth.emplace_back(place, back);
    for (const char move : moves) {
      const auto direction = static_cast<int>(std::string("NESW").find(move));
      const int turn = gateway_of(place, direction) - gateway_of(place, back) + degree(place);
      const Action action{turn % degree(place)};
      place = neighbour(place, direction);
      back = (direction + 2) % 4;
      walk.truth.emplace_back(place, back);
      walk.steps.push_back({action, view_at(place, back, static_cast<int>(walk.truth.size()) - 1)});
    }
    return walk;
  }

  /// A walk that turns back only in dead ends.
  [[nodiscard]] std::string random_moves(int start, int count, std::mt19937& random) const {
    std::string moves;
    int place = start;
    int back = -1;
    for (int move = 0; move < count; ++move) {
      int direction = back;
      while (!is_open(place, direction < 0 ? 0 : direction) || direction == back) {
        direction = static_cast<int>(random() % 4);
        if (degree(place) == 1 && is_open(place, direction)) {
          break;
        }
      }
      moves += "NESW"[direction];
      place = neighbour(place, direction);
      back = (direction + 2) % 4;
    }
    return moves;
  }

 private:
  static constexpr int kRowStep[4] = {-1, 0, 1, 0};
  static constexpr int kColumnStep[4] = {0, 1, 0, -1};

  [[nodiscard]] View view_at(int place, int back, int visit) const {
    return {star_at(place), gateway_of(place, back), VisitId{visit}};
  }

  int rows_;
  int columns_;
  std::set<std::pair<int, int>> removed_;
};

}  // namespace cairn::test
