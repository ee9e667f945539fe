// Operators' orders, from the request to the map file and back: a square of four corners, driven
// round one and a half times.

#include "runtime/operator_desk.hpp"

#include <gmock/gmock.h>

#include "clients/common/map_file.hpp"
#include "runtime/engine.hpp"
#include "support/experience.hpp"
#include "support/files.hpp"

namespace cairn {
namespace {

using cairn_lcm::assert_request_t;
using cairn_lcm::assertion_report_t;
using cairn_lcm::explain_request_t;
using cairn_lcm::explanation_t;
using cairn_lcm::result_t;
using ::testing::HasSubstr;
using ::testing::Not;

cairn_lcm::place_ref_t visit(std::int64_t number) {
  return {number, -1, ""};
}
cairn_lcm::place_ref_t place(std::int64_t number) {
  return {-1, number, ""};
}
cairn_lcm::place_ref_t named(const std::string& name) {
  return {-1, -1, name};
}

class OperatorDeskTest : public ::testing::Test {
 protected:
  OperatorDeskTest() {
    Result<MapFile> map = MapFile::open(path());
    int scans = 0;
    for (int i = 0; i < kVisits; ++i) {
      const Pose2 at(10.0 * i, 0.0, 0.0);
      for (int step = 0; step < 2; ++step) {
        EXPECT_TRUE(
            map->append(test::scan_at(scans, at, Pose2(scans == 0 ? 0.0 : 5.0, 0, 0))).ok());
        ++scans;
      }
      EXPECT_TRUE(
          map->append(Visit{test::corner_at(at.translation()), static_cast<std::size_t>(scans - 1)})
              .ok());
    }
    EXPECT_TRUE(map->commit().ok());
  }

  [[nodiscard]] std::string path() const { return (folder_ / "a.cairn").string(); }

  void open() {
    engine_.reset();
    ServiceOptions options;
    options.evidence = "";  // The papers' strict tree: what the views do not tell is left open.
    options.topology.noisy_stars = false;
    options.topology.log_prior_new_place = -1.0;
    Result<std::unique_ptr<Engine>> engine = Engine::open(options, path());
    ASSERT_TRUE(engine.ok()) << engine.error().message;
    engine_ = *std::move(engine);
  }

  assertion_report_t say(std::int32_t kind,
                         const cairn_lcm::place_ref_t& a,
                         const cairn_lcm::place_ref_t& b) {
    assert_request_t request{};
    request.header.client_id = 7;
    request.header.request_id = ++requests_;
    request.kind = kind;
    request.a = a;
    request.b = b;
    request.who = "alice";
    return answer(request, time_of_utime(1'000), engine_.get());
  }
  assertion_report_t retract(std::int64_t number) {
    assert_request_t request{};
    request.header.client_id = 7;
    request.header.request_id = ++requests_;
    request.kind = assert_request_t::RETRACT;
    request.assertion = number;
    request.who = "bob";
    return answer(request, time_of_utime(2'000), engine_.get());
  }
  explanation_t why(std::int32_t kind, std::int64_t visit) {
    explain_request_t request{};
    request.kind = kind;
    request.visit = visit;
    return answer(request, *engine_);
  }

  [[nodiscard]] std::vector<int> places() const {
    return engine_->service().state()->place_of_visit;
  }
  [[nodiscard]] std::vector<std::int64_t> hypotheses() const {
    const std::shared_ptr<const MapState> state = engine_->service().state();
    std::vector<std::int64_t> ids;
    for (const HypothesisSummary& one : state->hypotheses) {
      ids.push_back(one.id);
    }
    return ids;
  }

  static constexpr int kVisits = 7;
  test::TemporaryFolder folder_;
  std::unique_ptr<Engine> engine_;
  std::int32_t requests_ = 0;
};

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

}  // namespace
}  // namespace cairn
