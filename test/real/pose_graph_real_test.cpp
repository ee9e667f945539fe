// Recorded pose graphs through the program, from both starts: the optima of three other solvers.

#include <string>
#include <utility>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "bench/lab/program.hpp"
#include "support/program_run.hpp"
#include "support/recorded_data.hpp"

namespace cairn::lab {
namespace {

using Json = nlohmann::json;

struct Optimum {
  const char* name;
  double chi2;
  bool has_vertices;
};

void PrintTo(const Optimum& optimum, std::ostream* out) {
  *out << optimum.name;
}

class RecordedGraph : public testing::TestWithParam<Optimum> {
 protected:
  static void expect_optimum(const std::string& start) {
    const std::string file =
        test::recorded_data("posegraph/" + std::string(GetParam().name) + ".g2o").string();
    const test::ProgramRun ran =
        test::run_program(run_lab, {"layout", file, "--init", start, "--json"});
    ASSERT_EQ(ran.status, 0) << ran.err;
    const Json json = Json::parse(ran.out);
    EXPECT_EQ(json["converged"], true);
    EXPECT_NEAR(json["chi2"], GetParam().chi2, 1e-6 * GetParam().chi2) << ran.out;
  }
};

TEST_P(RecordedGraph, ReachesItsOptimumFromTheChordalStart) {
  CAIRN_NEED_DATA("posegraph/" + std::string(GetParam().name) + ".g2o");
  expect_optimum("chordal");
}

TEST_P(RecordedGraph, ReachesItsOptimumThoughItsPosesMayLeadAstray) {
  CAIRN_NEED_DATA("posegraph/" + std::string(GetParam().name) + ".g2o");
  if (!GetParam().has_vertices) {
    GTEST_SKIP() << "no vertices in the file";
  }
  expect_optimum("file");
}

INSTANTIATE_TEST_SUITE_P(Files,
                         RecordedGraph,
                         testing::Values(Optimum{"manhattan", 3549.0368, false},
                                         Optimum{"intel", 45.004696, true},
                                         Optimum{"MIT", 41.163269, true},
                                         Optimum{"city10000", 511.98516, true},
                                         Optimum{"input_INTEL_g2o", 215.83023, true},
                                         Optimum{"input_M3500_g2o", 137.91295, true},
                                         Optimum{"ring", 11.163101, true}),
                         [](const auto& graph) { return std::string(graph.param.name); });

}  // namespace
}  // namespace cairn::lab
