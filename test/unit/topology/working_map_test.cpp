#include "topology/working_map.hpp"

#include <map>
#include <numeric>
#include <optional>
#include <random>
#include <tuple>

#include <gmock/gmock.h>

#include "support/stars.hpp"

namespace cairn {
namespace {

using Kind = MapChange::Kind;
using ::testing::ElementsAre;
using ::testing::ElementsAreArray;
using ::testing::IsEmpty;

/// The catalogue of the tests: D, I, L, T, +.
class Stars {
 public:
  Stars() {
    for (const Star& star :
         {test::dead_end(), test::corridor(), test::corner(), test::tee(), test::crossing()}) {
      ids_.push_back(catalogue_.add(star));
    }
  }
  [[nodiscard]] const StarCatalogue& catalogue() const { return catalogue_; }
  [[nodiscard]] const std::vector<StarId>& all() const { return ids_; }
  [[nodiscard]] StarId corner() const { return ids_[2]; }
  [[nodiscard]] StarId tee() const { return ids_[3]; }
  [[nodiscard]] StarId crossing() const { return ids_[4]; }

 private:
  StarCatalogue catalogue_;
  std::vector<StarId> ids_;
};

/// Those that belong to the stars that the places have now.
std::vector<GatewayIndex> gateways_of(const WorkingMap& map) {
  std::vector<GatewayIndex> gateways;
  for (PlaceId place{0}; place.value < map.place_count(); ++place.value) {
    for (int number = 0; number < map.gateway_count(place); ++number) {
      gateways.push_back(map.gateway({place, number}));
    }
  }
  return gateways;
}

template <typename Predicate>
std::vector<GatewayIndex> gateways_where(const WorkingMap& map, Predicate holds) {
  std::vector<GatewayIndex> chosen;
  for (const GatewayIndex at : gateways_of(map)) {
    if (holds(at)) {
      chosen.push_back(at);
    }
  }
  return chosen;
}

std::vector<GatewayIndex> pending_of(const WorkingMap& map) {
  return gateways_where(map, [&](GatewayIndex at) { return map.is_pending(at); });
}

std::vector<GatewayIndex> ring_from(const WorkingMap& map, GatewayIndex first) {
  std::vector<GatewayIndex> ring = {first};
  while (map.next_in_ring(ring.back()) != first) {
    ring.push_back(map.next_in_ring(ring.back()));
    EXPECT_EQ(map.previous_in_ring(ring.back()), ring[ring.size() - 2]);
  }
  EXPECT_EQ(map.previous_in_ring(first), ring.back());
  return ring;
}

/// The face by walking along its walls, linked gateway by linked gateway.
std::vector<GatewayIndex> face_from(const WorkingMap& map, GatewayIndex first) {
  const auto clockwise_of = [&](GatewayIndex at) {
    const GatewayRef ref = map.ref(at);
    return map.gateway({ref.place, (ref.gateway + 1) % map.gateway_count(ref.place)});
  };
  std::vector<GatewayIndex> face = {first};
  for (GatewayIndex at = clockwise_of(first); at != first;) {
    if (map.is_pending(at)) {
      face.push_back(at);
    }
    at = clockwise_of(map.is_linked(at) ? map.leads_to(at) : at);
  }
  return face;
}

/// Everything that can be asked of a map, parts without a link named by their first place.
auto described(const WorkingMap& map) {
  std::vector<std::tuple<int, int, int, int>> places;
  std::map<int, int> first_of_component;
  for (PlaceId place{0}; place.value < map.place_count(); ++place.value) {
    const int first =
        first_of_component.try_emplace(map.component(place), place.value).first->second;
    places.emplace_back(map.star(place).value, map.seen_at(place).value,
                        map.first_visit(place).value, first);
  }
  std::vector<std::tuple<GatewayIndex, GatewayIndex, GatewayIndex, GatewayIndex, int>> gateways;
  for (const GatewayIndex at : gateways_of(map)) {
    const bool is_pending = map.is_pending(at);
    gateways.emplace_back(
        map.leads_to(at), map.through(at), is_pending ? map.next_in_ring(at) : kNoGateway,
        is_pending ? map.previous_in_ring(at) : kNoGateway, map.view_class(at).value);
  }
  return std::tuple(places, gateways, map.path_count(), map.pending_count(), map.one_way_count(),
                    map.component_count(), map.gateway_count());
}

int recounted_components(const WorkingMap& map) {
  std::vector<int> part(static_cast<std::size_t>(map.place_count()));
  std::iota(part.begin(), part.end(), 0);
  int count = map.place_count();
  for (const GatewayIndex at : gateways_of(map)) {
    if (!map.is_linked(at)) {
      continue;
    }
    const int from = part[map.place_of(at).index()];
    const int to = part[map.place_of(map.leads_to(at)).index()];
    count -= from != to ? 1 : 0;
    std::replace(part.begin(), part.end(), from, to);
  }
  return count;
}

void expect_sound(const WorkingMap& map) {
  const StarCatalogue& stars = map.stars();
  int fragments = 0;
  for (PlaceId place{0}; place.value < map.place_count(); ++place.value) {
    fragments += stars.fragment_count(map.star(place));
    for (int number = 0; number < map.gateway_count(place); ++number) {
      const GatewayIndex at = map.gateway({place, number});
      EXPECT_EQ(map.ref(at), (GatewayRef{place, number}));
      EXPECT_EQ(map.view_class(at), stars.view_class(map.star(place), number));
      const int through = stars.through(map.star(place), number);
      EXPECT_EQ(map.through(at), through < 0 ? kNoGateway : map.gateway({place, through}));
    }
  }
  const auto pending = pending_of(map);
  const auto linked = gateways_where(map, [&](GatewayIndex at) { return map.is_linked(at); });
  EXPECT_EQ(map.pending_count(), static_cast<int>(pending.size()));
  EXPECT_EQ(map.path_count(), fragments - static_cast<int>(linked.size() / 2));
  EXPECT_EQ(map.one_way_count(),
            static_cast<int>(gateways_of(map).size() - pending.size() - linked.size()));
  EXPECT_EQ(map.component_count(), recounted_components(map));
  for (const GatewayIndex at : pending) {
    if (map.rings() == WorkingMap::Rings::kFaces) {
      EXPECT_THAT(ring_from(map, at), ElementsAreArray(face_from(map, at)));
    } else {
      EXPECT_THAT(ring_from(map, at), ::testing::UnorderedElementsAreArray(pending));
    }
  }
}

/// Changes of every kind that a map can take up.
class RandomChanges {
 public:
  RandomChanges(const Stars& stars, unsigned seed) : stars_(stars), random_(seed) {}

