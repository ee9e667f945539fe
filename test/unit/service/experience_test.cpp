#include "service/experience.hpp"

#include <gmock/gmock.h>

#include "support/experience.hpp"

namespace cairn {
namespace {

using test::corner_at;
using test::scan_at;
using ::testing::IsEmpty;
using ::testing::SizeIs;

/// A drive of 1 m steps along x.
Experience driven(int scans) {
  Experience experience;
  for (int i = 0; i < scans; ++i) {
    experience.add(scan_at(i, Pose2(i, 0.0, 0.0), Pose2(i == 0 ? 0.0 : 1.0, 0.0, 0.0)));
  }
  return experience;
}

TEST(Experience, AnchorsAVisitAtTheScanClosestToThePlace) {
  const Experience experience = driven(10);
  EXPECT_EQ(experience.anchored(corner_at({4.2, 0.5})).anchor_scan, 4U);
}

TEST(Experience, NeverAnchorsAVisitBeforeTheLastOne) {
  Experience experience = driven(10);
  experience.add(experience.anchored(corner_at({6.0, 0.0})));
  EXPECT_GE(experience.anchored(corner_at({1.0, 0.0})).anchor_scan, 6U);
}

TEST(Experience, ATravelLeadsFromPlaceToPlace) {
  Experience experience = driven(10);
  experience.add(experience.anchored(corner_at({2.0, 0.5})));
  EXPECT_THAT(experience.travels(), IsEmpty());
  experience.add(experience.anchored(corner_at({7.0, -0.5})));
  ASSERT_THAT(experience.travels(), SizeIs(1));
  const Travel& travel = experience.travels().front();
  EXPECT_NEAR(travel.T_from_to.mean.x(), 5.0, 1e-9);
  EXPECT_NEAR(travel.T_from_to.mean.y(), -1.0, 1e-9);
  EXPECT_DOUBLE_EQ(travel.length_m, 5.0);
  EXPECT_TRUE(is_positive_definite(travel.T_from_to.covariance));
}

TEST(Experience, ALongerTravelIsLessCertain) {
  Experience experience = driven(30);
  experience.add(experience.anchored(corner_at({2.0, 0.0})));
  experience.add(experience.anchored(corner_at({5.0, 0.0})));
  experience.add(experience.anchored(corner_at({25.0, 0.0})));
  EXPECT_GT(experience.travels()[1].T_from_to.covariance(1, 1),
            experience.travels()[0].T_from_to.covariance(1, 1));
}

}  // namespace
}  // namespace cairn
