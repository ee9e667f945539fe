#include "topology/reading_match.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "star/star_edits.hpp"
#include "support/random_star.hpp"
#include "support/stars.hpp"

namespace cairn::test {
namespace {

using ::testing::ElementsAre;

constexpr double kMisread = 4.0;
constexpr double kMissed = 5.0;
constexpr double kFalse = 6.0;
constexpr MisreadingCosts kTolerant{kMisread, kMissed, kFalse};
constexpr MisreadingCosts kStrict;

View seen(const Star& star, int arrival_gateway) {
  return {star, arrival_gateway, VisitId{1}};
}

/// A corridor 0-3 with two stems on the same side.
Star corridor_with_two_stems() {
  return star_of({0, 1, 2, 3, -1, -1}, {3, 4, 5, 0, 1, 2});
}

TEST(ReadingMatch, TheSameStarIsOfThePlaceAtNoCost) {
  const ReadingMatch match = match_reading(seen(tee(), 2), rotated_to(tee(), 1), 1, kStrict);
  EXPECT_EQ(match, (ReadingMatch{0.0, Misreading::kNone, 0, 0, {2, 0, 1}}));
}

TEST(ReadingMatch, ATeeIsACrossingWithAMissedGateway) {
  // By the stem: the way straight on was missed.
  const ReadingMatch by_stem = match_reading(seen(tee(), 1), crossing(), 0, kTolerant);
  EXPECT_EQ(by_stem, (ReadingMatch{-kMissed, Misreading::kMissedGateway, 0, 1, {3, 0, 1}}));
  // Along the bar from gateway 0: that to the right, counterclockwise of the arrival.
  const ReadingMatch by_arm = match_reading(seen(tee(), 0), crossing(), 2, kTolerant);
  EXPECT_EQ(by_arm, (ReadingMatch{-kMissed, Misreading::kMissedGateway, 0, 1, {2, 3, 0}}));
}

TEST(ReadingMatch, ACorridorIsATeeWithAMissedStem) {
  const ReadingMatch match = match_reading(seen(corridor(), 0), tee(), 2, kTolerant);
  EXPECT_EQ(match, (ReadingMatch{-kMissed, Misreading::kMissedGateway, 0, 1, {2, 0}}));
  const ReadingMatch from_stem = match_reading(seen(corridor(), 0), tee(), 1, kTolerant);
  EXPECT_EQ(from_stem.log_likelihood, -kMissed - kMisread) << "the fragments were misread, too";
  EXPECT_EQ(from_stem.alternatives, 0);
}

TEST(ReadingMatch, ACornerIsATeeWithAMissedArm) {
  const ReadingMatch only_right = match_reading(seen(corner(), 1), tee(), 1, kTolerant);
  EXPECT_EQ(only_right, (ReadingMatch{-kMissed, Misreading::kMissedGateway, 0, 1, {0, 1}}));
  const ReadingMatch only_left = match_reading(seen(corner(), 0), tee(), 1, kTolerant);
  EXPECT_EQ(only_left, (ReadingMatch{-kMissed, Misreading::kMissedGateway, 0, 1, {1, 2}}));
  // Along the bar: if the other arm is missed, only the stem is left, on the left.
  const View left = seen(corner(), 0);
  const View right = seen(corner(), 1);
  EXPECT_EQ(match_reading(left, tee(), 0, kTolerant).log_likelihood, -kMissed);
  EXPECT_EQ(match_reading(right, tee(), 0, kTolerant).log_likelihood, -kMissed - kMisread);
}

TEST(ReadingMatch, AFalseGatewayIsNoneOfThePlace) {
  const auto false_gateway = [](const View& view, const Star& place, int by) {
    const ReadingMatch match = match_reading(view, place, by, kTolerant);
    EXPECT_EQ(match.misreading, Misreading::kFalseGateway);
    EXPECT_EQ(match.log_likelihood, -kFalse);
    EXPECT_EQ(match.alternatives, 1);
    return match.gateway_of_view;
  };
  EXPECT_THAT(false_gateway(seen(crossing(), 3), tee(), 1), ElementsAre(2, -1, 0, 1));
  EXPECT_THAT(false_gateway(seen(tee(), 0), corridor(), 1), ElementsAre(1, -1, 0));
  EXPECT_THAT(false_gateway(seen(tee(), 1), corner(), 1), ElementsAre(0, 1, -1));
  EXPECT_THAT(false_gateway(seen(tee(), 1), corner(), 0), ElementsAre(-1, 0, 1));
}

TEST(ReadingMatch, OtherFragmentsOfTheSameGatewaysAreMisread) {
  const Star two_bends = star_of({0, 1, 2, 3}, {1, 0, 3, 2});
  const ReadingMatch match = match_reading(seen(two_bends, 0), crossing(), 3, kTolerant);
  EXPECT_EQ(match, (ReadingMatch{-kMisread, Misreading::kFragments, 0, 0, {3, 0, 1, 2}}));
}

TEST(ReadingMatch, OfGatewaysThatCouldBeMissedTheFirstClockwiseFromTheArrivalIsTaken) {
  const ReadingMatch match = match_reading(seen(tee(), 0), corridor_with_two_stems(), 0, kTolerant);
  EXPECT_EQ(match, (ReadingMatch{-kMissed, Misreading::kMissedGateway, 0, 2, {0, 2, 3}}));
  const ReadingMatch reverse =
      match_reading(seen(corridor_with_two_stems(), 3), tee(), 2, kTolerant);
  EXPECT_EQ(reverse, (ReadingMatch{-kFalse, Misreading::kFalseGateway, 0, 2, {0, -1, 1, 2}}));
}

TEST(ReadingMatch, StarsThatDifferByMoreThanOneGatewayAreOfDifferentPlaces) {
  EXPECT_FALSE(match_reading(seen(corridor(), 0), crossing(), 0, kTolerant).is_possible());
  EXPECT_FALSE(match_reading(seen(crossing(), 0), dead_end(), 0, kTolerant).is_possible());
  const Star two_bends = star_of({0, 1, 2, 3}, {1, 0, 3, 2});
  const ReadingMatch one_less = match_reading(seen(tee(), 1), two_bends, 0, kTolerant);
  EXPECT_EQ(one_less.log_likelihood, -kMissed - kMisread);
}

TEST(ReadingMatch, WhichGatewayWasMissedMayBeChosen) {
  const View view = seen(tee(), 0);
  const Star place = corridor_with_two_stems();
  const ReadingMatch first = match_reading(view, place, 0, kTolerant);
  ASSERT_EQ(choice_count(view, first), 3);
  EXPECT_THAT(first.gateway_of_view, ElementsAre(0, 2, 3));
  const ReadingMatch second = match_reading(view, place, 0, kTolerant, 1);
  EXPECT_EQ(second.log_likelihood, -kMissed);
  const ReadingMatch third = match_reading(view, place, 0, kTolerant, 2);
  EXPECT_EQ(third.log_likelihood, -kMissed - kMisread) << "then the fragments differ";
  EXPECT_NE(second.gateway_of_view, first.gateway_of_view);
  EXPECT_NE(third.gateway_of_view, second.gateway_of_view);
}

TEST(ReadingMatch, NothingButExactAgreementCountsAtInfiniteCosts) {
  EXPECT_FALSE(match_reading(seen(tee(), 1), crossing(), 0, kStrict).is_possible());
  EXPECT_FALSE(match_reading(seen(crossing(), 0), tee(), 1, kStrict).is_possible());
  EXPECT_FALSE(match_reading(seen(corner(), 0), corridor(), 0, kStrict).is_possible());
  EXPECT_TRUE(match_reading(seen(corner(), 0), corner(), 0, kStrict).is_possible());
}

TEST(ReadingMatch, TheReadingThatFitsBestIsTakenWithItsOwnLikelihood) {
  View corridor_or_tee = seen(corridor(), 1);
  corridor_or_tee.others.push_back({rotated_to(tee(), 2), {1, 0, -1}, -3.0});
  // The tee is entered along its bar, the stem being on the right.
  EXPECT_EQ(match_reading(corridor_or_tee, tee(), 2, kTolerant),
            (ReadingMatch{-3.0, Misreading::kNone, 1, 0, {0, 2}}));
  EXPECT_EQ(match_reading(corridor_or_tee, tee(), 2, {kMisread, 2.0, kFalse}),
            (ReadingMatch{-2.0, Misreading::kMissedGateway, 0, 1, {0, 2}}));
  EXPECT_EQ(match_reading(corridor_or_tee, tee(), 2, {kMisread, 3.0, kFalse}).reading, 0);
  EXPECT_EQ(match_reading(corridor_or_tee, crossing(), 2, kTolerant),
            (ReadingMatch{-3.0 - kMissed, Misreading::kMissedGateway, 1, 1, {0, 2}}));
}

TEST(ReadingMatch, AGatewayThatTheBestReadingLacksIsNoneOfThePlace) {
  View tee_or_corridor = seen(tee(), 0);
  tee_or_corridor.others.push_back({corridor(), {0, 2}, -1.0});
  EXPECT_EQ(match_reading(tee_or_corridor, corridor(), 1, kTolerant),
            (ReadingMatch{-1.0, Misreading::kNone, 1, 0, {1, -1, 0}}));
}

TEST(ReadingMatch, ARecalledStarIsTheOneThatItWasRecalledFrom) {
  // Seen as a corner of two gateways, by which the robot came and left; the crossing was recalled.
  View view = seen(corner(), 0);
  Reading recalled{crossing(), {0, -1, 1, -1}, -2.0};
  recalled.is_recalled = true;
  view.others.push_back(recalled);
  EXPECT_EQ(match_reading(view, crossing(), 2, kTolerant),
            (ReadingMatch{-2.0, Misreading::kNone, 1, 0, {2, 0}}));
}

TEST(ReadingMatch, ARecalledStarComesBeforeAMisreadOneButAfterOneThatWasSeen) {
  View view = seen(tee(), 0);
  Reading recalled{crossing(), {0, 1, 2, -1}, -9.0};
  recalled.is_recalled = true;
  view.others.push_back(recalled);
  EXPECT_EQ(match_reading(view, crossing(), 0, kTolerant).reading, 1) << "a missed gateway costs 5";
  EXPECT_EQ(match_reading(view, tee(), 0, kTolerant).reading, 0);
  view.others[0].is_recalled = false;
  EXPECT_EQ(match_reading(view, crossing(), 0, kTolerant).reading, 0);
}

TEST(ReadingMatch, OfReadingsThatFitEquallyWellTheFirstIsTaken) {
  const Star two_bends = star_of({0, 1, 2, 3}, {1, 0, 3, 2});
  View view = seen(tee(), 1);
  view.others.push_back({two_bends, {1, 2, -1, 0}, -1.0});
  // A missed gateway (5), or fragments misread (1 + 4).
  EXPECT_EQ(match_reading(view, crossing(), 0, kTolerant).reading, 0);
  EXPECT_EQ(match_reading(view, crossing(), 0, {3.5, kMissed, kFalse}).reading, 1);

  View same_twice = seen(corridor(), 0);
  same_twice.others.push_back({corridor(), {0, -1}, 0.0});
  StarCatalogue stars;
  const StarId star = stars.add(corridor());
  EXPECT_EQ(ReadingMatcher(same_twice, stars, kStrict).match(star, 1),
            (ReadingMatch{0.0, Misreading::kNone, 0, 0, {1, 0}}));
}

struct Misread {
  Star full;
  int full_entry = 0;
  int gone = 0;
  Star reduced;
  int reduced_entry = 0;
};

/// A star, and what remains of it without one gateway that is not the one of entry.
Misread random_misread(std::mt19937& random) {
  Misread drawn;
  drawn.full = random_star(2 + random() % 5, random);
  const int gateways = gateway_count(drawn.full);
  drawn.full_entry = random_below(gateways, random);
  drawn.gone = (drawn.full_entry + 1 + random_below(gateways - 1, random)) % gateways;
  const Star rest = *without_gateway(drawn.full, drawn.gone);
  const int first = random_below(gateways - 1, random);
  const int entry = drawn.full_entry - (drawn.full_entry > drawn.gone ? 1 : 0);
  drawn.reduced = rotated_to(rest, first);
  drawn.reduced_entry = (entry - first + gateways - 1) % (gateways - 1);
  return drawn;
}

/// What must hold of the way in which gateways correspond: clockwise from the arrival.
void expect_clockwise(const std::vector<int>& partners, int from, int to, int count) {
  EXPECT_EQ(partners[static_cast<std::size_t>(from)], to);
  int last_step = -1;
  for (std::size_t step = 0; step < partners.size(); ++step) {
    const int partner = partners[(static_cast<std::size_t>(from) + step) % partners.size()];
    if (partner >= 0) {
      EXPECT_GT((partner - to + count) % count, last_step);
      last_step = (partner - to + count) % count;
    }
  }
}

TEST(ReadingMatch, FindsTheMissedAndTheFalseGatewayOfAnyStar) {
  for (unsigned seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const Misread drawn = random_misread(random);
    const int gateways = gateway_count(drawn.full);

    const ReadingMatch missed = match_reading(seen(drawn.reduced, drawn.reduced_entry), drawn.full,
                                              drawn.full_entry, kTolerant);
    const ReadingMatch added = match_reading(seen(drawn.full, drawn.full_entry), drawn.reduced,
                                             drawn.reduced_entry, kTolerant);

    ASSERT_EQ(missed.misreading, Misreading::kMissedGateway);
    ASSERT_EQ(added.misreading, Misreading::kFalseGateway);
    EXPECT_EQ(missed.alternatives, added.alternatives);
    expect_clockwise(missed.gateway_of_view, drawn.reduced_entry, drawn.full_entry, gateways);
    expect_clockwise(added.gateway_of_view, drawn.full_entry, drawn.reduced_entry, gateways - 1);
    if (missed.alternatives == 1) {
      EXPECT_EQ(added.gateway_of_view[static_cast<std::size_t>(drawn.gone)], -1);
      EXPECT_THAT(missed.gateway_of_view, ::testing::Not(::testing::Contains(drawn.gone)));
    }
  }
}

TEST(ReadingMatcher, SaysOfEveryStarWhatComparingItSays) {
  for (unsigned seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const Misread drawn = random_misread(random);
    View view = seen(drawn.full, drawn.full_entry);
    view.log_likelihood = -0.1 * random_below(3, random);
    std::vector<int> gateways(static_cast<std::size_t>(gateway_count(drawn.reduced)), -1);
    gateways[static_cast<std::size_t>(drawn.reduced_entry)] = drawn.full_entry;
    view.others.push_back({drawn.reduced, gateways, -0.1});
    view.others.resize(seed % 3 == 0 ? 0 : 1);
    ASSERT_TRUE(validate(view).ok());
    StarCatalogue stars;
    stars.add(drawn.full);
    stars.add(drawn.reduced);
    const MisreadingCosts costs = seed % 2 == 0 ? kTolerant : kStrict;
    ReadingMatcher matcher(view, stars, costs);
    const ReadingMatch& early = matcher.match(StarId{1}, 0);
    const ReadingMatch early_copy = early;
    for (int star = 0; star < 20; ++star) {
      const StarId id = stars.add(star % 2 == 0 ? random_star(1 + random() % 3, random)
                                                : random_misread(random).reduced);
      for (int gateway = 0; gateway < stars.gateway_count(id); ++gateway) {
        const ReadingMatch compared = match_reading(view, stars.star(id), gateway, costs);
        EXPECT_EQ(matcher.match(id, gateway), compared);
        EXPECT_EQ(matcher.match(id, gateway), compared);
      }
    }
    EXPECT_EQ(early, early_copy);
  }
}

TEST(ReadingMatcher, KnowsExactAgreementWithTheLikeliestReading) {
  View view = seen(corridor(), 0);
  view.log_likelihood = -1.0;
  view.others.push_back({tee(), {0, -1, 1}, -0.5});
  StarCatalogue stars;
  const StarId of_corridor = stars.add(corridor());
  const StarId of_tee = stars.add(tee());
  const StarId of_turned_tee = stars.add(rotated_to(tee(), 2));
  ReadingMatcher matcher(view, stars, kStrict);
  EXPECT_TRUE(matcher.is_exact(of_tee, 0));
  EXPECT_TRUE(matcher.is_exact(of_turned_tee, 1));
  EXPECT_FALSE(matcher.is_exact(of_tee, 2));
  EXPECT_FALSE(matcher.is_exact(of_corridor, 0));
  EXPECT_EQ(matcher.match(of_turned_tee, 1), (ReadingMatch{-0.5, Misreading::kNone, 1, 0, {1, 0}}));
  EXPECT_EQ(matcher.match(of_corridor, 0), (ReadingMatch{-1.0, Misreading::kNone, 0, 0, {0, 1}}));
  EXPECT_FALSE(matcher.match(of_tee, 1).is_possible());
}

}  // namespace
}  // namespace cairn::test
