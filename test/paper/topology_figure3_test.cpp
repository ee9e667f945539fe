// Fig. 3(e) and (f) of Kuipers et al., ICRA 2004: a place with five gateways, four paths and eight
// dstates.

#include <gtest/gtest.h>

#include "star/large_scale_star.hpp"
#include "star/small_scale_star.hpp"
#include "support/stars.hpp"

namespace cairn::test {
namespace {

/// Slots clockwise from PF1+; the paper counts gateways from 1.
Star place_of_figure_3() {
  return star_of({0, 1, -1, 2, 3, -1, 4, -1}, {4, 7, 6, 5, 0, 3, 2, 1});
}

TEST(KuipersFigure3, SmallScaleStar) {
  EXPECT_EQ(small_scale_text(place_of_figure_3(), 0),
            "((PF1+, (gw1,out) & (gw4,in), MIDLINE),\n"
            "(PF2+, (gw2,out), MIDLINE),\n"
            "(PF3+, (gw5,in), DEADEND),\n"
            "(PF4+, (gw3,out), MIDLINE),\n"
            "(PF1-, (gw4,out) & (gw1,in), MIDLINE),\n"
            "(PF4-, (gw3,in), DEADEND),\n"
            "(PF3-, (gw5,out), MIDLINE),\n"
            "(PF2-, (gw2,in), DEADEND))");
}

TEST(KuipersFigure3, LargeScaleStar) {
  EXPECT_EQ(large_scale_text(place_of_figure_3(), 0),
            "((ds1, Pa1+),\n"
            "(ds2, Pa2+),\n"
            "(ds3, (Pa3+)),\n"
            "(ds4, Pa4+),\n"
            "(ds5, Pa1-),\n"
            "(ds6, (Pa4-)),\n"
            "(ds7, Pa3-),\n"
            "(ds8, (Pa2-)))");
}

}  // namespace
}  // namespace cairn::test
