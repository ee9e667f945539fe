#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "star/isomorphism.hpp"
#include "star/star_edits.hpp"
#include "support/random_star.hpp"
#include "support/stars.hpp"
#include "topology/reading_match.hpp"
#include "topology/working_map.hpp"

namespace cairn::test {
namespace {

using ::testing::ElementsAre;

constexpr MisreadingCosts kTolerant{1.0, 1.0, 1.0};

View seen(const Star& star, int arrival_gateway) {
  return {star, arrival_gateway, VisitId{1}};
}

TEST(AmendedStar, IsATeeWhereTheStemOfACorridorHadBeenMissed) {
  // In by the corridor's gateway 1, the stem is on the left: between gateways 1 and 0, clockwise.
  const std::optional<AmendedStar> stem_on_left = amended(seen(tee(), 0), 0, corridor(), 1);
  ASSERT_TRUE(stem_on_left);
  EXPECT_EQ(stem_on_left->changed_gateway, 2);
  EXPECT_EQ(stem_on_left->star, rotated_to(tee(), 2));
  EXPECT_THAT(stem_on_left->gateway_of_view, ElementsAre(1, 2, 0));
  // From gateway 0 it lies between 0 and 1.
  const std::optional<AmendedStar> from_the_other_end = amended(seen(tee(), 0), 0, corridor(), 0);
  ASSERT_TRUE(from_the_other_end);
  EXPECT_EQ(from_the_other_end->changed_gateway, 1);
  EXPECT_EQ(from_the_other_end->star, tee());
}

TEST(AmendedStar, LosesAGatewayThatIsNotThere) {
  const std::optional<AmendedStar> result = amended(seen(tee(), 1), 0, crossing(), 2);
  ASSERT_TRUE(result);
  EXPECT_EQ(result->changed_gateway, 0);
  EXPECT_EQ(result->star, tee());
  EXPECT_THAT(result->gateway_of_view, ElementsAre(0, 1, 2));
}

TEST(AmendedStar, KeepsItsGatewaysWhereFragmentsHadBeenMisread) {
  const Star bends = star_of({0, 1, 2, 3}, {1, 0, 3, 2});
  const std::optional<AmendedStar> result = amended(seen(bends, 0), 0, crossing(), 3);
  ASSERT_TRUE(result);
  EXPECT_EQ(result->changed_gateway, -1);
  EXPECT_EQ(result->star, rotated_to(bends, 1));
  EXPECT_THAT(result->gateway_of_view, ElementsAre(3, 0, 1, 2));
}

TEST(AmendedStar, DoesNotExistWhereNothingWouldChangeOrTooMuch) {
  EXPECT_FALSE(amended(seen(tee(), 0), 0, tee(), 0));
  EXPECT_FALSE(amended(seen(crossing(), 0), 0, corridor(), 0));
  EXPECT_TRUE(amended(seen(corridor(), 0), 0, tee(), 1)) << "its fragments were misread, too";
}

TEST(AmendedStar, CanBeThatOfAnotherReading) {
  View view = seen(corridor(), 1);
  view.others.push_back({tee(), {1, -1, 0}, -1.0});
  EXPECT_FALSE(amended(view, 0, corridor(), 0));
  const std::optional<AmendedStar> result = amended(view, 1, corridor(), 0);
  ASSERT_TRUE(result);
  EXPECT_EQ(result->star, tee());
  EXPECT_EQ(result->changed_gateway, 1);
  EXPECT_THAT(result->gateway_of_view, ElementsAre(2, 0));
}

/// The star without a gateway other than `entry`, told from anywhere; entry becomes its number.
Star misread(const Star& star, int& entry, std::mt19937& random) {
  const int left = gateway_count(star) - 1;
  const int gone = (entry + 1 + random_below(left, random)) % (left + 1);
  const int first = random_below(left, random);
  entry = (entry - (entry > gone ? 1 : 0) - first + left) % left;
  return rotated_to(*without_gateway(star, gone), first);
}

/// Where a working map puts the old gateway when the star is changed.
int renumbered(int old, int gateways_before, const AmendedStar& result) {
  const int more = gateway_count(result.star) - gateways_before;
  if (more > 0) {
    return old + (old >= result.changed_gateway ? 1 : 0);
  }
  return more < 0 && old > result.changed_gateway ? old - 1 : old;
}

/// That the amended star is what the view saw, and each gateway where the match says it is.
void expect_amends(const View& view, const Star& place, int entry) {
  const std::optional<AmendedStar> result = amended(view, 0, place, entry);
  const ReadingMatch match = match_reading(view, place, entry, kTolerant);
  ASSERT_TRUE(match.is_possible());
  ASSERT_EQ(result.has_value(), match.misreading != Misreading::kNone);
  if (!result) {
    return;
  }
  ASSERT_TRUE(validate(result->star).ok());
  for (std::size_t gateway = 0; gateway < match.gateway_of_view.size(); ++gateway) {
    const int now = result->gateway_of_view[gateway];
    EXPECT_EQ(view_code(result->star, now), view_code(view.star, static_cast<int>(gateway)));
    const int old = match.gateway_of_view[gateway];
    EXPECT_EQ(now,
              old < 0 ? result->changed_gateway : renumbered(old, gateway_count(place), *result));
  }
}

TEST(AmendedStar, IsTheTrueOneFromEveryGateway) {
  for (unsigned seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const Star truth = random_star(2 + seed % 5, random);
    const int entry = random_below(gateway_count(truth), random);
    int misread_entry = entry;
    const Star wrong = misread(truth, misread_entry, random);

    expect_amends(seen(truth, entry), wrong, misread_entry);
    expect_amends(seen(wrong, misread_entry), truth, entry);
  }
}

TEST(AmendedStar, IsTheTrueOneAlsoWhereOnlyFragmentsHadBeenMisread) {
  int compared = 0;
  for (unsigned seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const Star truth = random_star(2 + seed % 3, random);
    const Star wrong = random_star(2 + seed % 3, random);
    if (gateway_count(truth) == gateway_count(wrong)) {
      expect_amends(seen(truth, 0), wrong, random_below(gateway_count(wrong), random));
      ++compared;
    }
  }
  EXPECT_GT(compared, 50);
}

TEST(AmendedStar, IsTakenUpByAWorkingMapWithEveryLinkInItsPlace) {
  for (unsigned seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const Star truth = random_star(2 + seed % 5, random);
    const int entry = random_below(gateway_count(truth), random);
    int misread_entry = entry;
    const Star wrong = misread(truth, misread_entry, random);
    const std::optional<AmendedStar> result = amended(seen(truth, entry), 0, wrong, misread_entry);
    ASSERT_TRUE(result);
    StarCatalogue stars;
    const StarId of_wrong = stars.add(wrong);
    const StarId of_dead_end = stars.add(dead_end());
    const StarId of_result = stars.add(result->star);
    WorkingMap map(stars, WorkingMap::Rings::kFaces);
    map.start(of_wrong, VisitId{0});
    map.apply({MapChange::Kind::kPlace, of_dead_end, VisitId{1}, misread_entry, 0});

    map.apply({MapChange::Kind::kOtherStar, of_result, VisitId{2}, misread_entry,
               result->changed_gateway});

    const int now = result->gateway_of_view[static_cast<std::size_t>(entry)];
    EXPECT_TRUE(map.is_linked(map.gateway({PlaceId{0}, now})));
    EXPECT_TRUE(map.is_pending(map.gateway({PlaceId{0}, result->changed_gateway})));
    EXPECT_EQ(view_code(result->star, now), view_code(truth, entry));
  }
}

}  // namespace
}  // namespace cairn::test
