#include "bench/lab/recognition_building.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "clients/sim/random_source.hpp"

namespace cairn::lab {
namespace {

using sim::RandomSource;
using Kind = CorridorFeature::Kind;

constexpr double kCell_m = 0.05;
constexpr double kMargin_m = 5.0;
constexpr double kMissingShare = 0.2;        // of the corridors
constexpr double kChangingShare = 0.3;       // of doors and cupboards, from session to session
constexpr double kPeoplePer_m = 0.03;        // of corridor
constexpr double kAwayFromJunction_m = 0.7;  // beyond the walls of other corridors
constexpr double kWay_m = 0.35;              // to either side of the robot's way that is kept free
constexpr double kDoorRecess_m = 0.15;
constexpr double kRoomDepth_m = 2.5;
constexpr double kRoomWidth_m = 2.2;
constexpr double kFirstDoor_m = 2.8;  // from a junction: rooms do not reach other corridors

double between(RandomSource* random, double low, double high) {
  return low + (high - low) * random->uniform();
}

int one_of(RandomSource* random, std::size_t count) {
  return std::min(static_cast<int>(random->uniform() * static_cast<double>(count)),
                  static_cast<int>(count) - 1);
}

/// Free floor that is cut out of solid walls, and things put on it.
class Drawing {
 public:
  explicit Drawing(const Vector2d& size_m)
      : columns_(static_cast<int>(std::ceil(size_m.x() / kCell_m))),
        rows_(static_cast<int>(std::ceil(size_m.y() / kCell_m))),
        is_free_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), false) {}

  /// The cells whose centres lie in the rectangle between two corners.
  void fill(const Vector2d& corner_a, const Vector2d& corner_b, bool is_free) {
    const Vector2d low = corner_a.cwiseMin(corner_b) / kCell_m;
    const Vector2d high = corner_a.cwiseMax(corner_b) / kCell_m;
    const int first_x = std::max(0, static_cast<int>(std::lround(low.x())));
    const int first_y = std::max(0, static_cast<int>(std::lround(low.y())));
    const int end_x = std::min(columns_, static_cast<int>(std::lround(high.x())));
    const int end_y = std::min(rows_, static_cast<int>(std::lround(high.y())));
    for (int y = first_y; y < end_y; ++y) {
      for (int x = first_x; x < end_x; ++x) {
        is_free_[index_of(x, y)] = is_free;
      }
    }
  }

  [[nodiscard]] sim::FloorPlan plan() const {
    sim::FloorPlan plan(columns_, rows_, kCell_m);
    for (int y = 0; y < rows_; ++y) {
      for (int x = 0; x < columns_; ++x) {
        if (is_free_[index_of(x, y)]) {
          plan.set_free({x, y});
        }
      }
    }
    return plan;
  }

 private:
  [[nodiscard]] std::size_t index_of(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(x);
  }

  int columns_;
  int rows_;
  std::vector<bool> is_free_;
};

/// A corridor as it lies in the building.
struct Laid {
  Laid(const Building& building, const Corridor& corridor)
      : from(building.junctions()[static_cast<std::size_t>(corridor.from)]),
        length_m((building.junctions()[static_cast<std::size_t>(corridor.to)] - from).norm()),
        along((building.junctions()[static_cast<std::size_t>(corridor.to)] - from) / length_m),
        left(-along.y(), along.x()),
        half_m(0.5 * corridor.width_m) {}

  [[nodiscard]] Vector2d at(double along_m, double left_m) const {
    return from + along_m * along + left_m * left;
  }

  Vector2d from;
  double length_m;
  Vector2d along;
  Vector2d left;
  double half_m;
};

bool is_connected(std::size_t junctions, const std::vector<Corridor>& corridors) {
  std::set<int> reached{0};
  for (bool grows = true; grows;) {
    grows = false;
    for (const Corridor& corridor : corridors) {
      if (reached.count(corridor.from) != reached.count(corridor.to)) {
        reached.insert({corridor.from, corridor.to});
        grows = true;
      }
    }
  }
  return reached.size() == junctions;
}

/// Takes some corridors away, as long as every junction can be reached.
std::vector<Corridor> thinned(std::vector<Corridor> corridors,
                              std::size_t junctions,
                              RandomSource* random) {
  for (std::size_t i = corridors.size(); i-- > 0;) {
    if (random->uniform() < kMissingShare) {
      std::vector<Corridor> fewer = corridors;
      fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(i));
      if (is_connected(junctions, fewer)) {
        corridors = std::move(fewer);
      }
    }
  }
  return corridors;
}

