#include "bench/lab/rooms_score.hpp"

#include <algorithm>
#include <map>

#include "base/check.hpp"

namespace cairn::lab {
namespace {

constexpr std::size_t kMaxSpeck_cells = 100;
constexpr std::int32_t kNone = -1;
constexpr std::int32_t kNotYet = -2;

/// Gives all cells of a 4-connected piece a number, and counts them.
std::vector<std::size_t> flooded(std::size_t start, std::int32_t number, TrueRooms* rooms) {
  const auto width = static_cast<std::size_t>(rooms->width);
  std::vector<std::size_t> cells{start};
  rooms->room_of[start] = number;
  const auto take = [&](std::size_t index) {
    if (rooms->room_of[index] == kNotYet) {
      rooms->room_of[index] = number;
      cells.push_back(index);
    }
  };
  for (std::size_t next = 0; next < cells.size(); ++next) {
    const std::size_t at = cells[next];
    if (at % width > 0) {
      take(at - 1);
    }
    if (at % width + 1 < width) {
      take(at + 1);
    }
    if (at >= width) {
      take(at - width);
    }
    if (at + width < rooms->room_of.size()) {
      take(at + width);
    }
  }
  return cells;
}

double percent_of(std::size_t part, std::size_t whole) {
  return whole == 0 ? 0.0 : 100.0 * static_cast<double>(part) / static_cast<double>(whole);
}

double mean_of(double sum, std::size_t count) {
  return count == 0 ? 0.0 : sum / static_cast<double>(count);
}

}  // namespace

TrueRooms true_rooms(const GreyPicture& truth) {
  TrueRooms rooms;
  rooms.width = truth.width;
  rooms.height = truth.height;
  for (int y = 0; y < truth.height; ++y) {
    const std::size_t row =
        static_cast<std::size_t>(truth.height - 1 - y) * static_cast<std::size_t>(truth.width);
    for (std::size_t x = 0; x < static_cast<std::size_t>(truth.width); ++x) {
      rooms.room_of.push_back(is_free_shade(truth.grey[row + x]) ? kNotYet : kNone);
    }
  }
  for (std::size_t i = 0; i < rooms.room_of.size(); ++i) {
    if (rooms.room_of[i] != kNotYet) {
      continue;
    }
    const auto number = static_cast<std::int32_t>(rooms.cells.size());
    const std::vector<std::size_t> cells = flooded(i, number, &rooms);
    if (cells.size() > kMaxSpeck_cells) {
      rooms.cells.push_back(cells.size());
      continue;
    }
    for (const std::size_t cell : cells) {
      rooms.room_of[cell] = kNone;
    }
  }
  return rooms;
}

RoomsScore score_of(const RegionGraph& graph, const TrueRooms& truth) {
  CAIRN_CHECK(graph.geometry.width == truth.width && graph.geometry.height == truth.height);
  std::vector<std::size_t> cells(graph.regions.size());
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> overlaps;
  for (std::size_t i = 0; i < truth.room_of.size(); ++i) {
    if (graph.region_of[i] == RegionGraph::kNoRegion) {
      continue;
    }
    const auto region = static_cast<std::size_t>(graph.region_of[i]);
    ++cells[region];
    if (truth.room_of[i] != kNone) {
      ++overlaps[{region, static_cast<std::size_t>(truth.room_of[i])}];
    }
  }
  std::vector<std::size_t> most_of_region(cells.size());
  std::vector<std::size_t> room_of_region(cells.size());
  std::vector<std::size_t> most_of_room(truth.cells.size());
  for (const auto& [pair, overlap] : overlaps) {
    const auto& [region, room] = pair;
    most_of_room[room] = std::max(most_of_room[room], overlap);
    if (overlap > most_of_region[region]) {
      most_of_region[region] = overlap;
      room_of_region[region] = room;
    }
  }
  RoomsScore score;
  score.rooms = truth.cells.size();
  std::vector<std::size_t> credited(truth.cells.size());
  for (std::size_t region = 0; region < cells.size(); ++region) {
    score.precision += percent_of(most_of_region[region], cells[region]);
    auto& best = credited[room_of_region[region]];
    best = std::max(best, most_of_region[region]);
  }
  for (std::size_t room = 0; room < truth.cells.size(); ++room) {
    score.recall += percent_of(most_of_room[room], truth.cells[room]);
    score.credited_recall += percent_of(credited[room], truth.cells[room]);
  }
  score.precision = mean_of(score.precision, cells.size());
  score.recall = mean_of(score.recall, score.rooms);
  score.credited_recall = mean_of(score.credited_recall, score.rooms);
  return score;
}

}  // namespace cairn::lab
