#include "star/star.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/stars.hpp"

namespace cairn::test {
namespace {

using ::testing::HasSubstr;

TEST(Star, OfAPlaceIsValid) {
  for (const Star& star : {dead_end(), corridor(), corner(), tee(), crossing()}) {
    EXPECT_TRUE(validate(star).ok());
  }
}

TEST(Star, ATerminatedEndMayComeFirst) {
  EXPECT_TRUE(validate(star_of({-1, 0, 1, -1}, {2, 3, 0, 1})).ok());
}

TEST(Star, WithoutAGatewayIsNoPlace) {
  EXPECT_THAT(validate(Star{}).error().message, HasSubstr("must have a gateway"));
}

TEST(Star, GatewaysOutOfClockwiseOrderAreRefused) {
  EXPECT_THAT(validate(star_of({1, 0}, {1, 0})).error().message,
              HasSubstr("slot 0 must have gateway 0 or -1, has 1"));
  EXPECT_FALSE(validate(star_of({0, 0}, {1, 0})).ok());
  EXPECT_FALSE(validate(star_of({0, -2}, {1, 0})).ok());
}

TEST(Star, PartnersMustBeMutual) {
  EXPECT_THAT(validate(star_of({0, 1, 2, -1}, {2, 3, 1, 0})).error().message,
              HasSubstr("slot 0 is not the partner of its partner"));
  EXPECT_FALSE(validate(star_of({0}, {0})).ok());
  EXPECT_FALSE(validate(star_of({0, -1}, {1, 7})).ok());
}

TEST(Star, AFragmentNeedsAGateway) {
  EXPECT_THAT(validate(star_of({0, -1, -1, -1}, {1, 0, 3, 2})).error().message,
              HasSubstr("a fragment without a gateway"));
}

TEST(Star, GoesStraightOnWhereAFragmentPassesThrough) {
  EXPECT_EQ(through_partner(tee(), 0), 2);
  EXPECT_EQ(through_partner(tee(), 2), 0);
  EXPECT_EQ(through_partner(tee(), 1), std::nullopt);
  EXPECT_EQ(gateway_count(tee()), 3);
  EXPECT_EQ(slot_of_gateway(star_of({-1, 0}, {1, 0}), 0), 1U);
}

TEST(StarDeathTest, HasNoGatewayBeyondItsLast) {
  EXPECT_DEATH(static_cast<void>(slot_of_gateway(corner(), 2)), "no such gateway");
}

}  // namespace
}  // namespace cairn::test
