#include "star/large_scale_star.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/stars.hpp"

namespace cairn::test {
namespace {

using ::testing::ElementsAre;

TEST(LargeScaleStar, HasADstateForEachDirectionOfEachPath) {
  const LargeScaleStar star = abstracted(corner());
  EXPECT_THAT(star.dstates, ElementsAre(Dstate{1, true, false, 0}, Dstate{2, true, false, 1},
                                        Dstate{1, false, true, 2}, Dstate{2, false, true, 3}));
}

TEST(LargeScaleStar, RightIsWhatComesBeforeTheOwnPathsOtherDirection) {
  const LargeScaleStar star = abstracted(tee());
  EXPECT_THAT(right_of(star, 0), ElementsAre(1));  // Along the bar, the stem on the right.
  EXPECT_THAT(right_of(star, 2), ElementsAre(3));  // The other way, the stem's end on the right.
  EXPECT_THAT(right_of(star, 1), ElementsAre(2));
}

TEST(LargeScaleStar, TextBeginsWhereTheReaderLooks) {
  EXPECT_EQ(large_scale_text(tee(), 1),
            "((ds1, Pa1+),\n(ds2, Pa2+),\n(ds3, (Pa1-)),\n(ds4, Pa2-))");
}

}  // namespace
}  // namespace cairn::test