  /// Nothing where the chosen kind is not possible.
  std::optional<MapChange> next(const WorkingMap& map) {
    const VisitId visit{++visits_};
    const auto pending = pending_of(map);
    const auto leading = gateways_where(map, [&](GatewayIndex at) { return !map.is_pending(at); });
    const auto linked = gateways_where(map, [&](GatewayIndex at) { return map.is_linked(at); });
    const StarId star = any(stars_.all());
    const int arrival = below(stars_.catalogue().gateway_count(star));
    switch (static_cast<Kind>(below(7))) {
      case Kind::kNothing:
        return MapChange{};
      case Kind::kPlace:
        return pending.empty() ? std::nullopt
                               : made(Kind::kPlace, star, visit, any(pending), arrival);
      case Kind::kLink: {
        const GatewayIndex a = pending.empty() ? kNoGateway : any(pending);
        const GatewayIndex b = pending.empty() ? kNoGateway : any(pending);
        return a == b ? std::nullopt : made(Kind::kLink, {}, visit, a, b);
      }
      case Kind::kStrayPlace: {
        const bool leads_back = !leading.empty() && below(3) > 0;
        return made(Kind::kStrayPlace, star, visit, leads_back ? any(leading) : kNoGateway,
                    arrival);
      }
      case Kind::kOneWay:
        return pending.empty() || linked.empty()
                   ? std::nullopt
                   : made(Kind::kOneWay, {}, visit, any(pending), any(linked));
      case Kind::kOtherStar:
        return other_star(map, star, visit);
      case Kind::kInsertPlace:
        return linked.empty() || stars_.catalogue().through(star, arrival) < 0
                   ? std::nullopt
                   : made(Kind::kInsertPlace, star, visit, any(linked), arrival);
    }
    return std::nullopt;
  }

  int below(int count) { return static_cast<int>(random_() % static_cast<unsigned>(count)); }

 private:
  template <typename T>
  T any(const std::vector<T>& values) {
    return values[static_cast<std::size_t>(below(static_cast<int>(values.size())))];
  }
  static std::optional<MapChange> made(
      Kind kind, StarId star, VisitId visit, GatewayIndex departure, GatewayIndex target) {
    return MapChange{kind, star, visit, departure, target};
  }

  /// One pending gateway less, one more, or as many as before.
  std::optional<MapChange> other_star(const WorkingMap& map, StarId star, VisitId visit) {
    const PlaceId place{below(map.place_count())};
    const int before = map.gateway_count(place);
    const int after = stars_.catalogue().gateway_count(star);
    const GatewayIndex number = below(std::max(before, after));
    if (after > before + 1 || after < before - 1 ||
        (after < before && !map.is_pending(map.gateway({place, number})))) {
      return std::nullopt;
    }
    return made(Kind::kOtherStar, star, visit, map.first_gateway(place), number);
  }