/// How doors and furniture are strewn along a corridor.
struct Habit {
  double doors_every_m = 3.0;
  double first_door_m = 2.0;
  double cupboards_per_m = 0.1;
  double pillars_per_m = 0.05;
};

Habit some_habit(RandomSource* random) {
  return {between(random, 2.5, 5.0), between(random, kFirstDoor_m, kFirstDoor_m + 2.0),
          between(random, 0.02, 0.2), between(random, 0.0, 0.08)};
}

void place_at_random(const Laid& laid,
                     CorridorFeature feature,
                     RandomSource* random,
                     std::vector<CorridorFeature>* features) {
  const double away_m = laid.half_m + kAwayFromJunction_m + 0.5 * feature.length_m;
  if (laid.length_m > 2.0 * away_m) {
    feature.along_m = between(random, away_m, laid.length_m - away_m);
    feature.side = random->uniform() < 0.5 ? 1.0 : -1.0;
    features->push_back(feature);
  }
}

void furnish(const Laid& laid,
             int corridor,
             const Habit& habit,
             RandomSource* random,
             std::vector<CorridorFeature>* features) {
  for (double along_m = habit.first_door_m; along_m < laid.length_m - kFirstDoor_m;
       along_m += habit.doors_every_m) {
    for (const double side : {1.0, -1.0}) {
      features->push_back({Kind::kDoor, corridor, along_m, side, 0.9, kDoorRecess_m,
                           random->uniform() < 0.4 ? random->uniform() : 0.0});
    }
  }
  const int cupboards = static_cast<int>(habit.cupboards_per_m * laid.length_m + random->uniform());
  for (int i = 0; i < cupboards; ++i) {
    place_at_random(laid,
                    {Kind::kCupboard, corridor, 0.0, 1.0, between(random, 0.4, 1.6),
                     between(random, 0.25, std::min(0.45, laid.half_m - 0.55)), 0.0},
                    random, features);
  }
  const int pillars = static_cast<int>(habit.pillars_per_m * laid.length_m + random->uniform());
  for (int i = 0; i < pillars; ++i) {
    place_at_random(laid, {Kind::kPillar, corridor, 0.0, 1.0, 0.3, 0.3, 0.0}, random, features);
  }
}

/// What has changed since everything was in its place.
CorridorFeature changed(const Laid& laid, CorridorFeature feature, RandomSource* random) {
  if (random->uniform() >= kChangingShare) {
    return feature;
  }
  if (feature.kind == Kind::kDoor) {
    feature.open_share = random->uniform() < 0.5 ? random->uniform() : 0.0;
  } else if (feature.kind == Kind::kCupboard) {
    std::vector<CorridorFeature> moved;
    place_at_random(laid, feature, random, &moved);
    feature = moved.empty() ? feature : moved.front();
  }
  return feature;
}

void draw(const Laid& laid, const CorridorFeature& feature, Drawing* drawing) {
  const auto rectangle = [&](double length_m, double from_m, double to_m, bool is_free) {
    drawing->fill(laid.at(feature.along_m - 0.5 * length_m, feature.side * from_m),
                  laid.at(feature.along_m + 0.5 * length_m, feature.side * to_m), is_free);
  };
  if (feature.kind != Kind::kDoor) {
    rectangle(feature.length_m, laid.half_m - feature.depth_m, laid.half_m, false);
    return;
  }
  const double recessed_m = laid.half_m + feature.depth_m;
  rectangle(feature.length_m, laid.half_m, recessed_m, true);
  if (feature.open_share > 0.2) {
    rectangle(feature.open_share * feature.length_m, recessed_m, recessed_m + 0.15, true);
    rectangle(kRoomWidth_m, recessed_m + 0.15, recessed_m + kRoomDepth_m, true);
  }
}

void draw_corridor(const Laid& laid, Drawing* drawing) {
  drawing->fill(laid.at(-laid.half_m, -laid.half_m),
                laid.at(laid.length_m + laid.half_m, laid.half_m), true);
}

void draw_people(const Laid& laid, RandomSource* random, Drawing* drawing) {
  const int people = static_cast<int>(kPeoplePer_m * laid.length_m + random->uniform());
  for (int i = 0; i < people; ++i) {
    const Vector2d at = laid.at(between(random, 0.0, laid.length_m),
                                (laid.half_m - 0.25) * (random->uniform() < 0.5 ? 1.0 : -1.0));
    drawing->fill(at - Vector2d(0.15, 0.15), at + Vector2d(0.15, 0.15), false);
  }
}

