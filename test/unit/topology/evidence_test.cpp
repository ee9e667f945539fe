#include "topology/evidence.hpp"

#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "traveller.hpp"

namespace cairn::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST(EvidenceName, IsOneOfTheKnownOnes) {
  EXPECT_THAT(*evidence_named(""), IsEmpty());
  EXPECT_THAT(*evidence_named("  "), IsEmpty());
  EXPECT_THAT(*evidence_named("layout"), ElementsAre(EvidenceName::kLayout));
  EXPECT_THAT(*evidence_named(" place_match  layout "),
              ElementsAre(EvidenceName::kPlaceMatch, EvidenceName::kLayout));
}

TEST(EvidenceName, ThatIsUnknownIsAnErrorThatListsTheKnownOnes) {
  for (const char* names : {"magic", "layout magic", "Layout", "layout,place_match"}) {
    const auto named = evidence_named(names);
    ASSERT_FALSE(named.ok()) << names;
    EXPECT_EQ(named.error().code, ErrorCode::kInvalidValue);
    EXPECT_THAT(named.error().message, HasSubstr("expected place_match or layout"));
  }
  EXPECT_THAT(evidence_named("layout layout").error().message, HasSubstr("named twice"));
}

// Answers of 0 and minus infinity prune; they weigh nothing.
TEST(Evidence, OfMinusInfinityRefutesClosuresAndKnownLinks) {
  const double never = -std::numeric_limits<double>::infinity();
  Evidence square;
  square.same_place = [=](SeenGateway known, SeenGateway now) {
    return known.visit.value % 4 == now.visit.value % 4 ? 0.0 : never;
  };
  const Traveller robot = around_the_block({}, square);
  // The square, and the chain whose fifth corner is a new one.
  EXPECT_EQ(robot.tree().live_count(), 2);
  EXPECT_EQ(robot.best().place_count, 4);
  EXPECT_DOUBLE_EQ(robot.best().log_posterior(), 3.0 * TopologyOptions{}.log_prior_new_place);

  Traveller back(corner(), 0, {}, always(never));
  back.travel(0, tee(), 2);
  const ExtendReport report = back.travel(0, corner(), 0);  // The known link, and evidence against.
  EXPECT_GT(report.count(Refutation::kEvidence), 0);
  EXPECT_TRUE(report.repair);
  EXPECT_GT(back.tree().live_count(), 0);
}

TEST(Evidence, ThatSaysNothingIsAsNone) {
  const Traveller plain = around_the_block();
  const Traveller asked = around_the_block({}, always(0.0));
  EXPECT_EQ(plain.tree().node_count(), asked.tree().node_count());
  EXPECT_EQ(plain.tree().live_count(), asked.tree().live_count());
  EXPECT_EQ(plain.best().log_posterior(), asked.best().log_posterior());
}

}  // namespace
}  // namespace cairn::test
