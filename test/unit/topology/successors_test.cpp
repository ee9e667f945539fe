#include "topology/successors.hpp"

#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "map_builder.hpp"
#include "support/stars.hpp"

namespace cairn::test {
namespace {

using ::testing::SizeIs;

const Alternative& to(const std::vector<Alternative>& all, GatewayRef target) {
  for (const Alternative& alternative : all) {
    if (alternative.step.target == target) {
      return alternative;
    }
  }
  ADD_FAILURE() << "no alternative leads there";
  return all.front();
}

constexpr GatewayRef kNowhere{};

TEST(Alternatives, OfAKnownLinkIsOnePlaceIfTheViewAgrees) {
  MapBuilder walked = MapBuilder(corner(), 0).add_place(0, tee(), 2);
  const Arrival same = walked.arrive(corner(), 0);
  const auto agreed = alternatives(walked.map(), {0}, same, {}, {});
  ASSERT_THAT(agreed, SizeIs(1));
  EXPECT_EQ(agreed[0].refuted_by, Refutation::kNone);
  EXPECT_EQ(agreed[0].step.target, (GatewayRef{PlaceId{0}, 0}));

  const Arrival other_hand = walked.arrive(corner(), 1);
  EXPECT_EQ(alternatives(walked.map(), {0}, other_hand, {}, {})[0].refuted_by,
            Refutation::kOtherView);
}

TEST(Alternatives, FromAPendingGatewayAreTheOthersThatLookAlikeAndANewPlace) {
  MapBuilder walked = MapBuilder(corner(), 0).add_place(0, corner(), 1).add_place(1, corner(), 1);
  const auto all = alternatives(walked.map(), {1}, walked.arrive(corner(), 1), {}, {});
  EXPECT_EQ(to(all, {PlaceId{0}, 1}).refuted_by, Refutation::kNone);
  EXPECT_EQ(to(all, kNowhere).step.kind, StepKind::kNewPlace);
  const auto other_hand = alternatives(walked.map(), {1}, walked.arrive(corner(), 0), {}, {});
  EXPECT_EQ(to(other_hand, {PlaceId{0}, 1}).refuted_by, Refutation::kOtherView);
}

TEST(Alternatives, DoNotPutAPlaceTwiceOnAPath) {
  MapBuilder at(crossing(), 0);
  const auto all = alternatives(at.map(), {0}, at.arrive(crossing(), 0), {}, {});
  for (const int gateway : {1, 2, 3}) {
    EXPECT_EQ(to(all, {PlaceId{0}, gateway}).refuted_by, Refutation::kPlaceTwiceOnPath);
  }
}

TEST(Alternatives, StayWithinOneFaceInThePlane) {
  // Around a roundabout: gateways 1 lie inside, 3 outside. The robot leaves inward.
  MapBuilder map = MapBuilder(crossing(), 0)
                       .add_place(2, crossing(), 0)
                       .add_place(2, crossing(), 0)
                       .close(2, {PlaceId{0}, 0});
  const Arrival arrival = map.arrive(crossing(), 0);
  TopologyOptions options;
  const auto planar = alternatives(map.map(), {1}, arrival, options, {});
  EXPECT_EQ(to(planar, {PlaceId{1}, 1}).refuted_by, Refutation::kNone);
  EXPECT_EQ(to(planar, {PlaceId{1}, 3}).refuted_by, Refutation::kOtherFace);
  options.planar = false;
  const auto bridged = alternatives(map.map(), {1}, arrival, options, {});
  EXPECT_EQ(to(bridged, {PlaceId{1}, 3}).refuted_by, Refutation::kNone);
}

TEST(Alternatives, JoinAPartLeftByAContradictionToAnyFace) {
  MapBuilder map = MapBuilder(crossing(), 0)
                       .add_place(2, crossing(), 0)
                       .add_place(2, crossing(), 0)
                       .close(2, {PlaceId{0}, 0});
  map.contradict(0, crossing(), 0);
  const auto all = alternatives(map.map(), {2}, map.arrive(crossing(), 0), {}, {});
  EXPECT_EQ(to(all, {PlaceId{1}, 1}).refuted_by, Refutation::kNone);
  EXPECT_EQ(to(all, {PlaceId{1}, 3}).refuted_by, Refutation::kNone);
}

TEST(Alternatives, KeepTheSidesOfPathsApartIfAsked) {
  MapBuilder walked = MapBuilder(corner(), 0).add_place(0, corner(), 1);
  const Arrival arrival = walked.arrive(corner(), 1);
  TopologyOptions options;
  EXPECT_EQ(to(alternatives(walked.map(), {1}, arrival, options, {}), {PlaceId{0}, 1}).refuted_by,
            Refutation::kNone);
  options.region_consistent = true;
  EXPECT_EQ(to(alternatives(walked.map(), {1}, arrival, options, {}), {PlaceId{0}, 1}).refuted_by,
            Refutation::kRegions);
}

TEST(Alternatives, EndAtTheBoundOfPlaces) {
  TopologyOptions options;
  options.max_places = 1;
  MapBuilder at(corner(), 0);
  EXPECT_EQ(to(alternatives(at.map(), {0}, at.arrive(tee(), 0), options, {}), kNowhere).refuted_by,
            Refutation::kTooManyPlaces);
}

TEST(Alternatives, EvidenceIsAskedForConsistentClosuresOnly) {
  MapBuilder walked = MapBuilder(corner(), 0).add_place(0, corner(), 1).add_place(1, corner(), 1);
  int asked = 0;
  Evidence evidence;
  evidence.same_place = [&](const TopologicalMap&, VisitId visit, PlaceId same_as, int shift) {
    ++asked;
    EXPECT_EQ(visit, VisitId{3});
    EXPECT_EQ(same_as, PlaceId{0});
    EXPECT_EQ(shift, 0);
    return 2.5;
  };
  const auto all = alternatives(walked.map(), {1}, walked.arrive(corner(), 1), {}, evidence);
  EXPECT_EQ(asked, 1);
  EXPECT_DOUBLE_EQ(to(all, {PlaceId{0}, 1}).log_likelihood, 2.5);
}

TEST(Alternatives, MinusInfinityRefutes) {
  MapBuilder walked = MapBuilder(corner(), 0).add_place(0, corner(), 1).add_place(1, corner(), 1);
  Evidence evidence;
  evidence.same_place = [](const TopologicalMap&, VisitId, PlaceId, int) {
    return -std::numeric_limits<double>::infinity();
  };
  const auto all = alternatives(walked.map(), {1}, walked.arrive(corner(), 1), {}, evidence);
  EXPECT_EQ(to(all, {PlaceId{0}, 1}).refuted_by, Refutation::kEvidence);
}

TEST(Alternatives, StrongEvidenceOverrulesAMisreadStar) {
  MapBuilder walked = MapBuilder(corner(), 0).add_place(0, tee(), 2);
  Evidence evidence;
  evidence.same_place = [](const TopologicalMap&, VisitId, PlaceId, int) { return 30.0; };
  const auto all = alternatives(walked.map(), {0}, walked.arrive(corridor(), 0), {}, evidence);
  ASSERT_THAT(all, SizeIs(2));
  EXPECT_EQ(all[0].refuted_by, Refutation::kOtherView);
  EXPECT_EQ(all[1].step.kind, StepKind::kMisread);
  EXPECT_DOUBLE_EQ(all[1].log_likelihood, 30.0 - TopologyOptions{}.log_penalty_misread);
  // Without the same number of gateways there is no shift.
  EXPECT_THAT(alternatives(walked.map(), {0}, walked.arrive(tee(), 0), {}, evidence), SizeIs(1));
}

TEST(Alternatives, StrongEvidenceClosesALoopDespiteAMisreadStar) {
  const Star both_end = star_of({0, 1, -1, -1}, {3, 2, 1, 0});
  MapBuilder walked = MapBuilder(corner(), 0).add_place(0, corner(), 1).add_place(1, corner(), 1);
  Evidence evidence;
  evidence.same_place = [](const TopologicalMap&, VisitId, PlaceId same_as, int) {
    return same_as == PlaceId{0} ? 30.0 : -30.0;
  };
  const Arrival arrival = walked.arrive(both_end, 1);
  const auto all = alternatives(walked.map(), {1}, arrival, {}, evidence);
  ASSERT_THAT(all, SizeIs(3));
  EXPECT_EQ(all[0].refuted_by, Refutation::kOtherView);
  EXPECT_EQ(all[1].step.kind, StepKind::kMisread);
  EXPECT_EQ(all[2].step.kind, StepKind::kNewPlace);
  TopologicalMap closed = walked.map();
  apply(all[1].step, arrival, closed);
  EXPECT_TRUE(closed.is_closed());
}

TEST(Alternatives, StrongEvidenceOverrulesALinkOfAContradictedMap) {
  Evidence evidence;
  evidence.same_place = [](const TopologicalMap&, VisitId, PlaceId, int) { return 30.0; };
  MapBuilder walked = MapBuilder(corner(), 0).add_place(0, tee(), 2).follow(0, corner(), 0);
  const GatewayRef linked{PlaceId{1}, 2};

  MapBuilder sound = walked;
  sound.add_place(1, corner(), 1);
  for (const Alternative& alternative :
       alternatives(sound.map(), {1}, sound.arrive(tee(), 2), {}, evidence)) {
    EXPECT_NE(alternative.step.kind, StepKind::kRejoin);
  }

  walked.contradict(0, corner(), 1);
  const auto all = alternatives(walked.map(), {1}, walked.arrive(tee(), 2), {}, evidence);
  EXPECT_EQ(to(all, linked).step.kind, StepKind::kRejoin);
  EXPECT_DOUBLE_EQ(to(all, linked).log_likelihood, 30.0 - TopologyOptions{}.log_penalty_break);
}

TEST(Alternatives, ACorridorOfAnEarlierContradictionMayBeTakenAgain) {
  MapBuilder broken = MapBuilder(corner(), 0).add_place(0, tee(), 2).follow(0, corner(), 0);
  broken.contradict(0, dead_end(), 0).follow(0, corner(), 0);
  EXPECT_EQ(broken.map().position(), (GatewayRef{PlaceId{0}, 0}));
  const auto all = alternatives(broken.map(), {0}, broken.arrive(dead_end(), 0), {}, {});
  ASSERT_THAT(all, SizeIs(2));
  EXPECT_EQ(all[0].refuted_by, Refutation::kOtherView);
  EXPECT_EQ(all[1].step.kind, StepKind::kRejoin);
  EXPECT_EQ(all[1].step.target, (GatewayRef{PlaceId{2}, 0}));
}

TEST(AlternativesDeathTest, EvidenceMustBeANumber) {
  MapBuilder walked = MapBuilder(corner(), 0).add_place(0, tee(), 2);
  Evidence evidence;
  evidence.same_place = [](const TopologicalMap&, VisitId, PlaceId, int) {
    return std::numeric_limits<double>::quiet_NaN();
  };
  const Arrival back = walked.arrive(corner(), 0);
  EXPECT_DEATH(alternatives(walked.map(), {0}, back, {}, evidence), "ratio");
}

}  // namespace
}  // namespace cairn::test
