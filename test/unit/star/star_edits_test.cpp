#include "star/star_edits.hpp"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "star/isomorphism.hpp"
#include "support/random_star.hpp"
#include "support/stars.hpp"

namespace cairn::test {
namespace {

std::string type_without(const Star& star, int gateway) {
  const std::optional<Star> rest = without_gateway(star, gateway);
  return rest ? type_name(*rest) : "nothing";
}

TEST(WithoutGateway, ACrossingBecomesATee) {
  EXPECT_EQ(type_without(crossing(), 0), "T");
  EXPECT_EQ(type_without(crossing(), 3), "T");
}

TEST(WithoutGateway, ATeeBecomesACorridorWithoutItsStemAndACornerWithoutAnArm) {
  EXPECT_EQ(type_without(tee(), 1), "I");
  EXPECT_EQ(type_without(tee(), 0), "L");
  EXPECT_EQ(type_without(tee(), 2), "L");
}

TEST(WithoutGateway, TheCornerTurnsToTheSideOfTheArmThatStays) {
  // Without arm 2 a traveller from the stem can only turn right, by gateway 0.
  const std::optional<Star> right_turn = without_gateway(tee(), 2);
  ASSERT_TRUE(right_turn);
  EXPECT_TRUE(are_alike(*right_turn, 1, corner(), 1));
  const std::optional<Star> left_turn = without_gateway(tee(), 0);
  ASSERT_TRUE(left_turn);
  EXPECT_TRUE(are_alike(*left_turn, 0, corner(), 0));
}

TEST(WithoutGateway, ADeadEndRemainsOfTwoGatewaysAndNothingOfOne) {
  EXPECT_EQ(type_without(corner(), 0), "D");
  EXPECT_EQ(type_without(corridor(), 1), "D");
  EXPECT_EQ(without_gateway(dead_end(), 0), std::nullopt);
}

TEST(WithoutGateway, TheSlotThatStaysIsADeadEnd) {
  const std::optional<Star> rest = without_gateway(corridor(), 0);
  ASSERT_TRUE(rest);
  EXPECT_EQ(rest->slots[0], (StarSlot{-1, 1, ControlLaw::kDeadEnd}));
  EXPECT_EQ(rest->slots[1], (StarSlot{0, 0, ControlLaw::kMidline}));
}

TEST(WithoutGateway, KeepsAllOtherGatewaysAndWhereTheyLead) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const Star star = random_star(2 + seed % 7, random);
    const int gateways = gateway_count(star);
    const int gone = random_below(gateways, random);
    const auto renumbered = [gone](int gateway) { return gateway - (gateway > gone ? 1 : 0); };

    const std::optional<Star> rest = without_gateway(star, gone);

    ASSERT_TRUE(rest);
    ASSERT_TRUE(validate(*rest).ok());
    ASSERT_EQ(gateway_count(*rest), gateways - 1);
    for (int gateway = 0; gateway < gateways; ++gateway) {
      if (gateway == gone) {
        continue;
      }
      const std::optional<int> before = through_partner(star, gateway);
      const std::optional<int> after = through_partner(*rest, renumbered(gateway));
      EXPECT_EQ(after.has_value(), before.has_value() && *before != gone);
      EXPECT_EQ(after.value_or(-1), after ? renumbered(*before) : -1);
    }
    const bool leaves_an_end = through_partner(star, gone).has_value();
    EXPECT_EQ(rest->slots.size(), star.slots.size() - (leaves_an_end ? 0 : 2));
  }
}

TEST(WithGateway, ACorridorBecomesATeeAndADeadEndACorner) {
  EXPECT_EQ(type_name(with_gateway(corridor(), 1)), "T");
  EXPECT_EQ(type_name(with_gateway(corridor(), 2)), "T");
  EXPECT_EQ(type_name(with_gateway(dead_end(), 1)), "L");
}

TEST(WithGateway, IsTheSameStarAgainWithoutIt) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const Star star = random_star(1 + seed % 7, random);
    const int number = random_below(gateway_count(star) + 1, random);

    const Star more = with_gateway(star, number);

    ASSERT_TRUE(validate(more).ok());
    ASSERT_EQ(gateway_count(more), gateway_count(star) + 1);
    EXPECT_EQ(through_partner(more, number), std::nullopt);
    EXPECT_EQ(without_gateway(more, number), star);
  }
}

TEST(RotatedTo, NumbersClockwiseFromTheGivenGateway) {
  EXPECT_EQ(rotated_to(tee(), 0), tee());
  EXPECT_EQ(rotated_to(tee(), 2), star_of({0, -1, 1, 2}, {2, 3, 0, 1}));
  EXPECT_EQ(rotated_to(star_of({-1, 0}, {1, 0}), 0), dead_end());
}

TEST(RotatedTo, LooksTheSameFromEveryGateway) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const Star star = random_star(1 + seed % 7, random);
    const int gateways = gateway_count(star);
    const int first = random_below(gateways, random);

    const Star rotated = rotated_to(star, first);

    ASSERT_TRUE(validate(rotated).ok());
    EXPECT_EQ(rotated.slots.front().gateway, 0);
    for (int gateway = 0; gateway < gateways; ++gateway) {
      EXPECT_EQ(view_code(rotated, gateway), view_code(star, (first + gateway) % gateways));
    }
    EXPECT_EQ(rotated_to(rotated, (gateways - first) % gateways), rotated_to(star, 0));
  }
}

}  // namespace
}  // namespace cairn::test
