#include "lpm/global_search.hpp"

#include <algorithm>

#include <gmock/gmock.h>

#include "random_map.hpp"
#include "support/ascii_grid.hpp"

namespace cairn {
namespace {

using test::kCell_m;
using test::random_map;
using test::random_points;
using testing::DoubleNear;
using testing::IsEmpty;
using testing::Pointwise;
using testing::SizeIs;

/// The score as documented, cell by cell and without any pyramid.
double obvious_score(const OccupancyGrid& map,
                     const std::vector<SurfacePoint>& points,
                     Cell robot,
                     double theta_rad,
                     const GlobalSearchOptions& options) {
  const auto reached = [&](const Vector2d& p) {
    const Vector2d cells = (Pose2(0.0, 0.0, theta_rad) * p) / kCell_m;
    return Cell{robot.x + static_cast<int>(std::lround(cells.x())),
                robot.y + static_cast<int>(std::lround(cells.y()))};
  };
  double sum = 0.0;
  for (const SurfacePoint& point : points) {
    const Cell hit = reached(point.p);
    int nearest2 = 1'000'000;
    for (int y = 0; y < map.geometry().height; ++y) {
      for (int x = 0; x < map.geometry().width; ++x) {
        if (map.state({x, y}) == CellState::kOccupied) {
          nearest2 = std::min(nearest2, (x - hit.x) * (x - hit.x) + (y - hit.y) * (y - hit.y));
        }
      }
    }
    const double sigma_cells = options.hit_sigma_m / kCell_m;
    if (map.contains(hit) && nearest2 <= 100) {
      sum += std::round(255.0 * std::exp(-0.5 * nearest2 / (sigma_cells * sigma_cells)));
    }
    for (const double share : {0.4, 0.8}) {
      const Cell way = reached(share * point.p);
      const CellState state = map.state(way);
      const double freeness = state == CellState::kFree ? 255.0 : 64.0;
      sum += !map.contains(way) || state == CellState::kOccupied
                 ? 0.0
                 : 0.5 * options.free_weight * freeness;
    }
  }
  return sum / (255.0 * (1.0 + options.free_weight) * static_cast<double>(points.size()));
}

bool is_near_free(const OccupancyGrid& map, Cell robot, int reach) {
  for (int y = robot.y - reach; y <= robot.y + reach; ++y) {
    for (int x = robot.x - reach; x <= robot.x + reach; ++x) {
      if (map.state({x, y}) == CellState::kFree) {
        return true;
      }
    }
  }
  return false;
}

struct Scored {
  Pose2 pose;
  double score = 0.0;
};

/// Every pose of the raster.
std::vector<Scored> all_scores(const OccupancyGrid& map,
                               const std::vector<SurfacePoint>& points,
                               const GlobalSearchOptions& options) {
  double farthest_m = kCell_m;
  for (const SurfacePoint& point : points) {
    farthest_m = std::max(farthest_m, point.p.norm());
  }
  const int angles = static_cast<int>(std::ceil(2.0 * kPi * farthest_m / kCell_m));
  std::vector<Scored> all;
  for (int angle = 0; angle < angles; ++angle) {
    const double theta_rad = wrap_angle(2.0 * kPi * angle / angles);
    for (int y = 0; y < map.geometry().height; ++y) {
      for (int x = 0; x < map.geometry().width; ++x) {
        if (is_near_free(map, {x, y}, 1)) {
          all.push_back({Pose2(map.geometry().center_of({x, y}), theta_rad),
                         obvious_score(map, points, {x, y}, theta_rad, options)});
        }
      }
    }
  }
  return all;
}

bool are_neighbours(const Pose2& a, const Pose2& b, const GlobalSearchOptions& options) {
  return (a.translation() - b.translation()).norm() < options.neighbour_m &&
         std::abs(turn_between(a.theta(), b.theta())) < options.neighbour_rad;
}

/// The scores of the best poses that are no neighbours, by looking at every one.
std::vector<double> best_scores(std::vector<Scored> all,
                                std::size_t count,
                                const GlobalSearchOptions& options) {
  std::stable_sort(all.begin(), all.end(),
                   [](const Scored& a, const Scored& b) { return a.score > b.score; });
  std::vector<Scored> best;
  for (const Scored& any : all) {
    const bool is_new = std::none_of(best.begin(), best.end(), [&](const Scored& better) {
      return are_neighbours(any.pose, better.pose, options);
    });
    if (is_new && best.size() < count) {
      best.push_back(any);
    }
  }
  std::vector<double> scores;
  for (const Scored& any : best) {
    scores.push_back(any.score);
  }
  return scores;
}

std::vector<double> scores_of(const std::vector<GlobalMatch>& matches) {
  std::vector<double> scores;
  for (const GlobalMatch& match : matches) {
    scores.push_back(match.score);
  }
  return scores;
}

GlobalSearchOptions close_neighbours() {
  GlobalSearchOptions options;
  options.robot_clearance_m = 0.11;
  options.neighbour_m = 0.35;
  return options;
}

TEST(GlobalSearch, FindsWhatExhaustiveSearchFinds) {
  const GlobalSearchOptions options = close_neighbours();
  for (unsigned seed = 0; seed < 6; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const OccupancyGrid map = random_map(&random);
    const std::vector<SurfacePoint> points = random_points(&random);
    const std::vector<GlobalMatch> found = GlobalSearch(map, options).find(points, {5});
    EXPECT_THAT(
        scores_of(found),
        Pointwise(DoubleNear(1e-9), best_scores(all_scores(map, points, options), 5, options)));
  }
}

OccupancyGrid lopsided_room() {
  return test::grid_of({"####################", "#........#.........#", "#........#.........#",
                        "#..................#", "#..................#", "#...............####",
                        "#...............####", "#..................#", "#.....##...........#",
                        "#.....##...........#", "#..................#", "####################"},
                       kCell_m);
}

/// What a laser sees from a pose, with a return every few degrees.
std::vector<SurfacePoint> seen_from(const OccupancyGrid& map, const Pose2& T_map_robot) {
  std::vector<SurfacePoint> points;
  for (double bearing_rad = -kPi; bearing_rad < kPi; bearing_rad += 0.05) {
    for (double range_m = 0.0; range_m < 5.0; range_m += 0.02) {
      const Vector2d p(range_m * std::cos(bearing_rad), range_m * std::sin(bearing_rad));
      if (map.state(map.geometry().cell_at(T_map_robot * p)) == CellState::kOccupied) {
        points.push_back({p, Vector2d(std::cos(bearing_rad), std::sin(bearing_rad))});
        break;
      }
    }
  }
  return points;
}

TEST(GlobalSearch, FindsTheRobotInARoomFromNoPrior) {
  const OccupancyGrid map = lopsided_room();
  GlobalSearchOptions options;
  options.hit_sigma_m = 0.07;
  options.neighbour_m = 0.3;
  const GlobalSearch search(map, options);
  for (const Pose2& truth : {Pose2(0.35, 0.35, 0.3), Pose2(1.4, 0.8, 2.8), Pose2(1.55, 0.25, -2.0),
                             Pose2(0.3, 0.85, -0.9)}) {
    const auto found = search.find(seen_from(map, truth), {2});
    ASSERT_THAT(found, SizeIs(2));
    const Pose2& pose = found[0].T_map_robot.mean;
    EXPECT_LT((pose.translation() - truth.translation()).norm(), 0.08);
    EXPECT_LT(std::abs(turn_between(pose.theta(), truth.theta())), 0.1);
    EXPECT_GT(found[0].score, found[1].score + 0.02);
    EXPECT_TRUE(is_positive_definite(found[0].T_map_robot.covariance));
  }
}

TEST(GlobalSearch, HasNoMarginWhereTwoPlacesAreAlike) {
  const OccupancyGrid twins = test::grid_of(
      {"###########", "#....#....#", "#....#....#", "#....#....#", "##...###..#", "###########"},
      kCell_m);
  OccupancyGrid same = twins;  // the right half becomes a copy of the left one
  for (int y = 0; y < 6; ++y) {
    for (int x = 0; x < 6; ++x) {
      same.log_odds({x + 5, y}) = twins.log_odds({x, y});
    }
  }
  GlobalSearchOptions options;
  options.neighbour_m = 0.3;
  const auto found = GlobalSearch(same, options).find(seen_from(same, Pose2(0.25, 0.35, 0.1)), {2});
  ASSERT_THAT(found, SizeIs(2));
  EXPECT_LT(found[0].score - found[1].score, 0.02);
}

TEST(GlobalSearch, LooksOnlyIntoItsWindow) {
  const OccupancyGrid map = lopsided_room();
  GlobalSearchOptions options;
  options.neighbour_m = 0.1;
  const GlobalSearch search(map, options);
  const GlobalWindow window{Pose2(1.4, 0.8, 2.0), 0.2, 0.3};
  for (const GlobalMatch& match :
       search.find(seen_from(map, Pose2(0.35, 0.35, 0.3)), {5, 0.0, window})) {
    EXPECT_LE((match.raster_pose.translation() - window.center.translation()).cwiseAbs().maxCoeff(),
              0.2 + kCell_m);
    EXPECT_LE(std::abs(turn_between(match.raster_pose.theta(), 2.0)), 0.3);
  }
}

TEST(GlobalSearch, FindsNothingWhereThereIsNothing) {
  const OccupancyGrid map = lopsided_room();
  const auto points = seen_from(map, Pose2(0.35, 0.35, 0.3));
  EXPECT_THAT(GlobalSearch(map).find({}, {3}), IsEmpty());
  EXPECT_THAT(GlobalSearch(OccupancyGrid()).find(points, {3}), IsEmpty());
  EXPECT_THAT(GlobalSearch(OccupancyGrid(map.geometry())).find(points, {3}), IsEmpty());
  EXPECT_THAT(GlobalSearch(map).find(points, {3, 0.0, {Pose2(90.0, 90.0, 0.0), 1.0, 1.0}}),
              IsEmpty());
  EXPECT_THAT(GlobalSearch(map).find(points, {0}), IsEmpty());
}

}  // namespace
}  // namespace cairn
