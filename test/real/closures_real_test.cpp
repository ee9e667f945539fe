// Places of recorded logs, held against reference trajectories: which visits are found to be to
// known places, and that none is to a wrong one.

#include <string>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "bench/lab/program.hpp"
#include "support/program_run.hpp"
#include "support/recorded_data.hpp"

namespace cairn::test {
namespace {

using ::testing::IsEmpty;

class RecordedClosures : public ::testing::TestWithParam<std::string> {};

TEST_P(RecordedClosures, AreMostOfTheTrueOnesAndNoFalseOne) {
  const std::string log = "carmen/" + GetParam() + "/" + GetParam();
  CAIRN_NEED_DATA(log + ".clf");
  const ProgramRun ran =
      run_program(lab::run_lab, {"closures", recorded_data(log + ".clf").string(), "--reference",
                                 recorded_data(log + ".ref.txt").string(), "--json"});
  ASSERT_EQ(ran.status, 0) << ran.err;
  const nlohmann::json report = nlohmann::json::parse(ran.out);
  EXPECT_THAT(report["merged"], IsEmpty());
  EXPECT_GT(report["found_share"], 2.0 / 3.0) << report["closures"] << " of " << report["revisits"];
}

INSTANTIATE_TEST_SUITE_P(Logs,
                         RecordedClosures,
                         ::testing::Values("intel", "fr079", "csail", "seattle", "aces"),
                         [](const auto& log) { return log.param; });

}  // namespace
}  // namespace cairn::test
