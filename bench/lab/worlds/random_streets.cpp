#include <array>
#include <utility>

#include "base/check.hpp"
#include "bench/lab/worlds/random_world.hpp"

namespace cairn::lab {
namespace {

using Index = std::size_t;

/// By crossing and heading (N E S W): whether a street leaves there.
class Streets {
 public:
  Streets(int rows, int columns)
      : rows_(rows), columns_(columns), open_(static_cast<Index>(rows * columns)) {}

  [[nodiscard]] int count() const { return rows_ * columns_; }
  [[nodiscard]] bool is_open(int crossing, Index heading) const {
    return open_[static_cast<Index>(crossing)][heading % 4];
  }
  [[nodiscard]] int neighbour(int crossing, Index heading) const {
    constexpr std::array<int, 4> kRowStep{-1, 0, 1, 0};
    constexpr std::array<int, 4> kColumnStep{0, 1, 0, -1};
    const int row = crossing / columns_ + kRowStep[heading];
    const int column = crossing % columns_ + kColumnStep[heading];
    const bool is_inside = row >= 0 && row < rows_ && column >= 0 && column < columns_;
    return is_inside ? row * columns_ + column : -1;
  }
  void open(int crossing, Index heading) {
    const auto other = static_cast<Index>(neighbour(crossing, heading));
    open_[static_cast<Index>(crossing)][heading] = true;
    open_[other][(heading + 2) % 4] = true;
  }
  [[nodiscard]] std::vector<int> connected_to(int crossing) const;
  [[nodiscard]] std::vector<int> largest_part() const;

 private:
  int rows_;
  int columns_;
  std::vector<std::array<bool, 4>> open_;
};

std::vector<int> Streets::connected_to(int crossing) const {
  std::vector<bool> is_met(static_cast<Index>(count()), false);
  std::vector<int> part{crossing};
  is_met[static_cast<Index>(crossing)] = true;
  for (Index next = 0; next < part.size(); ++next) {
    for (Index heading = 0; heading < 4; ++heading) {
      const int other = is_open(part[next], heading) ? neighbour(part[next], heading) : -1;
      if (other >= 0 && !is_met[static_cast<Index>(other)]) {
        is_met[static_cast<Index>(other)] = true;
        part.push_back(other);
      }
    }
  }
  return part;
}

std::vector<int> Streets::largest_part() const {
  std::vector<int> largest;
  std::vector<bool> is_known(static_cast<Index>(count()), false);
  for (int crossing = 0; crossing < count(); ++crossing) {
    if (is_known[static_cast<Index>(crossing)]) {
      continue;
    }
    std::vector<int> part = connected_to(crossing);
    for (const int member : part) {
      is_known[static_cast<Index>(member)] = true;
    }
    if (part.size() > largest.size()) {
      largest = std::move(part);
    }
  }
  return largest;
}

/// Opposite streets, or a street and its end, are one fragment.
Star star_of(const Streets& streets, int crossing, std::array<int, 4>* gateways) {
  std::vector<Index> headings;
  for (Index heading = 0; heading < 4; ++heading) {
    if (streets.is_open(crossing, heading) || streets.is_open(crossing, heading + 2)) {
      headings.push_back(heading);
    }
  }
  Star star;
  int next = 0;
  gateways->fill(-1);
  for (Index slot = 0; slot < headings.size(); ++slot) {
    const bool leaves = streets.is_open(crossing, headings[slot]);
    (*gateways)[headings[slot]] = leaves ? next : -1;
    star.slots.push_back({leaves ? next++ : -1, (slot + headings.size() / 2) % headings.size(),
                          leaves ? ControlLaw::kMidline : ControlLaw::kDeadEnd});
  }
  return star;
}

}  // namespace

World random_streets(int rows, int columns, double closed_probability, std::uint64_t seed) {
  CAIRN_CHECK(rows >= 2 && columns >= 2);
  RandomSource random(seed, 4);
  Streets streets(rows, columns);
  for (int crossing = 0; crossing < streets.count(); ++crossing) {
    for (const Index heading : {Index{1}, Index{2}}) {
      if (streets.neighbour(crossing, heading) >= 0 && !random.chance(closed_probability)) {
        streets.open(crossing, heading);
      }
    }
  }
  const std::vector<int> part = streets.largest_part();
  std::vector<int> number(static_cast<Index>(streets.count()), -1);
  std::vector<std::array<int, 4>> gateways(static_cast<Index>(streets.count()));
  World world;
  for (const int crossing : part) {
    number[static_cast<Index>(crossing)] = static_cast<int>(world.places.size());
    world.places.push_back(
        {star_of(streets, crossing, &gateways[static_cast<Index>(crossing)]), {}});
  }
  for (const int crossing : part) {
    WorldPlace& place = world.places[static_cast<Index>(number[static_cast<Index>(crossing)])];
    place.leads_to.resize(static_cast<Index>(gateway_count(place.star)));
    for (Index heading = 0; heading < 4; ++heading) {
      const int gateway = gateways[static_cast<Index>(crossing)][heading];
      if (gateway >= 0) {
        const auto other = static_cast<Index>(streets.neighbour(crossing, heading));
        place.leads_to[static_cast<Index>(gateway)] = {number[other],
                                                       gateways[other][(heading + 2) % 4]};
      }
    }
  }
  return world;
}

}  // namespace cairn::lab
