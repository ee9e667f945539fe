#include "star/isomorphism.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/stars.hpp"

namespace cairn::test {
namespace {

using ::testing::ElementsAre;

Star three_stubs() {
  return star_of({0, -1, 1, -1, 2, -1}, {3, 4, 5, 0, 1, 2});
}

TEST(Isomorphism, ACrossingLooksTheSameFromEverySide) {
  EXPECT_THAT(view_classes(crossing()), ElementsAre(0, 0, 0, 0));
  EXPECT_THAT(view_classes(corridor()), ElementsAre(0, 0));
  EXPECT_THAT(view_classes(three_stubs()), ElementsAre(0, 0, 0));
}

TEST(Isomorphism, LeftAndRightOfACornerDiffer) {
  EXPECT_THAT(view_classes(corner()), ElementsAre(0, 1));
  EXPECT_FALSE(are_alike(corner(), 0, corner(), 1));
}

TEST(Isomorphism, ATeeHasThreeViews) {
  EXPECT_THAT(view_classes(tee()), ElementsAre(0, 1, 2));
}

TEST(Isomorphism, DoesNotDependOnWhereTheSlotsBegin) {
  const Star turned = star_of({-1, 0, 1, 2}, {2, 3, 0, 1});  // Its stem is gateway 1, too.
  EXPECT_TRUE(are_alike(tee(), 0, turned, 0));
  const Star turned_further = star_of({0, -1, 1, 2}, {2, 3, 0, 1});
  EXPECT_TRUE(are_alike(tee(), 1, turned_further, 2));
  EXPECT_FALSE(are_alike(tee(), 0, turned_further, 0));
}

TEST(Isomorphism, ControlLawsDoNotCount) {
  Star along_the_wall = corner();
  along_the_wall.slots[0].law = ControlLaw::kLeftWall;
  EXPECT_TRUE(are_alike(corner(), 0, along_the_wall, 0));
}

TEST(Isomorphism, PassingThroughAndTerminatingDiffer) {
  const Star two_stubs = star_of({0, -1, 1, -1}, {1, 0, 3, 2});
  EXPECT_FALSE(are_alike(corridor(), 0, two_stubs, 0));
}

TEST(TypeName, IsShortForCommonStarsAndACodeForOthers) {
  EXPECT_EQ(type_name(dead_end()), "D");
  EXPECT_EQ(type_name(corridor()), "I");
  EXPECT_EQ(type_name(corner()), "L");
  EXPECT_EQ(type_name(tee()), "T");
  EXPECT_EQ(type_name(crossing()), "+");
  EXPECT_EQ(type_name(three_stubs()), "g3x3g3x3g3x3");
}

TEST(TypeName, IsTheSameForEveryRotation) {
  EXPECT_EQ(type_name(star_of({-1, 0, 1, 2}, {2, 3, 0, 1})), "T");
  EXPECT_EQ(type_name(star_of({-1, 0, -1, 1, -1, 2}, {3, 4, 5, 0, 1, 2})), "g3x3g3x3g3x3");
}

}  // namespace
}  // namespace cairn::test
