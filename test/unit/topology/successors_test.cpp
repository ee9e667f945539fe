#include "topology/successors.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "arrivals.hpp"
#include "star/star_edits.hpp"
#include "support/stars.hpp"

namespace cairn::test {
namespace {

using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr GatewayRef kNowhere{};

/// The first alternative that leads there.
const Alternative& to(const std::vector<Alternative>& all, GatewayRef target) {
  for (const Alternative& alternative : all) {
    if (alternative.target == target) {
      return alternative;
    }
  }
  ADD_FAILURE() << "no alternative leads there";
  return all.front();
}

std::vector<Alternative> of_kind(const std::vector<Alternative>& all, StepKind kind) {
  std::vector<Alternative> found;
  std::copy_if(all.begin(), all.end(), std::back_inserter(found), [&](const Alternative& one) {
    return one.kind == kind && one.refuted_by == Refutation::kNone;
  });
  return found;
}

TopologyOptions noisy() {
  TopologyOptions options;
  options.noisy_stars = true;
  return options;
}

Evidence says(double log_ratio) {
  Evidence evidence;
  evidence.same_place = [=](SeenGateway, SeenGateway) { return log_ratio; };
  return evidence;
}

TEST(Successors, OfAKnownLinkIsOnePlaceIfTheViewAgrees) {
  Arrivals walked(corner(), 0);
  walked.add_place(0, tee(), 2);
  const auto agreed = walked.of(0, corner(), 0);
  ASSERT_THAT(agreed, SizeIs(1));
  EXPECT_EQ(agreed[0].kind, StepKind::kKnownLink);
  EXPECT_EQ(agreed[0].refuted_by, Refutation::kNone);
  EXPECT_EQ(agreed[0].target, (GatewayRef{PlaceId{0}, 0}));

  Arrivals again(corner(), 0);
  again.add_place(0, tee(), 2);
  EXPECT_EQ(again.of(0, corner(), 1)[0].refuted_by, Refutation::kOtherView);
}

TEST(Successors, FromAPendingGatewayAreTheOthersThatLookAlikeAndANewPlace) {
  Arrivals walked(corner(), 0);
  walked.add_place(0, corner(), 1).add_place(1, corner(), 1);
  const auto all = walked.of(1, corner(), 1);
  EXPECT_EQ(to(all, {PlaceId{0}, 1}).refuted_by, Refutation::kNone);
  EXPECT_EQ(to(all, {PlaceId{0}, 1}).kind, StepKind::kClosure);
  EXPECT_EQ(to(all, kNowhere).kind, StepKind::kNewPlace);

  Arrivals other_hand(corner(), 0);
  other_hand.add_place(0, corner(), 1).add_place(1, corner(), 1);
  EXPECT_EQ(to(other_hand.of(1, corner(), 0), {PlaceId{0}, 1}).refuted_by, Refutation::kOtherView);
}

TEST(Successors, DoNotPutAPlaceTwiceOnAPath) {
  Arrivals at(crossing(), 0);
  const auto all = at.of(0, crossing(), 0);
  for (const int gateway : {1, 2, 3}) {
    EXPECT_EQ(to(all, {PlaceId{0}, gateway}).refuted_by, Refutation::kPlaceTwiceOnPath);
  }
}

/// Around a roundabout: gateways 1 lie inside, 3 outside.
void go_around(Arrivals& walk) {
  walk.add_place(2, crossing(), 0).add_place(2, crossing(), 0).close(2, {PlaceId{0}, 0});
}

TEST(Successors, StayWithinOneFaceInThePlane) {
  Arrivals planar(crossing(), 0);
  go_around(planar);
  const auto inward = planar.of(1, crossing(), 0);
  EXPECT_EQ(to(inward, {PlaceId{1}, 1}).refuted_by, Refutation::kNone);
  EXPECT_EQ(to(inward, {PlaceId{1}, 3}).refuted_by, Refutation::kOtherFace);

  TopologyOptions options;
  options.planar = false;
  Arrivals spatial(crossing(), 0, options, {}, WorkingMap::Rings::kOne);
  go_around(spatial);
  EXPECT_EQ(to(spatial.of(1, crossing(), 0), {PlaceId{1}, 3}).refuted_by, Refutation::kNone);
}

TEST(Successors, PayForEachHandleIfAsked) {
  TopologyOptions options;
  options.planar = false;
  options.log_penalty_handle = 2.5;
  Arrivals walk(crossing(), 0, options);
  go_around(walk);
  const auto all = walk.of(1, crossing(), 0);
  EXPECT_DOUBLE_EQ(to(all, {PlaceId{1}, 1}).log_likelihood, 0.0);
  EXPECT_DOUBLE_EQ(to(all, {PlaceId{1}, 3}).log_likelihood, -2.5);
}

TEST(Successors, JoinAPartLeftByAContradictionToAnyFace) {
  for (const auto rings : {WorkingMap::Rings::kFaces, WorkingMap::Rings::kOne}) {
    TopologyOptions options;
    options.planar = rings == WorkingMap::Rings::kFaces;
    Arrivals walk(crossing(), 0, options, {}, rings);
    go_around(walk);
    walk.contradict(0, crossing(), 0);
    const auto all = walk.of(2, crossing(), 0);
    EXPECT_EQ(to(all, {PlaceId{1}, 1}).refuted_by, Refutation::kNone);
    EXPECT_EQ(to(all, {PlaceId{1}, 3}).refuted_by, Refutation::kNone);
  }
}

TEST(Successors, KeepTheSidesOfPathsApartIfAsked) {
  TopologyOptions options;
  Arrivals any(corner(), 0, options);
  any.add_place(0, corner(), 1);
  EXPECT_EQ(to(any.of(1, corner(), 1), {PlaceId{0}, 1}).refuted_by, Refutation::kNone);
  options.region_consistent = true;
  Arrivals consistent(corner(), 0, options);
  consistent.add_place(0, corner(), 1);
  EXPECT_EQ(to(consistent.of(1, corner(), 1), {PlaceId{0}, 1}).refuted_by, Refutation::kRegions);
}

TEST(Successors, EndAtTheBoundOfPlaces) {
  TopologyOptions options;
  options.max_places = 1;
  Arrivals at(corner(), 0, options);
  EXPECT_EQ(to(at.of(0, tee(), 0), kNowhere).refuted_by, Refutation::kTooManyPlaces);
}

TEST(Successors, EvidenceIsAskedForConsistentClosuresOnly) {
  int asked = 0;
  Evidence evidence;
  evidence.same_place = [&](SeenGateway known, SeenGateway now) {
    ++asked;
    EXPECT_EQ(known, (SeenGateway{VisitId{0}, 1}));
    EXPECT_EQ(now, (SeenGateway{VisitId{3}, 1}));
    return 2.5;
  };
  Arrivals walked(corner(), 0, {}, evidence);
  walked.add_place(0, corner(), 1).add_place(1, corner(), 1);
  const auto all = walked.of(1, corner(), 1);
  EXPECT_EQ(asked, 1);
  EXPECT_DOUBLE_EQ(to(all, {PlaceId{0}, 1}).log_likelihood, 2.5);
}

TEST(Successors, EvidenceIsCutUnlessItTellsItsBound) {
  Evidence evidence = says(30.0);
  Arrivals cut(corner(), 0, {}, evidence);
  EXPECT_DOUBLE_EQ(cut.add_place(0, tee(), 2).of(0, corner(), 0)[0].log_likelihood, 20.0);
  evidence.same_place_bound = [](VisitId) { return 30.0; };
  Arrivals told(corner(), 0, {}, evidence);
  EXPECT_DOUBLE_EQ(told.add_place(0, tee(), 2).of(0, corner(), 0)[0].log_likelihood, 30.0);
}

TEST(Successors, MinusInfinityRefutes) {
  Arrivals walked(corner(), 0, {}, says(-kInfinity));
  walked.add_place(0, corner(), 1).add_place(1, corner(), 1);
  EXPECT_EQ(to(walked.of(1, corner(), 1), {PlaceId{0}, 1}).refuted_by, Refutation::kEvidence);
}

TEST(Successors, AnOperatorRefutesWhatHeExcludes) {
  Arrivals walked(corner(), 0);
  walked.add_place(0, corner(), 1).add_place(1, corner(), 1);
  walked.of(1, corner(), 1);
  const auto must = walked.of_last({PlaceId{0}, {}});
  EXPECT_EQ(to(must, {PlaceId{0}, 1}).refuted_by, Refutation::kNone);
  EXPECT_EQ(to(must, kNowhere).refuted_by, Refutation::kOperator);
  const auto must_not = walked.of_last({std::nullopt, {PlaceId{0}}});
  EXPECT_EQ(to(must_not, {PlaceId{0}, 1}).refuted_by, Refutation::kOperator);
  EXPECT_EQ(to(must_not, kNowhere).refuted_by, Refutation::kNone);
}

TEST(Successors, AMisreadStarIsBlamedInANoisyWorldOnly) {
  Arrivals strict(corner(), 0, {}, says(15.0));
  EXPECT_THAT(strict.add_place(0, tee(), 2).of(0, corridor(), 0), SizeIs(1));
  const TopologyOptions options = noisy();
  Arrivals walked(corner(), 0, options, says(15.0));
  const auto all = walked.add_place(0, tee(), 2).of(0, corridor(), 0);
  EXPECT_EQ(all[0].refuted_by, Refutation::kOtherView);
  const auto misread = of_kind(all, StepKind::kMisread);
  ASSERT_THAT(misread, SizeIs(1));
  EXPECT_EQ(misread[0].misreading, Misreading::kFragments);
  EXPECT_DOUBLE_EQ(misread[0].log_likelihood, 15.0 - options.log_penalty_misread);
  // Two gateways more than the corner has: this cannot be one misreading.
  Arrivals other(corner(), 0, options, says(15.0));
  const auto crossed = other.add_place(0, tee(), 2).of(0, crossing(), 0);
  EXPECT_THAT(of_kind(crossed, StepKind::kMisread), IsEmpty());
  EXPECT_THAT(of_kind(crossed, StepKind::kAmended), IsEmpty());
}

TEST(Successors, StrongEvidenceClosesALoopDespiteAMisreadStar) {
  const Star both_end = star_of({0, 1, -1, -1}, {3, 2, 1, 0});
  const TopologyOptions options = noisy();
  const double in_vain = -options.blame_margin;
  for (const double ratio : {15.0, in_vain}) {
    Arrivals walked(corner(), 0, options, says(ratio));
    walked.add_place(0, corner(), 1).add_place(1, corner(), 1);
    const auto all = walked.of(1, both_end, 1);
    EXPECT_EQ(to(all, {PlaceId{0}, 1}).refuted_by, Refutation::kOtherView);
    EXPECT_THAT(of_kind(all, StepKind::kNewPlace), SizeIs(1));
    const auto misread = of_kind(all, StepKind::kMisread);
    ASSERT_THAT(misread, SizeIs(ratio > in_vain ? 1 : 0));
    if (!misread.empty()) {
      EXPECT_EQ(walked.after(misread[0]).pending_count(), 0);
    }
  }
}

TEST(Successors, StrongEvidenceOverrulesLinksWhereASurpriseAllowsIt) {
  const TopologyOptions options = noisy();
  Evidence evidence;
  evidence.same_place = [](SeenGateway known, SeenGateway now) {
    return known == SeenGateway{VisitId{1}, 2} && now == SeenGateway{VisitId{4}, 2} ? 20.0 : -20.0;
  };
  Arrivals walked(corner(), 0, options, evidence);
  walked.add_place(0, tee(), 2).follow(0, corner(), 0).add_place(1, corner(), 1);
  EXPECT_THAT(of_kind(walked.of(1, tee(), 2), StepKind::kRejoin), IsEmpty());
  const auto rejoined = of_kind(walked.of_last_anywhere(), StepKind::kRejoin);
  ASSERT_THAT(rejoined, SizeIs(1));
  EXPECT_EQ(rejoined[0].target, (GatewayRef{PlaceId{1}, 2}));  // It is linked elsewhere.
  // One gateway of the map looks like the view, so nothing is due to chance.
  EXPECT_DOUBLE_EQ(rejoined[0].log_likelihood, 20.0 - options.log_penalty_break);
  EXPECT_EQ(walked.after(rejoined[0]).one_way_count(), 1);
}

/// The way between visits is known; so likely is each place before maps are compared.
Evidence where_the_way_is_known(double log_ratio, double log_prior) {
  Evidence evidence = says(log_ratio);
  evidence.log_prior_same = [=](VisitId, VisitId) { return log_prior; };
  return evidence;
}

TEST(Successors, AJunctionThatNobodyNoticedLeadsToAPlaceWhoseGatewayIsLinked) {
  const TopologyOptions options = noisy();
  Arrivals walked(corner(), 0, options, where_the_way_is_known(6.0, -1.0));
  walked.add_place(0, dead_end(), 0).follow(0, corner(), 0);
  // By the pending gateway 1 of place 0, to where only place 1 looks like it: by its linked
  // gateway.
  const auto rejoined = of_kind(walked.of(1, dead_end(), 0), StepKind::kRejoin);
  ASSERT_THAT(rejoined, SizeIs(1));
  EXPECT_EQ(rejoined[0].target, (GatewayRef{PlaceId{1}, 0}));
  EXPECT_DOUBLE_EQ(rejoined[0].log_likelihood, 6.0 - 1.0 - options.log_penalty_junction);
  EXPECT_EQ(walked.after(rejoined[0]).one_way_count(), 1) << "the link of place 1 stays";
}

TEST(Successors, AJunctionThatNobodyNoticedLeadsOffAKnownLink) {
  const TopologyOptions options = noisy();
  Arrivals walked(corner(), 0, options, where_the_way_is_known(-6.0, 0.0));
  walked.add_place(0, tee(), 2);
  const auto branched = of_kind(walked.of(0, crossing(), 1), StepKind::kBranch);
  ASSERT_THAT(branched, SizeIs(1));
  EXPECT_DOUBLE_EQ(branched[0].log_likelihood,
                   options.log_prior_new_place - options.log_penalty_junction);
  EXPECT_EQ(walked.after(branched[0]).place_count(), 3);
  Arrivals unknown_way(corner(), 0, options, says(-6.0));
  unknown_way.add_place(0, tee(), 2);
  EXPECT_THAT(of_kind(unknown_way.of(0, crossing(), 1), StepKind::kBranch), IsEmpty());
}

TEST(Successors, AClosureIsAsLikelyAsTheWayMakesIt) {
  Arrivals walked(corner(), 0, noisy(), where_the_way_is_known(0.0, -2.5));
  walked.add_place(0, corner(), 1).add_place(1, corner(), 1);
  EXPECT_DOUBLE_EQ(to(walked.of(1, corner(), 1), {PlaceId{0}, 1}).log_likelihood,
                   -2.5 - std::log(2.0))
      << "one of two gateways";
}

TEST(Successors, PlacesThatNoLinkLeadsToAreLookedForWithinReach) {
  Evidence evidence = where_the_way_is_known(6.0, 0.0);
  evidence.is_within_reach = [](VisitId known, VisitId) { return known != VisitId{1}; };
  Arrivals walked(corner(), 0, noisy(), evidence);
  walked.add_place(0, dead_end(), 0).follow(0, corner(), 0);
  for (const Alternative& rejoined : of_kind(walked.of(1, dead_end(), 0), StepKind::kRejoin)) {
    EXPECT_NE(rejoined.target.place, PlaceId{1});
  }
}

TEST(Successors, NoNewPlaceHasAStarThatWasRecalled) {
  View view{corner(), 0, {}};
  Reading recalled{crossing(), {0, 1, -1, -1}, -1.0};
  recalled.is_recalled = true;
  view.others.push_back(recalled);
  Arrivals walked(corner(), 0, noisy(), where_the_way_is_known(0.0, 0.0));
  walked.add_place(0, tee(), 2);
  EXPECT_THAT(of_kind(walked.of(1, view), StepKind::kNewPlace), SizeIs(1));
  EXPECT_THAT(of_kind(walked.of(0, view), StepKind::kInserted), IsEmpty());
}

TEST(Successors, ARecalledStarMayLackTheGatewayOfArrivalToo) {
  // Place 0, a tee, is entered by a fourth gateway that its visit missed; now a corner was seen.
  View view{corner(), 0, {}};
  Reading recalled{with_gateway(tee(), 1), {-1, 0, 1, -1}, -1.0};
  recalled.is_recalled = true;
  view.others.push_back(recalled);
  Arrivals walked(tee(), 0, noisy(), where_the_way_is_known(15.0, 0.0));
  walked.add_place(1, corner(), 0);
  const auto amended = of_kind(walked.of(1, view), StepKind::kAmended);
  const auto to_place_0 = std::find_if(amended.begin(), amended.end(), [](const Alternative& one) {
    return one.target == GatewayRef{PlaceId{0}, 1} && one.misreading == Misreading::kMissedGateway;
  });
  ASSERT_NE(to_place_0, amended.end());
  EXPECT_EQ(walked.after(*to_place_0).gateway_count(PlaceId{0}), 4);
}

TEST(Successors, ACorridorOfAnEarlierContradictionMayBeTakenAgain) {
  Arrivals broken(corner(), 0);
  broken.add_place(0, tee(), 2).follow(0, corner(), 0);
  broken.contradict(0, dead_end(), 0).follow(0, corner(), 0);
  EXPECT_EQ(broken.position(), (GatewayRef{PlaceId{0}, 0}));
  const auto all = broken.of(0, dead_end(), 0);
  ASSERT_THAT(all, SizeIs(2));
  EXPECT_EQ(all[0].refuted_by, Refutation::kOtherView);
  EXPECT_EQ(all[1].kind, StepKind::kRejoin);
  EXPECT_EQ(all[1].target, (GatewayRef{PlaceId{2}, 0}));
}

TEST(Successors, LeaveTheMapAsItWas) {
  Arrivals walked(corner(), 0, noisy(), says(15.0));
  walked.add_place(0, tee(), 2).follow(0, corner(), 0).contradict(0, corner(), 1);
  const int pending = walked.map().pending_count();
  const GatewayIndex end = walked.map().end_gateway();
  EXPECT_GT(walked.of(1, tee(), 2).size(), 2U);
  EXPECT_EQ(walked.map().pending_count(), pending);
  EXPECT_EQ(walked.map().end_gateway(), end);
  EXPECT_EQ(walked.map().place_count(), 3);
}

TEST(SuccessorsDeathTest, EvidenceMustBeANumber) {
  Arrivals walked(corner(), 0, {}, says(std::numeric_limits<double>::quiet_NaN()));
  walked.add_place(0, tee(), 2);
  EXPECT_DEATH(walked.of(0, corner(), 0), "ratio");
}

}  // namespace
}  // namespace cairn::test
