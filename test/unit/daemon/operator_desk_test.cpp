// Operators' orders, from the request to the map file and back.

#include <gmock/gmock.h>

#include "clients/common/map_file.hpp"
#include "operator_desk_fixture.hpp"

namespace cairn {
namespace {

using cairn_lcm::assert_request_t;
using cairn_lcm::assertion_report_t;
using cairn_lcm::explain_request_t;
using cairn_lcm::result_t;
using test::named;
using test::OperatorDeskTest;
using test::place;
using test::visit;
using ::testing::HasSubstr;

TEST_F(OperatorDeskTest, TheMapObeysAndIsRestoredWhenTheAssertionIsTakenBack) {
  open();
  const std::vector<int> before = places();
  const std::int64_t revision = engine_->service().state()->topology_revision;
  const bool is_one_place = before[0] == before[4];

  const std::int32_t contrary =
      is_one_place ? std::int32_t{assert_request_t::DIFFERENT} : assert_request_t::SAME;
  const assertion_report_t report = say(contrary, visit(0), visit(4));

  ASSERT_EQ(report.result.code, result_t::OK) << report.result.reason;
  EXPECT_EQ(report.assertion, 1);
  EXPECT_GT(report.num_moved, 0);
  EXPECT_EQ(places()[0] == places()[4], !is_one_place);
  EXPECT_GT(engine_->service().state()->topology_revision, revision);

  EXPECT_EQ(retract(1).result.code, result_t::OK);
  EXPECT_EQ(places(), before);
}

TEST_F(OperatorDeskTest, WhatWasSaidIsTakenUpAgainWithTheSameMapAndIds) {
  open();
  ASSERT_EQ(say(assert_request_t::DIFFERENT, visit(0), visit(4)).result.code, result_t::OK);
  ASSERT_EQ(say(assert_request_t::SAME, visit(0), visit(3)).result.code, result_t::OK);
  ASSERT_EQ(retract(1).result.code, result_t::OK);
  const std::vector<int> before = places();
  const std::vector<std::int64_t> ids = hypotheses();

  open();

  EXPECT_EQ(places(), before);
  EXPECT_EQ(hypotheses(), ids);
  const std::vector<AuditedAssertion> audit = engine_->service().state()->assertions;
  ASSERT_EQ(audit.size(), 2U);
  EXPECT_EQ(audit[0].said.who, "alice");
  EXPECT_EQ(audit[0].said.retracted_by, "bob");
  EXPECT_EQ(audit[0].retracted, time_of_utime(2'000));
  EXPECT_EQ(audit[1].made, time_of_utime(1'000));
  EXPECT_FALSE(audit[1].retracted);
}

TEST_F(OperatorDeskTest, ARepeatedRequestIsCarriedOutOnceEvenAfterARestart) {
  open();
  const assertion_report_t first = say(assert_request_t::DIFFERENT, visit(0), visit(4));
  for (int restart = 0; restart < 2; ++restart) {
    --requests_;
    const assertion_report_t again = say(assert_request_t::DIFFERENT, visit(0), visit(4));
    EXPECT_EQ(again.result.code, result_t::OK);
    EXPECT_EQ(again.assertion, 1);
    EXPECT_EQ(again.sentence, first.sentence);
    EXPECT_EQ(engine_->service().state()->assertions.size(), 1U);
    open();
  }
}

TEST_F(OperatorDeskTest, WhatIsInForceIsNotSaidAgain) {
  open();
  ASSERT_EQ(say(assert_request_t::DIFFERENT, visit(0), visit(4)).result.code, result_t::OK);
  const std::int64_t revision = engine_->service().revision();
  for (const auto& [a, b] : {std::pair(0, 4), std::pair(4, 0)}) {
    const assertion_report_t again = say(assert_request_t::DIFFERENT, visit(a), visit(b));
    EXPECT_EQ(again.result.code, result_t::OK);
    EXPECT_EQ(again.assertion, 1);
    EXPECT_EQ(again.num_moved, 0);
    EXPECT_THAT(again.sentence, HasSubstr("in force already, said by alice"));
  }
  EXPECT_EQ(engine_->service().revision(), revision);
  open();
  EXPECT_EQ(engine_->service().state()->assertions.size(), 1U);
  ASSERT_EQ(retract(1).result.code, result_t::OK);
  EXPECT_EQ(say(assert_request_t::DIFFERENT, visit(0), visit(4)).assertion, 2);
}

TEST_F(OperatorDeskTest, TheMapFileShowsWhatWasSaidEvenIfTheDaemonIsKilled) {
  open();
  const bool is_one_place = places()[0] == places()[4];
  say(is_one_place ? std::int32_t{assert_request_t::DIFFERENT} : assert_request_t::SAME, visit(0),
      visit(4));
  // Read beside the open engine, which is what a crash leaves.
  clients::MapFile file(path());
  EXPECT_EQ(file.topology().revision, engine_->service().revision());
  EXPECT_EQ(file.topology().num_places,
            static_cast<int>(engine_->service().state()->places.size()));
  EXPECT_EQ(file.hypotheses().revision, engine_->service().revision());
}

TEST_F(OperatorDeskTest, WhatCannotBeSaidChangesNothing) {
  open();
  ASSERT_EQ(say(assert_request_t::DIFFERENT, visit(0), visit(4)).result.code, result_t::OK);
  const std::vector<int> before = places();

  const assertion_report_t contrary = say(assert_request_t::SAME, visit(4), visit(0));
  EXPECT_EQ(contrary.result.code, result_t::BAD_REQUEST);
  EXPECT_THAT(contrary.result.reason, HasSubstr("contradicts assertion 1"));
  const assertion_report_t twice = say(assert_request_t::SAME, place(0), place(0));
  EXPECT_EQ(twice.result.code, result_t::BAD_REQUEST);
  EXPECT_THAT(twice.result.reason, HasSubstr("place 0 and place 0 are the same visit"));
  EXPECT_EQ(say(assert_request_t::SAME, place(0), place(99)).result.code, result_t::NOT_FOUND);
  EXPECT_EQ(say(assert_request_t::SAME, visit(0), visit(kVisits)).result.code, result_t::NOT_FOUND);
  EXPECT_EQ(say(assert_request_t::SAME, named("attic"), place(0)).result.code, result_t::NOT_FOUND);
  EXPECT_EQ(say(17, visit(0), visit(1)).result.code, result_t::BAD_REQUEST);
  EXPECT_EQ(retract(2).result.code, result_t::NOT_FOUND);
  const assertion_report_t far = retract(99'999'999'999);
  EXPECT_EQ(far.result.code, result_t::NOT_FOUND);
  EXPECT_EQ(far.result.reason, "there is no assertion 99999999999");

  EXPECT_EQ(places(), before);
  EXPECT_EQ(engine_->service().state()->assertions.size(), 1U);
}

TEST_F(OperatorDeskTest, NobodyCannotSayAnything) {
  open();
  assert_request_t request{};
  request.a = visit(0);
  request.b = visit(1);
  EXPECT_EQ(answer(request, time_of_utime(1), engine_.get()).result.code, result_t::BAD_REQUEST);
  request.who = "a\nb";
  EXPECT_EQ(answer(request, time_of_utime(1), engine_.get()).result.code, result_t::BAD_REQUEST);
}

TEST_F(OperatorDeskTest, PlacesMayBeNamed) {
  open();
  ASSERT_TRUE(engine_->name_place(places()[1], "kitchen").ok());
  const assertion_report_t report = say(assert_request_t::DIFFERENT, named("kitchen"), visit(6));
  EXPECT_EQ(report.result.code, result_t::OK) << report.result.reason;
  EXPECT_EQ(engine_->service().state()->assertions.front().said.a, VisitId{1});
}

TEST_F(OperatorDeskTest, AMapWithoutVisitsExplainsNothing) {
  const test::TemporaryFolder folder;
  Result<std::unique_ptr<Engine>> engine =
      Engine::open(ServiceOptions(), (folder / "new.cairn").string());
  ASSERT_TRUE(engine.ok());
  EXPECT_EQ(answer(explain_request_t{}, **engine).result.code, result_t::NOT_FOUND);
  assert_request_t request{};
  request.who = "alice";
  EXPECT_EQ(answer(request, time_of_utime(1), engine->get()).result.code, result_t::NOT_FOUND);
}

TEST_F(OperatorDeskTest, OfAVisitOfWhichNothingWasKeptTheGatewaysAreShown) {
  open();
  cairn_lcm::perception_request_t request{};
  request.visit = 5;
  const cairn_lcm::perception_t seen = answer(request, engine_.get());
  ASSERT_EQ(seen.result.code, result_t::OK) << seen.result.reason;
  EXPECT_EQ(seen.perceived.visit, 5);
  EXPECT_EQ(seen.perceived.place_id, places()[5]);
  ASSERT_EQ(seen.perceived.num_openings, 2);
  EXPECT_EQ(seen.perceived.openings[1].gateway, 1);
  EXPECT_EQ(seen.perceived.openings[1].reason, "no reason was kept");

  request.visit = kVisits;
  const cairn_lcm::perception_t none = answer(request, engine_.get());
  EXPECT_EQ(none.result.code, result_t::NOT_FOUND);
  EXPECT_THAT(none.result.reason, HasSubstr("there is no visit 7"));
}

}  // namespace
}  // namespace cairn
