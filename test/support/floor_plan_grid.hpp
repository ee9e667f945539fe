#pragma once

#include <algorithm>
#include <random>
#include <string>
#include <vector>

#include "support/ascii_grid.hpp"

namespace cairn::test {

/// A drawing with every character as a square of factor x factor cells.
inline OccupancyGrid enlarged_grid_of(const std::vector<std::string>& lines,
                                      int factor,
                                      double cell_m) {
  std::vector<std::string> large;
  for (const std::string& line : lines) {
    std::string wide;
    for (const char drawn : line) {
      wide.append(static_cast<std::size_t>(factor), drawn);
    }
    large.insert(large.end(), static_cast<std::size_t>(factor), wide);
  }
  return grid_of(large, cell_m);
}

/// One of the eight ways to turn and mirror a drawing.
inline std::vector<std::string> turned(const std::vector<std::string>& lines, int way) {
  std::vector<std::string> result = lines;
  for (int quarter = 0; quarter < way % 4; ++quarter) {
    std::vector<std::string> next(result.front().size());
    for (std::size_t x = 0; x < next.size(); ++x) {
      for (const std::string& line : result) {
        next[x] += line[line.size() - 1 - x];
      }
    }
    result = next;
  }
  if (way >= 4) {
    std::reverse(result.begin(), result.end());
  }
  return result;
}

/// A floor of rectangular rooms, split at random, with a door in every wall that splits.
struct RandomFloor {
  std::vector<std::string> drawing;
  int rooms = 0;
};

/// @param side characters; a room is at least 2 * least_room + 1 of them before it is split
class RandomFloorMaker {
 public:
  RandomFloorMaker(unsigned seed, int side, int least_room, int door)
      : random_(seed), least_(least_room), door_(door) {
    floor_.drawing.assign(static_cast<std::size_t>(side),
                          std::string(static_cast<std::size_t>(side), '#'));
  }

  RandomFloor make() {
    const int side = static_cast<int>(floor_.drawing.size());
    split(1, 1, side - 2, side - 2);
    return floor_;
  }

 private:
  int draw(int low, int high) {
    return low + static_cast<int>(random_() % static_cast<unsigned>(high - low + 1));
  }
  char& at(int x, int y) {
    return floor_.drawing[static_cast<std::size_t>(y)][static_cast<std::size_t>(x)];
  }

  /// Clears a rectangle, walls it off in the middle, leaves a door, and goes on in both halves. The
  /// inner walls are drawn last, so that no later wall ends in a door.
  void split(int x, int y, int width, int height) {
    const bool is_wide = width >= height;
    if ((is_wide ? width : height) < 2 * least_ + 1) {
      ++floor_.rooms;
      for (int row = y; row < y + height; ++row) {
        for (int column = x; column < x + width; ++column) {
          at(column, row) = ' ';
        }
      }
      return;
    }
    const int wall = draw(least_, (is_wide ? width : height) - least_ - 1);
    if (is_wide) {
      split(x, y, wall, height);
      split(x + wall + 1, y, width - wall - 1, height);
    } else {
      split(x, y, width, wall);
      split(x, y + wall + 1, width, height - wall - 1);
    }
    cut_door(is_wide, x, y, is_wide ? height : width, wall);
  }

  /// A door where both sides of the wall are free all along it, with wall beside it.
  void cut_door(bool is_wide, int x, int y, int length, int wall) {
    const auto is_clear = [&](int along, int aside) {
      return (is_wide ? at(x + wall + aside, y + along) : at(x + along, y + wall + aside)) == ' ';
    };
    std::vector<int> possible;
    for (int along = 1; along + door_ + 1 <= length; ++along) {
      bool fits = true;
      for (int i = -1; i <= door_; ++i) {
        fits = fits && is_clear(along + i, -1) && is_clear(along + i, 1);
      }
      if (fits) {
        possible.push_back(along);
      }
    }
    if (possible.empty()) {
      return;
    }
    const int first = possible[random_() % possible.size()];
    for (int i = 0; i < door_; ++i) {
      (is_wide ? at(x + wall, y + first + i) : at(x + first + i, y + wall)) = ' ';
    }
    ++doors_;
  }

  std::mt19937 random_;
  int least_;
  int door_;
  int doors_ = 0;
  RandomFloor floor_;
};

}  // namespace cairn::test
