// A robot that is lifted up and set down elsewhere: it notices, harms no map, and is found again.

#include <algorithm>

#include <gmock/gmock.h>

#include "simulated_drive.hpp"

namespace cairn {
namespace {

using test::SimulatedDrive;
using test::Wall;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

const Pose2 kElsewhere(-1.0, 0.5, 2.0);

class Kidnap : public testing::Test {
 protected:
  void kidnap(SimulatedDrive* drive) {
    drive->go(150);
    drive->be_carried_by(kElsewhere);
    drive->go(30);
  }
  /// The lpm frame in which the map is one of the room now, as seen from the first one.
  static Pose2 T_truth_lpm(const SimulatedDrive& drive) {
    return drive.T_lpm_robot() * drive.perceived().back().fix.T_lpm_robot.inverse();
  }
  SimulatedDrive drive_;
};

TEST_F(Kidnap, IsNoticedAndStartsANewMapOfWhatIsThere) {
  kidnap(&drive_);
  EXPECT_EQ(drive_.health().times_lost, 1);
  EXPECT_GE(drive_.service().local_map_restarts(), 1);
  EXPECT_THAT(drive_.reasons(), Contains(HasSubstr("lost: nothing fitted the local map")));
  drive_.go(30);
  EXPECT_EQ(drive_.health().state, LocalisationState::kTracking)
      << reason_of(drive_.health(), LocalisationOptions());
  EXPECT_LT(drive_.share_of_stray_walls(T_truth_lpm(drive_)), 0.02);
}

TEST_F(Kidnap, MakesTheWayToItOneWithoutInformation) {
  kidnap(&drive_);
  const auto unknown =
      std::count_if(drive_.perceived().begin(), drive_.perceived().end(),
                    [](const PerceivedScan& scan) { return is_way_unknown(scan.fix.motion); });
  EXPECT_EQ(unknown, drive_.service().local_map_restarts());
  EXPECT_GT(drive_.service().T_global_robot().covariance(0, 0), 16.0);
}

TEST_F(Kidnap, IsFollowedByARelocalisationWithMarginThatMovesNothing) {
  kidnap(&drive_);
  EXPECT_THAT(drive_.relocalised(), IsEmpty()) << "not before some travel";
  drive_.go(120);
  ASSERT_THAT(drive_.relocalised(), SizeIs(1));
  const Relocalisation& found = drive_.relocalised().front();
  EXPECT_GE(found.travel_m, RelocalisationOptions().accept_travel_m);
  EXPECT_GE(found.margin, RelocalisationOptions().accept_margin);
  EXPECT_TRUE(is_positive_definite(found.T_global_robot.covariance));
  EXPECT_THAT(to_text(found), HasSubstr("score"));
  // It is said, and that is all: the trajectory goes on as dead reckoning has it.
  EXPECT_GT(drive_.service().T_global_robot().covariance(0, 0), 16.0);
}

TEST_F(Kidnap, EndsWhereTheRobotIs) {
  kidnap(&drive_);
  while (drive_.relocalised().empty() && drive_.perceived().size() < 400) {
    drive_.go(1);
  }
  ASSERT_THAT(drive_.relocalised(), SizeIs(1));
  const Pose2 found = drive_.relocalised().front().T_global_robot.mean;
  EXPECT_LT((found.translation() - drive_.T_lpm_robot().translation()).norm(), 0.3);
  EXPECT_LT(std::abs(turn_between(found.theta(), drive_.T_lpm_robot().theta())), 0.1);
}

/// The furnished room, and another one where nobody has been yet.
std::vector<Wall> with_another_room(const Vector2d& middle) {
  std::vector<Wall> walls = test::furnished_room();
  test::add_box(middle - Vector2d(4.5, 6.0), middle + Vector2d(3.5, 5.0), &walls);
  test::add_box(middle + Vector2d(-3.5, 1.5), middle + Vector2d(-2.5, 3.0), &walls);
  test::add_box(middle + Vector2d(2.5, -1.0), middle + Vector2d(3.5, 0.0), &walls);
  walls.push_back({middle + Vector2d(1.5, 5.0), middle + Vector2d(3.5, 3.5)});
  return walls;
}

TEST(KidnapIntoTheUnknown, IsNeverTakenForAReturn) {
  const Vector2d middle(60.0, 7.0);
  SimulatedDrive drive(with_another_room(middle));
  drive.go(150);
  drive.be_carried_by(Pose2(middle.x() + 0.4, middle.y() - 0.3, 2.5));
  drive.go(400);
  EXPECT_GE(drive.health().times_lost, 1);
  EXPECT_THAT(drive.relocalised(), IsEmpty());
}

/// Of robots that are carried from the furnished room to the other one, or back.
struct KidnapTally {
  int kidnaps = 0;
  int noticed = 0;
};

/// Turned by eight angles that are not the same for any two seeds.
KidnapTally kidnaps_noticed(unsigned seed, int within_scans) {
  const Vector2d middle(60.0, 7.0);
  KidnapTally tally;
  for (int eighth = 0; eighth < 8; ++eighth) {
    for (const bool is_back : {false, true}) {
      const double turn_rad = eighth * kPi / 4.0 + 0.1 * (seed - 1);
      const Pose2 there(middle.x() + 0.4, middle.y() - 0.3, turn_rad);
      SimulatedDrive drive(with_another_room(middle), seed);
      drive.be_carried_by(is_back ? there : Pose2());
      drive.go(100 + 13 * static_cast<int>(seed));
      EXPECT_EQ(drive.health().times_lost, 0) << "before it was carried";
      drive.be_carried_by(is_back ? Pose2() : there);
      drive.go(within_scans);
      ++tally.kidnaps;
      tally.noticed += drive.health().times_lost > 0 ? 1 : 0;
    }
  }
  return tally;
}

// Not all: where most of the beams end on walls of the other room, and few go through one.
TEST(KidnapToAnotherRoom, IsMostlyNoticedHoweverTheRobotIsTurned) {
  constexpr int kWithinScans = 40;
  KidnapTally all;
  for (unsigned seed = 1; seed <= 3; ++seed) {
    const KidnapTally tally = kidnaps_noticed(seed, kWithinScans);
    all.kidnaps += tally.kidnaps;
    all.noticed += tally.noticed;
  }
  RecordProperty("kidnaps", all.kidnaps);
  RecordProperty("noticed", all.noticed);
  EXPECT_GE(all.noticed, all.kidnaps * 85 / 100);
}

TEST_F(Kidnap, IsRecalledAsItWas) {
  kidnap(&drive_);
  drive_.go(60);
  drive_.finish();
  MappingService recalled{ServiceOptions()};
  for (const PerceivedScan& scan : drive_.perceived()) {
    recalled.recall(scan);
  }
  for (const Visit& visit : drive_.visits()) {
    ASSERT_TRUE(recalled.recall(visit).ok());
  }
  recalled.resume();
  const auto before = drive_.service().state();
  const auto after = recalled.state();
  ASSERT_EQ(after->trajectory.size(), before->trajectory.size());
  EXPECT_EQ(after->trajectory.back().T_global_robot, before->trajectory.back().T_global_robot);
  EXPECT_EQ(recalled.health().state, LocalisationState::kTracking);
}

}  // namespace
}  // namespace cairn