  const Stars& stars_;
  std::mt19937 random_;
  std::int32_t visits_ = 0;
};

TEST(WorkingMap, ALonePlaceIsOneFaceHoldingAllItsGatewaysClockwise) {
  const Stars stars;
  WorkingMap map(stars.catalogue(), WorkingMap::Rings::kFaces);
  map.start(stars.crossing(), VisitId{0});
  EXPECT_THAT(ring_from(map, 2), ElementsAre(2, 3, 0, 1));
  EXPECT_EQ(map.path_count(), 2);
  EXPECT_EQ(map.component_count(), 1);
}

// Gateways of the start: 0 to 3; of the new place: 4 to 6, entered by 5.
TEST(WorkingMap, ANewPlacePutsItsOtherGatewaysWhereTheDepartingOneWas) {
  const Stars stars;
  WorkingMap map(stars.catalogue(), WorkingMap::Rings::kFaces);
  map.start(stars.crossing(), VisitId{0});
  map.apply({Kind::kPlace, stars.tee(), VisitId{1}, 1, 1});
  EXPECT_THAT(ring_from(map, 0), ElementsAre(0, 6, 4, 2, 3));
  EXPECT_EQ(map.leads_to(1), 5);
  EXPECT_EQ(map.path_count(), 3);
}

TEST(WorkingMap, ALinkCutsItsFaceInTwo) {
  const Stars stars;
  WorkingMap map(stars.catalogue(), WorkingMap::Rings::kFaces);
  map.start(stars.crossing(), VisitId{0});
  map.apply({Kind::kPlace, stars.tee(), VisitId{1}, 1, 1});
  map.apply({Kind::kLink, {}, VisitId{2}, 2, 0});
  EXPECT_THAT(ring_from(map, 3), ElementsAre(3));
  EXPECT_THAT(ring_from(map, 6), ElementsAre(6, 4));
}

TEST(WorkingMap, RingsAndCountsAgreeWithARecountAfterEveryChange) {
  const Stars stars;
  for (const auto rings : {WorkingMap::Rings::kFaces, WorkingMap::Rings::kOne}) {
    for (unsigned seed = 0; seed < 150; ++seed) {
      SCOPED_TRACE(seed);
      RandomChanges changes(stars, seed);
      WorkingMap map(stars.catalogue(), rings);
      map.start(stars.all()[seed % stars.all().size()], VisitId{0});
      for (int step = 0; step < 30 && !HasFailure(); ++step) {
        if (const std::optional<MapChange> change = changes.next(map)) {
          SCOPED_TRACE("step " + std::to_string(step) + ", kind " +
                       std::to_string(static_cast<int>(change->kind)));
          map.apply(*change);
          expect_sound(map);
        }
      }
    }
  }
}

TEST(WorkingMap, EveryChangeCanBeTakenBack) {
  const Stars stars;
  for (const auto rings : {WorkingMap::Rings::kFaces, WorkingMap::Rings::kOne}) {
    for (unsigned seed = 0; seed < 150; ++seed) {
      SCOPED_TRACE(seed);
      RandomChanges changes(stars, seed);
      WorkingMap map(stars.catalogue(), rings);
      map.start(stars.crossing(), VisitId{0});
      std::vector<std::pair<MapChange, decltype(described(map))>> done;
      for (int step = 0; step < 80 && !HasFailure(); ++step) {
        const bool takes_back = changes.below(3) == 0 && !done.empty();
        const std::optional<MapChange> change = changes.next(map);
        if (takes_back) {
          SCOPED_TRACE("kind " + std::to_string(static_cast<int>(done.back().first.kind)));
          map.undo(done.back().first);
          EXPECT_EQ(described(map), done.back().second);
          done.pop_back();
        } else if (change) {
          done.emplace_back(*change, described(map));
          map.apply(*change);
        }
      }
      for (; !done.empty() && !HasFailure(); done.pop_back()) {
        map.undo(done.back().first);
        EXPECT_EQ(described(map), done.back().second);
      }
    }
  }
}

TEST(WorkingMap, AStrayPlaceIsAPartOfItsOwnUntilALinkJoinsIt) {
  const Stars stars;
  WorkingMap map(stars.catalogue(), WorkingMap::Rings::kFaces);
  map.start(stars.corner(), VisitId{0});
  map.apply({Kind::kPlace, stars.corner(), VisitId{1}, 0, 1});
  map.apply({Kind::kStrayPlace, stars.tee(), VisitId{2}, 0, 1});
  EXPECT_EQ(map.component_count(), 2);
  EXPECT_EQ(map.one_way_count(), 1);
  EXPECT_THAT(ring_from(map, 4), ElementsAre(4, 6));
  map.apply({Kind::kLink, {}, VisitId{3}, 1, 4});
  EXPECT_EQ(map.component_count(), 1);
  EXPECT_THAT(ring_from(map, 2), ElementsAre(2, 6));
}

}  // namespace
}  // namespace cairn
