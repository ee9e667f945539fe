#include "bench/lab/closure_truth.hpp"

#include <sstream>

#include <gmock/gmock.h>

#include "bench/lab/program.hpp"
#include "clients/common/failure.hpp"
#include "support/files.hpp"

namespace cairn::lab {
namespace {

using ::testing::HasSubstr;
using ::testing::Property;
using ::testing::Throws;

constexpr double kSame_m = 2.0;

/// Visits along the x axis.
std::vector<JudgedVisit> visits(const std::vector<std::pair<int, double>>& place_and_x_m) {
  std::vector<JudgedVisit> all;
  for (const auto& [place, x_m] : place_and_x_m) {
    all.push_back({place, Vector2d(x_m, 0.0)});
  }
  return all;
}

TEST(ClosureTruth, ARoundIsClosedOnceAndThenKnown) {
  const ClosureReport report = judge_closures(
      visits({{0, 0.0}, {1, 10.0}, {2, 20.0}, {0, 0.5}, {1, 10.5}, {2, 19.5}}), kSame_m);
  EXPECT_EQ(report.visits, 6U);
  EXPECT_EQ(report.places, 3U);
  EXPECT_EQ(report.revisits, 3U);
  EXPECT_EQ(report.closures, 1U) << "only the way from place 2 to place 0 was new";
  EXPECT_TRUE(report.merged.empty());
  EXPECT_TRUE(report.missed.empty());
  EXPECT_EQ(report.found_share(), 1.0);
}

TEST(ClosureTruth, TakingAnotherPlaceForAKnownOneIsAFalseClosure) {
  const ClosureReport report = judge_closures(visits({{0, 0.0}, {1, 10.0}, {0, 20.0}}), kSame_m);
  ASSERT_EQ(report.merged.size(), 1U);
  EXPECT_EQ(report.merged[0].visit, 2U);
  EXPECT_EQ(report.merged[0].other, 0U);
  EXPECT_EQ(report.merged[0].distance_m, 20.0);
}

TEST(ClosureTruth, TakingAKnownPlaceForANewOneIsAMiss) {
  const ClosureReport report =
      judge_closures(visits({{0, 0.0}, {1, 10.0}, {2, 1.0}, {1, 10.0}}), kSame_m);
  ASSERT_EQ(report.missed.size(), 1U);
  EXPECT_EQ(report.missed[0].visit, 2U);
  EXPECT_EQ(report.missed[0].other, 0U);
  EXPECT_DOUBLE_EQ(report.found_share(), 0.5);
}

TEST(ClosureTruth, VisitsThatTheReferenceDoesNotReachAreNotJudged) {
  std::vector<JudgedVisit> all = visits({{0, 0.0}, {0, 50.0}});
  all[1].p_reference.reset();
  const ClosureReport report = judge_closures(all, kSame_m);
  EXPECT_EQ(report.unknown, 1U);
  EXPECT_TRUE(report.merged.empty());
}

TEST(Reference, BetweenTwoPosesItIsInterpolatedTheShortWayAround) {
  const std::vector<ReferencePose> reference{{10.0, Pose2(0.0, 0.0, 3.0)},
                                             {20.0, Pose2(4.0, 2.0, -3.0)}};
  const std::optional<Pose2> pose = reference_at(reference, 15.0);
  ASSERT_TRUE(pose);
  EXPECT_DOUBLE_EQ(pose->x(), 2.0);
  EXPECT_DOUBLE_EQ(pose->y(), 1.0);
  EXPECT_NEAR(std::abs(pose->theta()), 3.14159, 1e-3);
}

TEST(Reference, ItReachesBeyondItsEndsByTwoSecondsOnly) {
  const std::vector<ReferencePose> reference{{10.0, Pose2()}, {20.0, Pose2(4.0, 2.0, 0.0)}};
  EXPECT_TRUE(reference_at(reference, 8.5));
  EXPECT_TRUE(reference_at(reference, 21.5));
  EXPECT_FALSE(reference_at(reference, 7.5));
  EXPECT_FALSE(reference_at(reference, 22.5));
  EXPECT_FALSE(reference_at({}, 10.0));
}

TEST(Reference, ABadLineIsNamed) {
  const test::TemporaryFolder folder;
  const auto file = folder / "bad.txt";
  test::write_file(file, "# time x y theta\n1 2 3 0\n1 2 three 0\n");
  EXPECT_THAT([&] { static_cast<void>(read_reference(file)); },
              Throws<clients::Failure>(
                  Property(&clients::Failure::what, HasSubstr("line 3: expected time x y theta"))));
}

TEST(Reference, AFileWithoutPosesIsNone) {
  const test::TemporaryFolder folder;
  const auto file = folder / "empty.txt";
  test::write_file(file, "# nothing\n");
  EXPECT_THAT([&] { static_cast<void>(read_reference(file)); },
              Throws<clients::Failure>(Property(&clients::Failure::what, HasSubstr("no pose"))));
  EXPECT_THAT(
      [&] { static_cast<void>(read_reference(folder / "none.txt")); },
      Throws<clients::Failure>(Property(&clients::Failure::what, HasSubstr("cannot be read"))));
}

TEST(ClosuresCommand, ADistanceThatIsNoNumberIsAUsageError) {
  for (const char* const same : {"nan", "-1", "1e9", "far"}) {
    std::ostringstream out;
    std::ostringstream err;
    EXPECT_EQ(run_lab({"closures", "a.clf", "--reference", "a.txt", "--same", same}, out, err), 64)
        << same;
    EXPECT_THAT(err.str(), HasSubstr("--same")) << same;
  }
}

TEST(BuildingsCommand, ASeedBeyondAllSeedsIsAUsageError) {
  for (const char* const seed : {"-1", "99999999999999999999999", "nan", "one"}) {
    std::ostringstream out;
    std::ostringstream err;
    EXPECT_EQ(run_lab({"buildings", "--seed", seed}, out, err), 64) << seed;
    EXPECT_THAT(err.str(), HasSubstr("--seed")) << seed;
  }
}

}  // namespace
}  // namespace cairn::lab
