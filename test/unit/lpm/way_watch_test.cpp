#include "lpm/way_watch.hpp"

#include <gmock/gmock.h>

#include "simulated_laser.hpp"

namespace cairn {
namespace {

using test::furnished_room;
using test::SimulatedLaser;

/// A robot that drives, and fixes that say what they are told to.
class WayWatchTest : public testing::Test {
 protected:
  void see(const Pose2& T_world_robot, const Pose2& step, double score, FixNote note) {
    ScanBeams beams;
    beams.take(laser_.scan(T_world_robot, 0.0), {}, 20.0);
    fix_.T_lpm_robot = fix_.T_lpm_robot * step;
    fix_.note = note;
    fix_.is_matched = !is_refused(note);
    fix_.score = score;
    way_.foretell(step);
    way_.note({0, true, 0.95}, beams, fix_);
  }
  void drive(int steps, double score = 0.95) {
    for (int i = 0; i < steps; ++i) {
      T_world_robot_ = T_world_robot_ * kStep;
      see(T_world_robot_, kStep, score, FixNote::kMatched);
    }
  }
  void be_carried() { T_world_robot_ = Pose2(-3.5, 0.5, -2.0); }

  const Pose2 kStep{0.0, 0.0, 0.1};
  SimulatedLaser laser_{furnished_room()};
  Pose2 T_world_robot_{0.0, -1.0, 0.3};
  LocalFix fix_;
  WayWatch way_;
};

TEST_F(WayWatchTest, IsKnownWhileScansAreMatchedAndWhileRefusedOnesGoOn) {
  drive(5);
  EXPECT_TRUE(way_.is_known());
  for (int i = 0; i < 5; ++i) {
    T_world_robot_ = T_world_robot_ * kStep;
    see(T_world_robot_, kStep, 0.2, FixNote::kContradiction);
    EXPECT_TRUE(way_.is_known()) << i;
    EXPECT_FALSE(way_.has_broken_off()) << i;
  }
}

TEST_F(WayWatchTest, BreaksOffWhereARobotIsCarriedThoughItIsMatchedThere) {
  drive(5);
  be_carried();
  see(T_world_robot_, kStep, 0.7, FixNote::kMatched);
  EXPECT_TRUE(way_.has_broken_off());
  EXPECT_FALSE(way_.is_known());
}

TEST_F(WayWatchTest, IsKnownAgainWhenTheRobotHasLookedAroundAndAllWasAsItWas) {
  drive(5);
  be_carried();
  see(T_world_robot_, kStep, 0.7, FixNote::kMatched);
  drive(25);
  EXPECT_FALSE(way_.is_known()) << "less than half a turn";
  drive(1, 0.6);
  drive(25);
  EXPECT_FALSE(way_.is_known()) << "one scan that does not fit, and it begins anew";
  drive(10);
  EXPECT_TRUE(way_.is_known());
  EXPECT_FALSE(way_.has_broken_off());
}

TEST_F(WayWatchTest, DoesNotBreakOffAtABump) {
  drive(5);
  const Pose2 bump(0.1, 0.25, 0.4);
  T_world_robot_ = T_world_robot_ * bump;
  ScanBeams beams;
  beams.take(laser_.scan(T_world_robot_, 0.0), {}, 20.0);
  fix_.T_lpm_robot = fix_.T_lpm_robot * bump;
  fix_.note = FixNote::kSlip;
  way_.foretell(Pose2());
  way_.note({0, true, 0.95}, beams, fix_);
  EXPECT_FALSE(way_.has_broken_off());
}

}  // namespace
}  // namespace cairn
