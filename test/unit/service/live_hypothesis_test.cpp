#include <gmock/gmock.h>

#include "service/mapping_service.hpp"
#include "support/experience.hpp"

namespace cairn {
namespace {

using test::corner_at;
using test::scan_at;
using ::testing::HasSubstr;
using ::testing::SizeIs;

/// Corners that look all the same, ten metres apart, under the papers' strict tree: what the views
/// do not tell is left open, so that many maps live.
class LiveHypothesisTest : public ::testing::Test {
 protected:
  void visit_corners(int count) {
    for (int i = 0; i < count; ++i) {
      const Pose2 at(10.0 * visits_++, 0.0, 0.0);
      for (int step = 0; step < 2; ++step) {
        service_.recall(scan_at(scans_, at, Pose2(scans_ == 0 ? 0.0 : 5.0, 0, 0)));
        ++scans_;
      }
      const Visit visit{corner_at(at.translation()), static_cast<std::size_t>(scans_ - 1)};
      EXPECT_TRUE(service_.recall(visit).ok());
    }
  }

  static ServiceOptions strict() {
    ServiceOptions options;
    options.evidence = "";
    options.topology.noisy_stars = false;
    options.topology.log_prior_new_place = -1.0;
    return options;
  }

  MappingService service_{strict()};
  int visits_ = 0;
  int scans_ = 0;
};

void expect_same_poses(const MapState& a, const MapState& b) {
  ASSERT_EQ(a.trajectory.size(), b.trajectory.size());
  for (std::size_t i = 0; i < a.trajectory.size(); ++i) {
    EXPECT_EQ(a.trajectory[i].scan, b.trajectory[i].scan);
    EXPECT_TRUE(a.trajectory[i].T_global_robot == b.trajectory[i].T_global_robot);
  }
}

TEST_F(LiveHypothesisTest, OfTheBestOneThePictureIsThatOfTheBestMap) {
  visit_corners(7);
  service_.name_place_of(VisitId{2}, "kitchen");
  const std::shared_ptr<const MapState> best = service_.state();
  const auto asked = service_.state_of(best->hypothesis);

  ASSERT_TRUE(asked.ok()) << asked.error().message;
  const MapState& one = **asked;
  expect_same_poses(one, *best);
  EXPECT_EQ(one.hypothesis, best->hypothesis);
  EXPECT_EQ(one.probability, best->probability);
  EXPECT_EQ(one.topology_revision, best->topology_revision);
  EXPECT_EQ(one.place_of_visit, best->place_of_visit);
  ASSERT_EQ(one.places.size(), best->places.size());
  for (std::size_t i = 0; i < one.places.size(); ++i) {
    EXPECT_EQ(one.places[i].name, best->places[i].name);
    EXPECT_EQ(one.places[i].star, best->places[i].star);
    EXPECT_EQ(one.places[i].T_global_place.covariance, best->places[i].T_global_place.covariance);
  }
  EXPECT_EQ(one.segments.size(), best->segments.size());
  EXPECT_EQ(one.same_places.size(), best->same_places.size());
}

TEST_F(LiveHypothesisTest, EveryLiveOneHasItsOwnMapOfAllScans) {
  visit_corners(7);
  const std::int64_t revision = service_.revision();
  const std::shared_ptr<const MapState> best = service_.state();
  ASSERT_GT(best->hypotheses.size(), 2U);

  double sum = 0.0;
  for (const HypothesisSummary& summary : best->hypotheses) {
    const auto asked = service_.state_of(summary.id);
    ASSERT_TRUE(asked.ok()) << asked.error().message;
    EXPECT_EQ((*asked)->hypothesis, summary.id);
    EXPECT_EQ(static_cast<int>((*asked)->places.size()), summary.places);
    EXPECT_EQ((*asked)->closure_count, summary.closures);
    EXPECT_THAT((*asked)->trajectory, SizeIs(best->trajectory.size()));
    EXPECT_THAT((*asked)->place_of_visit, SizeIs(7));
    EXPECT_DOUBLE_EQ((*asked)->probability, summary.probability);
    sum += (*asked)->probability;
  }

  EXPECT_NEAR(sum, 1.0, 1e-9);
  EXPECT_EQ(service_.revision(), revision);
  expect_same_poses(*service_.state(), *best);
}

TEST_F(LiveHypothesisTest, AnUnknownOneIsRefusedWithThoseThatLive) {
  EXPECT_THAT(service_.state_of(0).error().message, HasSubstr("no map yet"));
  visit_corners(3);
  for (const std::int64_t number :
       {std::int64_t{-1}, std::int64_t{99'999}, std::int64_t{1} << 40}) {
    const auto refused = service_.state_of(number);
    ASSERT_FALSE(refused.ok());
    EXPECT_EQ(refused.error().code, ErrorCode::kNotFound);
    EXPECT_THAT(refused.error().message,
                HasSubstr("hypothesis " + std::to_string(number) + " is not live"));
    EXPECT_THAT(refused.error().message,
                HasSubstr("expected one of " + std::to_string(service_.state()->hypothesis)));
  }
}

TEST_F(LiveHypothesisTest, OneThatHasGrownIntoOthersIsNotLiveAnyMore) {
  visit_corners(2);
  const std::int64_t early = service_.state()->hypothesis;
  visit_corners(4);
  const auto refused = service_.state_of(early);
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().code, ErrorCode::kNotFound);
  EXPECT_THAT(refused.error().message, HasSubstr("is not live"));
}

}  // namespace
}  // namespace cairn
