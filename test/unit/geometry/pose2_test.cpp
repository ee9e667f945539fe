#include "geometry/pose2.hpp"

#include <random>

#include <gmock/gmock.h>

namespace cairn {
namespace {

TEST(Angle, IsKeptAboveMinusPiAndUpToPi) {
  EXPECT_DOUBLE_EQ(wrap_angle(kPi), kPi);
  EXPECT_DOUBLE_EQ(wrap_angle(-kPi), kPi);
  EXPECT_NEAR(wrap_angle(3.0 * kPi + 0.1), -kPi + 0.1, 1e-12);
  EXPECT_NEAR(turn_between(3.1, -3.1), 2.0 * kPi - 6.2, 1e-12);
}

TEST(Pose2, TakesCoordinatesOfTheBodyToTheFrame) {
  const Pose2 T_global_robot(2.0, 1.0, kPi / 2.0);
  const Vector2d p = T_global_robot * Vector2d(3.0, 0.0);
  EXPECT_NEAR(p.x(), 2.0, 1e-12);
  EXPECT_NEAR(p.y(), 4.0, 1e-12);
}

TEST(Pose2, TimesItsInverseIsNoMotion) {
  for (unsigned seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> any(-10.0, 10.0);
    const Pose2 T_a_b(any(random), any(random), any(random));
    const Pose2 none = T_a_b * T_a_b.inverse();
    EXPECT_NEAR(none.x(), 0.0, 1e-12);
    EXPECT_NEAR(none.y(), 0.0, 1e-12);
    EXPECT_NEAR(none.theta(), 0.0, 1e-12);
  }
}

}  // namespace
}  // namespace cairn
