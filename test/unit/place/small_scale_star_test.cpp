#include "place/small_scale_star.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "place/place_options.hpp"
#include "star/isomorphism.hpp"

namespace cairn {
namespace {

/// A gateway 2 m wide at a distance from the origin, straight outward.
Gateway gateway_toward(double bearing_rad) {
  Gateway gateway;
  gateway.outward_bearing_rad = wrap_angle(bearing_rad);
  const Vector2d left(-gateway.outward().y(), gateway.outward().x());
  gateway.middle = 2.0 * gateway.outward();
  gateway.basis_points = {gateway.middle - left, gateway.middle + left};
  gateway.width_m = 2.0;
  return gateway;
}

Star star_of(const std::vector<double>& bearings_rad) {
  std::vector<Gateway> gateways;
  for (const double bearing_rad : bearings_rad) {
    gateways.push_back(gateway_toward(bearing_rad));
  }
  sort_clockwise(Vector2d::Zero(), &gateways);
  const auto fragments = mutual_straight_continuations(gateways, ContinuationOptions{});
  return small_scale_star(Vector2d::Zero(), gateways, fragments, 6.0);
}

TEST(SmallScaleStar, NamesTheUsualJunctionsHoweverTheyAreTurned) {
  for (double turn = 0.0; turn < 2.0 * kPi; turn += 0.1) {
    SCOPED_TRACE(turn);
    const double quarter = 0.5 * kPi;
    EXPECT_EQ(type_name(star_of({turn})), "D");
    EXPECT_EQ(type_name(star_of({turn, turn + quarter})), "L");
    EXPECT_EQ(type_name(star_of({turn, turn + quarter, turn + 2 * quarter})), "T");
    EXPECT_EQ(type_name(star_of({turn, turn + quarter, turn + 2 * quarter, turn + 3 * quarter})),
              "+");
  }
}

TEST(SmallScaleStar, IsValidWhateverTheBearings) {
  for (int i = 1; i < 60; ++i) {
    const double a = 0.1 * i;
    EXPECT_TRUE(validate(star_of({0.0, a, 2.3 * a})).ok());
  }
}

TEST(PathFragments, AForkWithTwoSimilarContinuationsEndsThePath) {
  std::vector<Gateway> gateways{gateway_toward(kPi), gateway_toward(0.3), gateway_toward(-0.3)};
  const auto fragments = mutual_straight_continuations(gateways, ContinuationOptions{});
  for (const PathFragment& fragment : fragments) {
    EXPECT_EQ(fragment.through, -1);
  }
}

TEST(Gateway, IsCrossedOutwardInwardOrNotAtAll) {
  const Gateway gateway = gateway_toward(0.0);
  EXPECT_EQ(crossing(gateway, {1.0, 0.0}, {3.0, 0.0}, 0.0), 1);
  EXPECT_EQ(crossing(gateway, {3.0, 0.5}, {1.0, 0.5}, 0.0), -1);
  EXPECT_EQ(crossing(gateway, {1.0, 1.5}, {3.0, 1.5}, 0.0), 0);
  EXPECT_EQ(crossing(gateway, {1.0, 1.2}, {3.0, 1.2}, 0.3), 1);
  EXPECT_EQ(crossing(gateway, {0.0, 0.0}, {1.0, 0.0}, 0.0), 0);
}

TEST(Gateway, KeepsItsShapeInAnotherFrame) {
  const Pose2 T_b_a(3.0, -1.0, 0.7);
  const Gateway moved = transformed(T_b_a, gateway_toward(1.0));
  EXPECT_NEAR(moved.outward_bearing_rad, 1.7, 1e-12);
  EXPECT_NEAR((moved.basis_points[0] - moved.basis_points[1]).norm(), 2.0, 1e-12);
  EXPECT_NEAR(distance_beyond_m(moved, T_b_a * Vector2d::Zero()), -2.0, 1e-12);
}

TEST(PlaceOptions, NameEveryFieldThatIsOutOfRange) {
  PlaceOptions options;
  EXPECT_TRUE(validate(options).ok());
  options.cell_m = 0.0;
  options.robot_width_m = -1.0;
  const Status status = validate(options);
  ASSERT_FALSE(status.ok());
  EXPECT_THAT(status.error().message, ::testing::HasSubstr("cell_m"));
  EXPECT_THAT(status.error().message, ::testing::HasSubstr("robot_width_m"));
}

}  // namespace
}  // namespace cairn
