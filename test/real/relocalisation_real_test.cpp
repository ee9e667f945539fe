#include <cmath>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <zlib.h>

#include "lpm/global_localiser.hpp"
#include "lpm/surface_points.hpp"
#include "support/carmen_scans.hpp"
#include "support/recorded_data.hpp"

namespace cairn {
namespace {

constexpr const char* kMap = "laser/cmu_wean/wean.dat.gz";
constexpr const char* kOneRun = "laser/cmu_wean/robotdata1.clf";
constexpr const char* kTwoRuns = "laser/cmu_wean/robotdata5.clf";
constexpr int kSecondRun = 713;  // first scan of it

std::string unpacked(const std::string& file) {
  std::string text;
  const gzFile packed = gzopen(test::recorded_data(file).c_str(), "rb");
  std::vector<char> buffer(1 << 16);
  for (int read = 0;
       (read = gzread(packed, buffer.data(), static_cast<unsigned>(buffer.size()))) > 0;) {
    text.append(buffer.data(), static_cast<std::size_t>(read));
  }
  gzclose(packed);
  return text;
}

/// A map of the BeeSoft kind: after "global_map[0]: <rows> <columns>" the probability of every cell
/// of being free, -1 where nothing is known; rows along x, columns along y.
OccupancyGrid beesoft_map(const std::string& text) {
  const std::string title = "global_map[0]:";
  std::istringstream words(text.substr(text.find(title) + title.size()));
  GridGeometry geometry;
  geometry.cell_m = 0.1;
  words >> geometry.width >> geometry.height;
  OccupancyGrid map(geometry);
  for (int x = 0; x < geometry.width; ++x) {
    for (int y = 0; y < geometry.height; ++y) {
      double free_probability = -1.0;
      words >> free_probability;
      if (free_probability > 0.85) {
        map.log_odds({x, y}) = -300;
      } else if (free_probability >= 0.0 && free_probability < 0.3) {
        map.log_odds({x, y}) = 300;
      }
    }
  }
  return map;
}

GaussianPose unsure(const Pose2& step) {
  GaussianPose motion{step, Matrix3d::Zero()};
  const double drive_m = step.translation().norm();
  const double turn_rad = std::abs(step.theta());
  motion.covariance.diagonal() << 1e-6 + 0.01 * drive_m, 1e-6 + 0.005 * drive_m,
      1e-6 + 0.005 * drive_m + 0.01 * turn_rad;
  return motion;
}

struct Journey {
  std::map<int, Pose2> T_map_robot;  // by scan, while localised
  std::vector<int> accepted_at;
  std::vector<int> lost_at;
};

Journey localised(const std::string& log, int from_scan) {
  const GlobalSearch search(beesoft_map(unpacked(kMap)));
  GlobalLocaliser localiser(search);
  Journey run;
  Pose2 T_odom_robot;
  Pose2 last;
  int scan_number = -1;
  for (const test::CarmenMessage& message : test::read_carmen(test::recorded_data(log))) {
    const auto* scan = std::get_if<LaserScan>(&message);
    if (scan == nullptr) {
      T_odom_robot = std::get<OdometrySample>(message).T_odom_robot;
      continue;
    }
    ++scan_number;
    // Odometry begins anew with the second run, and does not tell how the robot was carried.
    const Pose2 step = scan_number == kSecondRun ? Pose2() : last.inverse() * T_odom_robot;
    last = T_odom_robot;
    if (scan_number < from_scan) {
      continue;
    }
    const GlobalFix fix = localiser.absorb(surface_points_of(*scan, 0.05, 15.0), unsure(step));
    if (fix.T_map_robot) {
      run.T_map_robot[scan_number] = fix.T_map_robot->mean;
    }
    if (fix.state == Localisation::kAccepted) {
      run.accepted_at.push_back(scan_number);
    } else if (fix.state == Localisation::kLost) {
      run.lost_at.push_back(scan_number);
    }
  }
  return run;
}

// Started in different places, the robot must come to the same poses: what is one trajectory by
// odometry is one in the map.
TEST(GlobalLocaliserOnWean, ComesToOneTrajectoryFromWhereverItStarts) {
  CAIRN_NEED_DATA(kMap);
  const Journey whole = localised(kOneRun, 0);
  const Journey later = localised(kOneRun, 150);
  ASSERT_THAT(whole.accepted_at, testing::SizeIs(1));
  ASSERT_THAT(later.accepted_at, testing::SizeIs(1));
  EXPECT_THAT(whole.lost_at, testing::IsEmpty());
  EXPECT_THAT(later.lost_at, testing::IsEmpty());
  EXPECT_LT(whole.accepted_at.front(), 300);
  EXPECT_LT(later.accepted_at.front(), 300);
  int together = 0;
  for (const auto& [scan, pose] : later.T_map_robot) {
    if (whole.T_map_robot.count(scan) > 0) {
      const Pose2& other = whole.T_map_robot.at(scan);
      EXPECT_LT((pose.translation() - other.translation()).norm(), 1.0) << scan;
      EXPECT_LT(std::abs(turn_between(pose.theta(), other.theta())), 0.15) << scan;
      ++together;
    }
  }
  EXPECT_GT(together, 400);
  // In the long corridor, at the end of which the log begins and ends.
  EXPECT_NEAR(whole.T_map_robot.rbegin()->second.x(), 39.9, 1.0);
  EXPECT_NEAR(whole.T_map_robot.rbegin()->second.y(), 40.9, 1.0);
}

TEST(GlobalLocaliserOnWean, NoticesTheKidnapAndRecovers) {
  CAIRN_NEED_DATA(kMap);
  const Journey run = localised(kTwoRuns, 100);
  ASSERT_FALSE(run.accepted_at.empty());
  EXPECT_GT(run.accepted_at.back(), kSecondRun);
  EXPECT_LT(run.accepted_at.back(), 1'050);
  for (const int lost : run.lost_at) {
    EXPECT_GT(lost, kSecondRun);
    EXPECT_LT(lost, kSecondRun + 100);
  }
  // Both runs end at the same door.
  EXPECT_NEAR(run.T_map_robot.rbegin()->second.x(), 39.9, 1.0);
  EXPECT_NEAR(run.T_map_robot.rbegin()->second.y(), 41.1, 1.0);
}

}  // namespace
}  // namespace cairn
