#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "place/neighbourhood.hpp"
#include "star/large_scale_star.hpp"
#include "star/small_scale_star.hpp"
#include "support/drawn_world.hpp"

namespace cairn {
namespace {

/// The situation of Fig. 3 of Kuipers et al., ICRA 2004: a path that goes through, and three more
/// that end at it, each a little farther along it.
const std::vector<std::string> kFigure3{
    "############......##......############",  //
    "############......##......############",  //
    "############......##......############",  //
    "############......##......############",  //
    "############......##......############",  //
    "############......##......############",  //
    "############......##......############",  //
    "############......##......############",  //
    "############......##......############",  //
    "############......##......############",  //
    "############......##......############",  //
    "############......##......############",  //
    "......................................",  //
    "......................................",  //
    "......................................",  //
    "...................R..................",  //
    "......................................",  //
    "......................................",  //
    "......................................",  //
    "......................................",  //
    "################......################",  //
    "################......################",  //
    "################......################",  //
    "################......################",  //
    "################......################",  //
    "################......################",  //
    "################......################",  //
    "################......################",  //
    "################......################",  //
    "################......################",  //
    "################......################",  //
    "################......################",
};

class Figure3 : public ::testing::TestWithParam<unsigned> {
 protected:
  void SetUp() override {
    const test::DrawnWorld world(kFigure3, 0.25, GetParam());
    for (const PlaceNeighbourhood& place :
         find_places(world.full_map(), world.position_of('R'), PlaceOptions{})) {
      // The drawing ends in unknown space; what is read there is not complete.
      if (place.is_complete) {
        places_.push_back(place);
      }
    }
    ASSERT_EQ(places_.size(), 1U);
    // The path that passes through is PF1; read from its west end.
    const Star& star = places_.front().star;
    for (std::size_t i = 0; i < star.slots.size(); ++i) {
      const int gateway = star.slots[i].gateway;
      if (gateway >= 0 &&
          places_.front().gateways[static_cast<std::size_t>(gateway)].middle.x() < 3.0) {
        first_slot_ = i;
      }
    }
  }
  std::vector<PlaceNeighbourhood> places_;
  std::size_t first_slot_ = 0;
};

TEST_P(Figure3, HasFiveGatewaysAndFourPaths) {
  const PlaceNeighbourhood& place = places_.front();
  EXPECT_TRUE(place.is_complete);
  EXPECT_TRUE(place.contains_robot);
  EXPECT_THAT(place.gateways, ::testing::SizeIs(5));
  EXPECT_THAT(place.fragments, ::testing::SizeIs(4));
}

TEST_P(Figure3, IsDescribedByTheSmallScaleStarOfPartE) {
  EXPECT_EQ(small_scale_text(places_.front().star, first_slot_),
            "((PF1+, (gw1,out) & (gw4,in), MIDLINE),\n"
            "(PF2+, (gw2,out), MIDLINE),\n"
            "(PF3+, (gw5,in), DEADEND),\n"
            "(PF4+, (gw3,out), MIDLINE),\n"
            "(PF1-, (gw4,out) & (gw1,in), MIDLINE),\n"
            "(PF4-, (gw3,in), DEADEND),\n"
            "(PF3-, (gw5,out), MIDLINE),\n"
            "(PF2-, (gw2,in), DEADEND))");
}

TEST_P(Figure3, IsAbstractedToTheLargeScaleStarOfPartF) {
  EXPECT_EQ(large_scale_text(places_.front().star, first_slot_),
            "((ds1, Pa1+),\n"
            "(ds2, Pa2+),\n"
            "(ds3, (Pa3+)),\n"
            "(ds4, Pa4+),\n"
            "(ds5, Pa1-),\n"
            "(ds6, (Pa4-)),\n"
            "(ds7, Pa3-),\n"
            "(ds8, (Pa2-)))");
}

INSTANTIATE_TEST_SUITE_P(RoughWalls, Figure3, ::testing::Range(0U, 10U));

}  // namespace
}  // namespace cairn
