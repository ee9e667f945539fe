#include "lpm/global_search_run.hpp"

#include <algorithm>
#include <limits>
#include <random>

#include <gmock/gmock.h>

#include "random_map.hpp"

namespace cairn {
namespace {

using test::random_map;
using test::random_points;
using testing::SizeIs;

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

TEST(GlobalSearchRun, FindsTheSameAboveALeastScoreWithLessWork) {
  const GlobalSearchOptions options = close_neighbours();
  for (unsigned seed = 0; seed < 6; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const GlobalSearch search(random_map(&random), options);
    const std::vector<SurfacePoint> points = random_points(&random);
    GlobalSearchRun all(search, points, {20});
    all.work(std::numeric_limits<std::int64_t>::max());
    ASSERT_THAT(all.found(), SizeIs(20));
    const double least = all.found()[3].score;
    GlobalSearchRun some(search, points, {20, least});
    some.work(std::numeric_limits<std::int64_t>::max());
    std::vector<double> expected = scores_of(all.found());
    expected.erase(std::remove_if(expected.begin(), expected.end(),
                                  [&](double score) { return score < least; }),
                   expected.end());
    EXPECT_EQ(scores_of(some.found()), expected);
    EXPECT_LT(some.lookups(), all.lookups());
  }
}

TEST(GlobalSearchRun, FindsTheSameInSlicesAndEachIsBounded) {
  constexpr std::int64_t kSlice = 500;
  constexpr std::int64_t kRefinement = 5'000;
  constexpr std::int64_t kOneBlock = 16 * 3 * 12 + 4 * 2 * 3 * 12;  // turned, and looked up
  for (unsigned seed = 0; seed < 6; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const GlobalSearch search(random_map(&random), close_neighbours());
    const std::vector<SurfacePoint> points = random_points(&random);
    const std::vector<GlobalMatch> whole = search.find(points, {5});
    GlobalSearchRun run(search, points, {5});
    int slices = 0;
    while (!run.is_done()) {
      const std::int64_t before = run.lookups();
      run.work(kSlice);
      EXPECT_LT(run.lookups() - before, kSlice + 8 * kOneBlock + 5 * kRefinement);
      ++slices;
    }
    EXPECT_GT(slices, 10);
    ASSERT_EQ(run.found().size(), whole.size());
    for (std::size_t i = 0; i < whole.size(); ++i) {
      EXPECT_EQ(run.found()[i].raster_pose, whole[i].raster_pose);
      EXPECT_EQ(run.found()[i].T_map_robot.mean, whole[i].T_map_robot.mean);
      EXPECT_EQ(run.found()[i].T_map_robot.covariance, whole[i].T_map_robot.covariance);
      EXPECT_EQ(run.found()[i].score, whole[i].score);
    }
  }
}

}  // namespace
}  // namespace cairn
