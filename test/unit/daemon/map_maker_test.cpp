#include "runtime/map_maker.hpp"

#include <cairn_lcm/snapshot_request_t.hpp>
#include <cairn_lcm/topology_t.hpp>
#include <gmock/gmock.h>

#include "support/experience.hpp"
#include "wire/document.hpp"
#include "wire/signatures.hpp"

namespace cairn {
namespace {

using ::testing::SizeIs;

std::vector<PosedScan> poses(const std::vector<Pose2>& T_global_robot) {
  std::vector<PosedScan> trajectory;
  for (const Pose2& pose : T_global_robot) {
    trajectory.push_back({test::scan_at(0, pose, Pose2()).scan, pose});
  }
  return trajectory;
}

TEST(ScansWorthDrawing, LeaveOutWhatAStandingRobotSeesAgain) {
  EXPECT_THAT(scans_worth_drawing(poses({Pose2(), Pose2(0.01, 0, 0), Pose2(0.5, 0, 0),
                                         Pose2(0.5, 0, 0.01), Pose2(0.5, 0, 0.5)})),
              SizeIs(3));
}

TEST(ScansWorthDrawing, LeaveOutWhatIsNotToBeTrusted) {
  std::vector<PosedScan> trajectory = poses({Pose2(), Pose2(1.0, 0, 0), Pose2(2.0, 0, 0)});
  trajectory[1].is_trusted = false;
  const std::vector<PosedScan> worth = scans_worth_drawing(trajectory);
  ASSERT_THAT(worth, SizeIs(2));
  EXPECT_EQ(worth[1].scan, trajectory[2].scan);
}

TEST(MapMaker, TellsWhichTilesChangedAndCountsARevisionForThem) {
  MapMaker maker({});
  MapState state;
  state.trajectory = poses({Pose2()});
  EXPECT_FALSE(maker.draw(state).empty());
  EXPECT_TRUE(maker.draw(state).empty());
  state.trajectory = poses({Pose2(), Pose2(5.0, 0.0, 0.0)});
  EXPECT_FALSE(maker.draw(state).empty());
}

TEST(MapMaker, ATileThatLooksAsBeforeHasNotChanged) {
  MapMaker maker({});
  MapState state;
  for (int round = 0; round < 20; ++round) {
    for (const PosedScan& scan : poses({Pose2(), Pose2(5.0, 0.0, 0.0)})) {
      state.trajectory.push_back(scan);
    }
  }
  EXPECT_FALSE(maker.draw(state).empty());
  for (const PosedScan& scan : poses({Pose2(), Pose2(5.0, 0.0, 0.0)})) {
    state.trajectory.push_back(scan);  // What was seen there twenty times.
  }
  EXPECT_TRUE(maker.draw(state).empty());
  state.trajectory.push_back(poses({Pose2(0.0, 7.0, 0.0)}).front());
  EXPECT_FALSE(maker.draw(state).empty());
}

TEST(MapMaker, ItsDocumentsAreMessages) {
  MapMaker maker({});
  MapState state;
  state.trajectory = poses({Pose2()});
  state.topology_revision = 4;
  maker.draw(state);
  const Documents documents = maker.documents(state, {0, 42});
  EXPECT_THAT(documents.bytes, SizeIs(5));
  const auto topology = wire::from_document<cairn_lcm::topology_t>(
      documents.bytes.at(cairn_lcm::snapshot_request_t::TOPOLOGY));
  ASSERT_TRUE(topology.ok());
  EXPECT_EQ(topology->revision, 4);
  EXPECT_EQ(topology->map_id, 42);
}

TEST(ToTiles, PutsEveryCellWhereItLies) {
  GridGeometry geometry;
  geometry.width = 20;
  geometry.height = 20;
  geometry.origin_m = Vector2d(-0.5, -0.5);
  OccupancyGrid grid(geometry);
  grid.log_odds({0, 0}) = 300;     // (-0.475, -0.475): tile (-1, -1)
  grid.log_odds({19, 19}) = -300;  // (0.475, 0.475): tile (0, 0)
  const wire::ReplicatedGrid tiles = to_tiles(grid, 16);
  ASSERT_THAT(tiles.tiles, SizeIs(2));
  const wire::Bytes& wall = *tiles.tiles.at({-1, -1});
  EXPECT_EQ(wall[6 * 16 + 6], 95);
  EXPECT_EQ(wall[0], GlobalMap::kUnknownPercent);
  EXPECT_EQ((*tiles.tiles.at({0, 0}))[9 * 16 + 9], 5);
}

}  // namespace
}  // namespace cairn
