// Experience that cannot be: an error that says what was expected, and an unchanged tree.

#include <tuple>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/stars.hpp"
#include "traveller.hpp"

namespace cairn::test {
namespace {

using ::testing::HasSubstr;

/// Everything about a tree that a refused call might have changed.
auto state_of(const HypothesisTree& tree) {
  std::vector<std::int32_t> ids;
  for (const Hypothesis& leaf : tree.fringe()) {
    ids.push_back(leaf.id.value);
  }
  return std::tuple(tree.node_count(), tree.maps_built(), tree.visit_count(), tree.waiting_count(),
                    tree.memory().nodes, ids);
}

TEST(BadExperience, IsRefusedAndTheTreeStaysAsItWas) {
  Traveller robot(corner(), 0);
  robot.travel(0, corner(), 1);
  HypothesisTree& tree = robot.tree();
  const auto before = state_of(tree);
  const auto refused = [&](Action action, const View& view, ErrorCode code, const char* expected) {
    const Result<ExtendReport> result = tree.extend(action, view);
    ASSERT_FALSE(result.ok()) << expected;
    EXPECT_EQ(result.error().code, code);
    EXPECT_THAT(result.error().message, HasSubstr(expected));
    EXPECT_EQ(state_of(tree), before) << expected;
  };
  const VisitId next{2};
  refused({2}, {corner(), 0, next}, ErrorCode::kInvalidValue,
          "turn: expected a gateway of the place before, in [0, 2), got 2");
  refused({-1}, {corner(), 0, next}, ErrorCode::kInvalidValue, "in [0, 2), got -1");
  refused({0}, {corner(), 2, next}, ErrorCode::kInvalidValue, "arrival_gateway must be in [0, 1]");
  refused({0}, {Star{}, 0, next}, ErrorCode::kInvalidValue, "view: ");
  refused({0}, {star_of({0, -1}, {0, 1}), 0, next}, ErrorCode::kInvalidValue, "view: ");
  refused({0}, {corner(), 0, VisitId{}}, ErrorCode::kInvalidValue, "must have a visit");
  refused({0}, {corner(), 0, VisitId{1}}, ErrorCode::kOutOfOrder,
          "visit: expected 2, the next one, got 1");
  refused({0}, {corner(), 0, VisitId{3}}, ErrorCode::kOutOfOrder, "got 3");
  refused({0}, {corner(), 0, next, 1.0}, ErrorCode::kInvalidValue, "log_likelihood");
  EXPECT_TRUE(tree.extend({1}, {corner(), 1, next}).ok());
}

TEST(BadExperience, IsAStartThatComesTwiceOrATravelBeforeIt) {
  HypothesisTree tree{TopologyOptions{}};
  const Result<ExtendReport> early = tree.extend({0}, {corner(), 0, VisitId{0}});
  ASSERT_FALSE(early.ok());
  EXPECT_THAT(early.error().message, HasSubstr("before the start"));
  EXPECT_FALSE(tree.wake_up({corner(), 0, VisitId{0}}).ok());
  EXPECT_THAT(tree.start({corner(), 0, VisitId{5}}).error().message,
              HasSubstr("start: expected visit 0, got 5"));
  EXPECT_FALSE(tree.start({Star{}, 0, VisitId{0}}).ok());
  EXPECT_FALSE(tree.is_started());
  ASSERT_TRUE(tree.start({corner(), 0, VisitId{0}}).ok());
  const auto before = state_of(tree);
  EXPECT_EQ(tree.start({tee(), 0, VisitId{0}}).error().code, ErrorCode::kOutOfOrder);
  EXPECT_EQ(state_of(tree), before);
}

}  // namespace
}  // namespace cairn::test
