#include "topology/star_catalogue.hpp"

#include <gtest/gtest.h>

#include "support/stars.hpp"

namespace cairn::test {
namespace {

TEST(StarCatalogue, KnowsAStarOnce) {
  StarCatalogue stars;
  const StarId first = stars.add(tee());
  EXPECT_NE(stars.add(corner()), first);
  EXPECT_EQ(stars.add(tee()), first);
  EXPECT_EQ(stars.find(crossing()), std::nullopt);
  EXPECT_EQ(stars.fragment_count(first), 2);
}

TEST(StarCatalogue, GatewaysThatLookAlikeShareAClassWhateverTheFirstSlot) {
  StarCatalogue stars;
  const StarId upright = stars.add(tee());
  const StarId turned = stars.add(star_of({0, -1, 1, 2}, {2, 3, 0, 1}));
  ASSERT_NE(upright, turned);
  for (int gateway = 0; gateway < 3; ++gateway) {
    for (int other = 0; other < 3; ++other) {
      EXPECT_EQ(stars.view_class(upright, gateway) == stars.view_class(turned, other),
                are_alike(stars.star(upright), gateway, stars.star(turned), other));
    }
  }
  const StarId cross = stars.add(crossing());
  EXPECT_EQ(stars.view_class(cross, 0), stars.view_class(cross, 3));
}

TEST(StarCatalogueDeathTest, TakesNoInvalidStar) {
  StarCatalogue stars;
  EXPECT_DEATH(stars.add(Star{}), "validate");
}

}  // namespace
}  // namespace cairn::test
