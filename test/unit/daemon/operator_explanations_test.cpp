// What operators are told of the best map and of others.

#include <algorithm>

#include <gmock/gmock.h>

#include "operator_desk_fixture.hpp"

namespace cairn {
namespace {

using cairn_lcm::assert_request_t;
using cairn_lcm::explain_request_t;
using cairn_lcm::explanation_t;
using cairn_lcm::result_t;
using test::OperatorDeskTest;
using test::visit;
using ::testing::HasSubstr;
using ::testing::Not;

TEST_F(OperatorDeskTest, TheOverviewTellsWhatEveryVisitWasTakenFor) {
  open();
  const explanation_t all = why(explain_request_t::OVERVIEW, 0);
  ASSERT_EQ(all.result.code, result_t::OK) << all.result.reason;
  ASSERT_EQ(all.num_steps, kVisits);
  EXPECT_EQ(all.next_visit, -1);
  for (int i = 0; i < kVisits; ++i) {
    const cairn_lcm::explained_step_t& step = all.steps[static_cast<std::size_t>(i)];
    EXPECT_EQ(step.visit, i);
    EXPECT_EQ(step.is_taken, 1);
    EXPECT_EQ(step.at_place, places()[static_cast<std::size_t>(i)]);
    EXPECT_THAT(step.sentence, Not(::testing::IsEmpty()));
  }
}

TEST_F(OperatorDeskTest, AVisitIsExplainedWithWhatItMightHaveBeen) {
  open();
  const explanation_t one = why(explain_request_t::VISIT, 2);
  ASSERT_EQ(one.result.code, result_t::OK);
  ASSERT_GT(one.num_steps, 1);
  EXPECT_EQ(one.steps[0].is_taken, 1);
  for (const cairn_lcm::explained_step_t& step : one.steps) {
    const bool is_open = step.is_taken == 0 && step.refuted_by.empty();
    EXPECT_EQ(step.is_fate_known, is_open ? 1 : 0);
  }
  EXPECT_EQ(why(explain_request_t::VISIT, kVisits).result.code, result_t::NOT_FOUND);
  EXPECT_EQ(why(explain_request_t::VISIT, -1).result.code, result_t::NOT_FOUND);
  EXPECT_EQ(why(9, 0).result.code, result_t::BAD_REQUEST);
}

TEST_F(OperatorDeskTest, WhatAnOperatorRuledOutIsExplainedByThat) {
  open();
  ASSERT_EQ(say(assert_request_t::DIFFERENT, visit(0), visit(2)).result.code, result_t::OK);
  const explanation_t one = why(explain_request_t::VISIT, 2);
  const auto is_by_operator = [](const cairn_lcm::explained_step_t& step) {
    return step.refuted_by == std::string(reason_of(Refutation::kOperator));
  };
  EXPECT_TRUE(std::any_of(one.steps.begin(), one.steps.end(), is_by_operator));
}

TEST_F(OperatorDeskTest, TwoHypothesesPartAtAVisit) {
  open();
  const std::vector<std::int64_t> ids = hypotheses();
  ASSERT_GT(ids.size(), 1U);
  explain_request_t request{};
  request.kind = explain_request_t::PARTING;
  request.hypothesis_a = ids[0];
  request.hypothesis_b = ids[1];
  const explanation_t parting = answer(request, *engine_);
  ASSERT_EQ(parting.result.code, result_t::OK) << parting.result.reason;
  EXPECT_GE(parting.log_odds, 0.0);
  EXPECT_EQ(parting.num_steps, 2);
  EXPECT_THAT(parting.sentence, HasSubstr("part at visit"));

  request.hypothesis_b = ids[0];
  EXPECT_EQ(answer(request, *engine_).result.code, result_t::BAD_REQUEST);
  request.hypothesis_b = 123'456;
  EXPECT_EQ(answer(request, *engine_).result.code, result_t::NOT_FOUND);
}

}  // namespace
}  // namespace cairn
