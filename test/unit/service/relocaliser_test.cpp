#include "service/relocaliser.hpp"

#include <gmock/gmock.h>

#include "unit/lpm/simulated_laser.hpp"

namespace cairn {
namespace {

using test::SimulatedLaser;
using test::Wall;

Pose2 on_a_circle(int step) {
  const double angle = 0.05 * step;
  return {1.5 * std::cos(angle), 1.5 * std::sin(angle), wrap_angle(angle + kPi / 2.0)};
}

std::vector<PosedScan> seen_in(const std::vector<Wall>& walls) {
  SimulatedLaser laser(walls);
  std::vector<PosedScan> seen;
  for (int step = 0; step < 126; ++step) {
    const Pose2 pose = on_a_circle(step);
    seen.push_back({std::make_shared<const LaserScan>(laser.scan(pose, 0.1 * step)), pose});
  }
  return seen;
}

/// Where a robot is found that drives on a circle, set down somewhere.
std::optional<Relocalisation> found_in(const std::vector<Wall>& walls,
                                       const Pose2& T_world_circle,
                                       const RelocalisationOptions& options,
                                       Pose2* truth) {
  Relocaliser relocaliser(options);
  relocaliser.start(seen_in(test::furnished_room()));
  SimulatedLaser laser(walls, 17);
  for (int step = 0; step < 500 && relocaliser.is_searching(); ++step) {
    GaussianPose motion;
    motion.covariance.diagonal() << 1e-4, 1e-4, 1e-4;
    motion.mean = on_a_circle(step - 1).inverse() * on_a_circle(step);
    *truth = T_world_circle * on_a_circle(step);
    const auto found = relocaliser.absorb(laser.scan(*truth, 20.0 + 0.1 * step), motion);
    if (found) {
      return found;
    }
  }
  return std::nullopt;
}

TEST(Relocaliser, FindsTheRobotWhereItIsHoweverLittleIsDoneWithEachScan) {
  for (const int lookups : {300'000, 2'000'000, 100'000'000}) {
    SCOPED_TRACE(lookups);
    RelocalisationOptions options;
    options.lookups_per_scan = lookups;
    Pose2 truth;
    const auto found = found_in(test::furnished_room(), Pose2(-1.0, 0.5, 2.0), options, &truth);
    ASSERT_TRUE(found.has_value());
    EXPECT_LT((found->T_global_robot.mean.translation() - truth.translation()).norm(), 0.3);
    EXPECT_LT(std::abs(turn_between(found->T_global_robot.mean.theta(), truth.theta())), 0.1);
  }
}

TEST(Relocaliser, FindsNoRobotWhereItHasNeverBeen) {
  std::vector<Wall> other;
  test::add_box({-4.5, -6.0}, {3.5, 5.0}, &other);
  test::add_box({-3.5, 1.5}, {-2.5, 3.0}, &other);
  test::add_box({2.5, -1.0}, {3.5, 0.0}, &other);
  other.push_back({{1.5, 5.0}, {3.5, 3.5}});
  for (const double turn_rad : {0.0, 0.7, 2.5, kPi}) {
    SCOPED_TRACE(turn_rad);
    Pose2 truth;
    EXPECT_FALSE(found_in(other, Pose2(0.4, -0.3, turn_rad), {}, &truth).has_value());
  }
}

TEST(Relocaliser, LooksForNothingInAMapOfNothingOrOfTooMuch) {
  Relocaliser relocaliser;
  relocaliser.start({});
  EXPECT_FALSE(relocaliser.is_searching());
  RelocalisationOptions options;
  options.max_cells = 1000;
  Pose2 truth;
  EXPECT_FALSE(found_in(test::furnished_room(), {}, options, &truth).has_value());
}

}  // namespace
}  // namespace cairn
