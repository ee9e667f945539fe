#include "clients/common/place_picture.hpp"

#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "clients/common/failure.hpp"
#include "clients/common/perceived_place.hpp"
#include "clients/common/place_window.hpp"
#include "unit/clients/sample_map.hpp"

namespace cairn::clients {
namespace {

using cairn_lcm::opening_t;
using cairn_lcm::perceived_place_t;

bool has_colour(const Canvas& canvas, Colour colour) {
  for (int y = 0; y < canvas.height(); ++y) {
    for (int x = 0; x < canvas.width(); ++x) {
      if (canvas.at(x, y) == colour) {
        return true;
      }
    }
  }
  return false;
}

TEST(PlacePicture, ShowsGatewaysAndWhatIsNoneInColoursOfTheirOwn) {
  perceived_place_t place = sample_perceived(1);
  place.openings[1].state = opening_t::UNSURE;
  const Canvas canvas = draw_perceived_place(place, {"kitchen"});

  EXPECT_EQ(canvas.width(), 900);
  EXPECT_GT(canvas.height(), 850);
  for (const opening_t& opening : place.openings) {
    EXPECT_TRUE(has_colour(canvas, opening_colour(opening))) << opening.state_name;
  }
}

TEST(PlacePicture, LabelsAreNumbersOfTheStarAndLettersOtherwise) {
  const perceived_place_t place = sample_perceived(1);
  EXPECT_EQ(opening_label(place, 0), "0");
  EXPECT_EQ(opening_label(place, 2), "2");
  EXPECT_EQ(opening_label(place, 3), "a");
}

TEST(PlacePicture, APathRunsFromGatewayToGatewayOrEndsInside) {
  perceived_place_t place = sample_perceived(1);
  place.fragment_through[0] = 2;
  const std::vector<PlacePoint> through = fragment_course(place, 0);
  EXPECT_NEAR(through.front().x_m, place.openings[0].x_m, 1e-9);
  EXPECT_NEAR(through.back().x_m, place.openings[2].x_m, 1e-9);
  const std::vector<PlacePoint> ending = fragment_course(place, 1);
  EXPECT_LT(std::hypot(ending.back().x_m, ending.back().y_m), 0.6);
  place.fragment_from[0] = 77;
  EXPECT_THAT(fragment_course(place, 0), ::testing::IsEmpty());
}

TEST(PlacePicture, NumbersThatDoNotFitAreBadData) {
  const auto refused = [](auto break_it) {
    perceived_place_t place = sample_perceived(1);
    break_it(&place);
    try {
      static_cast<void>(draw_perceived_place(place, {}));
    } catch (const Failure& failure) {
      return failure.code() == ExitCode::kBadData;
    }
    return false;
  };
  EXPECT_TRUE(refused([](auto* p) { p->width = 41; }));
  EXPECT_TRUE(refused([](auto* p) { p->width = -1; }));
  EXPECT_TRUE(refused([](auto* p) { p->cell_m = 0.0; }));
  EXPECT_TRUE(refused([](auto* p) { p->axis_line_points = {4}; }));
  EXPECT_TRUE(refused([](auto* p) { p->axis_line_points = {-1, 4}; }));
  EXPECT_TRUE(
      refused([](auto* p) { p->openings[0].x_m = std::numeric_limits<double>::quiet_NaN(); }));
}

TEST(PlacePicture, ASheetHasATileForEachVisit) {
  const Canvas one = draw_place_sheet({sample_perceived(0)});
  const Canvas four = draw_place_sheet(
      {sample_perceived(0), sample_perceived(1), sample_perceived(2), sample_perceived(3)});
  EXPECT_GT(four.width(), one.width());
  EXPECT_GT(draw_place_sheet({}).width(), 0);
}

}  // namespace
}  // namespace cairn::clients
