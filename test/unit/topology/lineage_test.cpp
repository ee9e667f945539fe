#include "topology/lineage.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/stars.hpp"

namespace cairn::test {
namespace {

using ::testing::ElementsAre;
using ::testing::Pair;

constexpr VisitId visit(int number) {
  return {number};
}

/// An experience that begins at a dead end, and what one hypothesis makes of it, node by node.
struct Told {
  Told() : experience(stars, {1.0, 1.0, 1.0}) {
    TreeNode root;
    root.change = {MapChange::Kind::kNothing, tell(0, dead_end(), 0), visit(0), -1, -1};
    root.visit = visit(0);
    root.position = 0;
    last = nodes.add_root(root);
  }
  StarId tell(int turn, const Star& star, int arrival_gateway) {
    const VisitId next{experience.size()};
    experience.add({turn}, {star, arrival_gateway, next}, false);
    return experience.matcher(next).star_id(0);
  }
  void add(const MapChange& change, VisitId at, GatewayIndex position, bool is_part = false) {
    TreeNode node;
    node.change = change;
    node.visit = at;
    node.position = position;
    node.is_part = is_part;
    last = nodes.add(last, node);
  }
  Lineage lineage() const { return {nodes, experience, stars, WorkingMap::Rings::kFaces, last}; }

  StarCatalogue stars;
  ExperienceLog experience;
  TreeNodes nodes;
  NodeIndex last = kNoNode;
};

/// Visits to a place with the number of the gateway of arrival, the latest first.
std::vector<std::pair<int, int>> recorded(const WorkingMap& map, PlaceId place) {
  std::vector<std::pair<int, int>> visits;
  for (std::int32_t at = map.latest_record(place); at >= 0; at = map.record(at).previous) {
    visits.emplace_back(map.record(at).visit.value, map.record(at).number);
  }
  return visits;
}

TEST(Lineage, FollowsStepsAndKnownLinksThatLeftNoNode) {
  Told told;
  const StarId seen = told.tell(0, tee(), 2);
  told.add({MapChange::Kind::kPlace, seen, visit(1), 0, 2}, visit(1), 3);
  told.tell(0, dead_end(), 0);  // And back: nothing to note down.
  told.tell(0, tee(), 2);
  Lineage lineage = told.lineage();
  EXPECT_EQ(lineage.visit(), visit(0));
  lineage.advance();
  EXPECT_EQ(lineage.node(), told.last);
  EXPECT_EQ(lineage.position(), 3);
  lineage.advance();
  EXPECT_EQ(lineage.node(), told.last);
  EXPECT_EQ(lineage.position(), 0);
  lineage.advance();
  EXPECT_EQ(lineage.visit(), visit(3));
  const GatewayRef end{PlaceId{0}, 0};
  const GatewayRef arm{PlaceId{1}, 2};
  EXPECT_THAT(lineage.arrivals(), ElementsAre(end, arm, end, arm));
  EXPECT_THAT(recorded(lineage.map(), PlaceId{0}), ElementsAre(Pair(2, 0), Pair(0, 0)));
  EXPECT_THAT(recorded(lineage.map(), PlaceId{1}), ElementsAre(Pair(3, 2), Pair(1, 2)));
}

TEST(Lineage, RenumbersEarlierArrivalsWhenAStarIsCorrected) {
  // A tee, entered by an arm, was seen as a corridor; on the way back its stem is seen.
  Told told;
  const StarId seen = told.tell(0, corridor(), 1);
  told.add({MapChange::Kind::kPlace, seen, visit(1), 0, 1}, visit(1), 2);
  const StarId end = told.tell(1, dead_end(), 0);
  told.add({MapChange::Kind::kPlace, end, visit(2), 1, 0}, visit(2), 3);
  const StarId better = told.tell(0, tee(), 0);
  // Its gateways move to 4, 5, 6; the stem is number 1 among them.
  told.add({MapChange::Kind::kOtherStar, better, visit(3), 1, 1}, visit(3), 4, true);
  told.add({MapChange::Kind::kNothing, {}, visit(3), 3, 4}, visit(3), 4);
  Lineage lineage = told.lineage();
  for (int i = 0; i < 2; ++i) {
    lineage.advance();
  }
  EXPECT_THAT(lineage.arrivals()[1], (GatewayRef{PlaceId{1}, 1}));
  EXPECT_THAT(recorded(lineage.map(), PlaceId{1}), ElementsAre(Pair(1, 1)));
  lineage.advance();
  EXPECT_THAT(lineage.arrivals()[1], (GatewayRef{PlaceId{1}, 2}));
  EXPECT_EQ(lineage.map().star(PlaceId{1}), better);
  EXPECT_THAT(recorded(lineage.map(), PlaceId{1}), ElementsAre(Pair(3, 0), Pair(1, 2)))
      << "the stem has taken its number among the gateways of earlier visits, too";
  EXPECT_EQ(lineage.position(), 4);
}

}  // namespace
}  // namespace cairn::test