std::vector<int> random_walk(const Building& building, int travels, RandomSource* random) {
  std::vector<int> walk{one_of(random, building.junctions().size())};
  int before = -1;
  for (int travel = 0; travel < travels; ++travel) {
    std::vector<int> ways;
    for (const Corridor& corridor : building.corridors()) {
      if (corridor.from == walk.back() || corridor.to == walk.back()) {
        ways.push_back(corridor.from == walk.back() ? corridor.to : corridor.from);
      }
    }
    if (ways.size() > 1) {
      ways.erase(std::remove(ways.begin(), ways.end(), before), ways.end());
    }
    before = walk.back();
    walk.push_back(ways[static_cast<std::size_t>(one_of(random, ways.size()))]);
  }
  return walk;
}

/// Where the lines of a lattice lie along one axis.
std::vector<double> lattice_lines(bool is_regular, RandomSource* random) {
  const int count = 3 + one_of(random, 2);
  const double spacing_m = between(random, 8.0, 12.0);
  std::vector<double> lines{kMargin_m};
  while (static_cast<int>(lines.size()) < count) {
    lines.push_back(lines.back() + (is_regular ? spacing_m : between(random, 7.0, 14.0)));
  }
  return lines;
}

}  // namespace

Building::Building(std::uint64_t seed) : seed_(seed), repeats_itself_(seed % 2 == 0) {
  RandomSource random(seed, 1);
  const std::vector<double> xs_m = lattice_lines(repeats_itself_, &random);
  const std::vector<double> ys_m = lattice_lines(repeats_itself_, &random);
  const double width_m = between(&random, 1.9, 2.8);
  const int columns = static_cast<int>(xs_m.size());
  for (std::size_t row = 0; row < ys_m.size(); ++row) {
    for (std::size_t column = 0; column < xs_m.size(); ++column) {
      const int here = static_cast<int>(junctions_.size());
      junctions_.emplace_back(xs_m[column], ys_m[row]);
      const auto own_width_m = [&] {
        return repeats_itself_ ? width_m : between(&random, 1.8, 3.0);
      };
      if (column > 0) {
        corridors_.push_back({here - 1, here, own_width_m()});
      }
      if (row > 0) {
        corridors_.push_back({here - columns, here, own_width_m()});
      }
    }
  }
  corridors_ = thinned(std::move(corridors_), junctions_.size(), &random);
  const Habit shared = some_habit(&random);
  for (int i = 0; i < static_cast<int>(corridors_.size()); ++i) {
    const Habit habit = repeats_itself_ ? shared : some_habit(&random);
    furnish(Laid(*this, corridors_[static_cast<std::size_t>(i)]), i, habit, &random, &features_);
  }
}

sim::World Building::session(int number, int travels) const {
  RandomSource random(seed_, 2 + static_cast<std::uint64_t>(number));
  Drawing drawing(junctions_.back() + Vector2d::Constant(kMargin_m));
  for (const Corridor& corridor : corridors_) {
    draw_corridor(Laid(*this, corridor), &drawing);
  }
  for (const CorridorFeature& feature : features_) {
    const Laid laid(*this, corridors_[static_cast<std::size_t>(feature.corridor)]);
    draw(laid, changed(laid, feature, &random), &drawing);
  }
  for (const Corridor& corridor : corridors_) {
    draw_people(Laid(*this, corridor), &random, &drawing);
  }
  sim::World world;
  sim::Tour tour{"walk", {}};
  Vector2d last = Vector2d::Zero();
  for (const int junction : random_walk(*this, travels, &random)) {
    const Vector2d& at = junctions_[static_cast<std::size_t>(junction)];
    // Nobody stands in the way.
    const Vector2d& from = tour.waypoints.empty() ? at : last;
    drawing.fill(at.cwiseMin(from) - Vector2d::Constant(kWay_m),
                 at.cwiseMax(from) + Vector2d::Constant(kWay_m), true);
    tour.waypoints.push_back({std::to_string(junction), {at.x(), at.y()}});
    last = at;
  }
  world.tours.push_back(std::move(tour));
  world.plan = drawing.plan();
  return world;
}

std::optional<int> Building::junction_near(const Vector2d& p_world, double within_m) const {
  std::optional<int> nearest;
  for (std::size_t i = 0; i < junctions_.size(); ++i) {
    const double away_m = (junctions_[i] - p_world).norm();
    if (away_m < within_m) {
      within_m = away_m;
      nearest = static_cast<int>(i);
    }
  }
  return nearest;
}

}  // namespace cairn::lab
