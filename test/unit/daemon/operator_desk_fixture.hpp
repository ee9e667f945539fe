#pragma once

#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "runtime/engine.hpp"
#include "runtime/operator_desk.hpp"
#include "support/experience.hpp"
#include "support/files.hpp"

namespace cairn::test {

inline cairn_lcm::place_ref_t visit(std::int64_t number) {
  return {number, -1, ""};
}
inline cairn_lcm::place_ref_t place(std::int64_t number) {
  return {-1, number, ""};
}
inline cairn_lcm::place_ref_t named(const std::string& name) {
  return {-1, -1, name};
}

/// A map file of a square of four corners, driven round one and a half times, and what operators
/// ask of it.
class OperatorDeskTest : public ::testing::Test {
 protected:
  OperatorDeskTest() {
    Result<MapFile> map = MapFile::open(path());
    int scans = 0;
    for (int i = 0; i < kVisits; ++i) {
      const Pose2 at(10.0 * i, 0.0, 0.0);
      for (int step = 0; step < 2; ++step) {
        EXPECT_TRUE(map->append(scan_at(scans, at, Pose2(scans == 0 ? 0.0 : 5.0, 0, 0))).ok());
        ++scans;
      }
      EXPECT_TRUE(
          map->append(Visit{corner_at(at.translation()), static_cast<std::size_t>(scans - 1)})
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

  cairn_lcm::assertion_report_t say(std::int32_t kind,
                                    const cairn_lcm::place_ref_t& a,
                                    const cairn_lcm::place_ref_t& b) {
    cairn_lcm::assert_request_t request{};
    request.header.client_id = 7;
    request.header.request_id = ++requests_;
    request.kind = kind;
    request.a = a;
    request.b = b;
    request.who = "alice";
    return answer(request, time_of_utime(1'000), engine_.get());
  }
  cairn_lcm::assertion_report_t retract(std::int64_t number) {
    cairn_lcm::assert_request_t request{};
    request.header.client_id = 7;
    request.header.request_id = ++requests_;
    request.kind = cairn_lcm::assert_request_t::RETRACT;
    request.assertion = number;
    request.who = "bob";
    return answer(request, time_of_utime(2'000), engine_.get());
  }
  cairn_lcm::explanation_t why(std::int32_t kind, std::int64_t visit) {
    cairn_lcm::explain_request_t request{};
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
  TemporaryFolder folder_;
  std::unique_ptr<Engine> engine_;
  std::int32_t requests_ = 0;
};

}  // namespace cairn::test
