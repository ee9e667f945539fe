// The optima of recorded pose graphs, as found by three other solvers.

#include <string>

#include <gtest/gtest.h>

#include "layout/place_layout.hpp"
#include "support/g2o_graph.hpp"
#include "support/recorded_data.hpp"

namespace cairn {
namespace {

void expect_optimum(const std::string& file, double optimum_chi2) {
  const test::G2oGraph graph = test::read_g2o(test::recorded_data(file));
  const Result<PlaceLayout> layout = solve_layout(graph.place_count, graph.travels);
  ASSERT_TRUE(layout) << layout.error().message;
  EXPECT_NEAR(layout->chi2, optimum_chi2, 1e-6 * optimum_chi2) << layout->iterations;
}

TEST(RecordedPoseGraph, ManhattanReachesItsOptimum) {
  CAIRN_NEED_DATA("posegraph/manhattan.g2o");
  expect_optimum("posegraph/manhattan.g2o", 3549.0368);
}

TEST(RecordedPoseGraph, IntelReachesItsOptimum) {
  CAIRN_NEED_DATA("posegraph/intel.g2o");
  expect_optimum("posegraph/intel.g2o", 45.004696);
}

TEST(RecordedPoseGraph, MitReachesItsOptimumThoughOdometryLeadsAstray) {
  CAIRN_NEED_DATA("posegraph/MIT.g2o");
  expect_optimum("posegraph/MIT.g2o", 41.163269);
}

TEST(RecordedPoseGraph, City10000ReachesItsOptimum) {
  CAIRN_NEED_DATA("posegraph/city10000.g2o");
  expect_optimum("posegraph/city10000.g2o", 511.98516);
}

TEST(RecordedPoseGraph, InputIntelReachesItsOptimum) {
  CAIRN_NEED_DATA("posegraph/input_INTEL_g2o.g2o");
  expect_optimum("posegraph/input_INTEL_g2o.g2o", 215.83023);
}

TEST(RecordedPoseGraph, InputM3500ReachesItsOptimum) {
  CAIRN_NEED_DATA("posegraph/input_M3500_g2o.g2o");
  expect_optimum("posegraph/input_M3500_g2o.g2o", 137.91295);
}

TEST(RecordedPoseGraph, RingReachesItsOptimum) {
  CAIRN_NEED_DATA("posegraph/ring.g2o");
  expect_optimum("posegraph/ring.g2o", 11.163101);
}

}  // namespace
}  // namespace cairn
