#include "exact_search/corner_bound.hpp"

#include <algorithm>
#include <random>
#include <set>

#include <gtest/gtest.h>

#include "support/stars.hpp"

namespace cairn {
namespace {

using Kind = MapChange::Kind;

/// Only the stars matter here.
Exploration with_all_stars() {
  Exploration exploration{test::corner(), 0, {}};
  for (const Star& star : {test::corner(), test::tee(), test::crossing(), test::corridor()}) {
    exploration.steps.push_back({0, star, 0});
  }
  return exploration;
}

/// Corners and pending gateways by walking around the face.
struct Face {
  std::vector<int> stretches;
  std::vector<GatewayIndex> pending;
  [[nodiscard]] int need() const {
    int corners = 0;
    int excess = 0;
    for (const int stretch : stretches) {
      corners += stretch;
      excess += std::max(0, stretch - 4);
    }
    const int short_of = excess + 4 + 2 * static_cast<int>(pending.size()) - corners;
    return std::max(0, (short_of + 1) / 2);
  }
};

Face face_from(const WorkingMap& map, const ObservedWalk& walk, GatewayIndex first) {
  Face face{{0}, {first}};
  GatewayIndex at = first;
  while (true) {
    const GatewayRef ref = map.ref(at);
    const auto number = static_cast<std::size_t>(ref.gateway);
    face.stretches.back() += walk.facts(map.star(ref.place)).corners_after[number];
    at = map.gateway({ref.place, (ref.gateway + 1) % map.gateway_count(ref.place)});
    if (at == first) {
      return face;
    }
    if (map.is_pending(at)) {
      face.pending.push_back(at);
      face.stretches.push_back(0);
    } else {
      at = map.leads_to(at);
    }
  }
}

int recounted_need(const WorkingMap& map, const ObservedWalk& walk) {
  int need = 0;
  std::set<GatewayIndex> counted;
  for (GatewayIndex at = 0; at < map.end_gateway(); ++at) {
    if (map.is_pending(at) && counted.count(at) == 0) {
      const Face face = face_from(map, walk, at);
      need += face.need();
      counted.insert(face.pending.begin(), face.pending.end());
    }
  }
  return need;
}

/// Takes a random change within a face, and returns by how much the bound says that the need grows.
int change_randomly(WorkingMap* map,
                    const ObservedWalk& walk,
                    CornerBound* bound,
                    std::mt19937* random,
                    std::vector<MapChange>* done) {
  const auto below = [&](int count) {
    return static_cast<int>((*random)() % static_cast<unsigned>(count));
  };
  std::vector<GatewayIndex> pending;
  for (GatewayIndex at = 0; at < map->end_gateway(); ++at) {
    if (map->is_pending(at)) {
      pending.push_back(at);
    }
  }
  if (pending.empty()) {
    return 0;
  }
  const GatewayIndex departure =
      pending[static_cast<std::size_t>(below(static_cast<int>(pending.size())))];
  bound->survey(departure);
  const auto ring = static_cast<int>(face_from(*map, walk, departure).pending.size());
  MapChange change;
  int growth = 0;
  if (ring > 1 && below(2) == 0) {
    const int position = 1 + below(ring - 1);
    GatewayIndex target = departure;
    for (int i = 0; i < position; ++i) {
      target = map->next_in_ring(target);
    }
    change = {Kind::kLink, {}, {}, departure, target};
    growth = bound->growth_by_link(position);
  } else {
    const StarId star{below(walk.star_count())};
    change = {Kind::kPlace, star, {}, departure, below(walk.stars().gateway_count(star))};
    growth = bound->growth_by_place(star, change.target);
  }
  bound->apply(change);
  map->apply(change);
  done->push_back(change);
  return growth;
}

TEST(CornerBound, GrowsByWhatARecountOfAllFacesFinds) {
  const ObservedWalk walk(with_all_stars());
  for (unsigned seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    WorkingMap map(walk.stars(), WorkingMap::Rings::kFaces);
    map.start(walk.start(), {});
    CornerBound bound(map, walk);
    bound.start();
    int need = bound.need_at_start();
    EXPECT_EQ(need, recounted_need(map, walk));
    std::vector<MapChange> done;
    for (int step = 0; step < 40 && !HasFailure(); ++step) {
      if (random() % 4 == 0 && !done.empty()) {
        map.undo(done.back());
        bound.undo(done.back());
        done.pop_back();
        need = recounted_need(map, walk);
      }
      need += change_randomly(&map, walk, &bound, &random, &done);
      EXPECT_EQ(need, recounted_need(map, walk));
    }
  }
}

// A block of four corners is the least closed map in which no face has fewer than four.
TEST(CornerBound, ALoneCornerNeedsThreeMore) {
  const ObservedWalk walk(with_all_stars());
  WorkingMap map(walk.stars(), WorkingMap::Rings::kFaces);
  map.start(walk.start(), {});
  CornerBound bound(map, walk);
  bound.start();
  EXPECT_EQ(bound.need_at_start(), 3);
}

}  // namespace
}  // namespace cairn
