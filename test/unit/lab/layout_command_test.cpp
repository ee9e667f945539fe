#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "bench/lab/pose_graph.hpp"
#include "bench/lab/program.hpp"
#include "support/files.hpp"
#include "support/program_run.hpp"

namespace cairn::lab {
namespace {

using Json = nlohmann::json;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

class LabLayout : public testing::Test {
 protected:
  static test::ProgramRun run(const std::vector<std::string>& arguments) {
    return test::run_program(run_lab, arguments);
  }

  /// The file of a graph.
  std::string file_of(const std::string& content) {
    const std::string file = (folder_ / "graph.g2o").string();
    test::write_file(file, content);
    return file;
  }

  test::TemporaryFolder folder_;
};

constexpr char kSure[] = " 100 0 0 100 0 1000\n";

/// A square that does not quite close, far from where it was driven: vertices as badly off as
/// wanted.
std::string square(double wrong_m, bool has_vertices) {
  std::string text;
  for (int i = 0; has_vertices && i < 4; ++i) {
    text +=
        "VERTEX_SE2 " + std::to_string(10 * i) + ' ' + std::to_string(3 + i * wrong_m) + " 4 0.5\n";
  }
  for (int i = 0; i < 4; ++i) {
    text += "EDGE_SE2 " + std::to_string(10 * i) + ' ' + std::to_string(10 * ((i + 1) % 4)) +
            (i < 3 ? " 1.1 0 1.6" : " 4 1 1.2") + kSure;
  }
  return text;
}

TEST_F(LabLayout, TellsChi2IterationsAndTime) {
  const test::ProgramRun ran = run({"layout", file_of(square(0.0, false)), "--json"});
  ASSERT_EQ(ran.status, 0) << ran.err;
  const Json json = Json::parse(ran.out);
  EXPECT_EQ(json["vertices"], 4);
  EXPECT_EQ(json["edges"], 4);
  EXPECT_EQ(json["converged"], true);
  EXPECT_EQ(json["start"], "chordal");
  EXPECT_GT(json["chi2"], 0.0);
  EXPECT_GE(json["initial_chi2"], json["chi2"]);
  EXPECT_GE(json["iterations"], 1);
  EXPECT_GE(json["time_ms"], 0.0);
  EXPECT_GE(json["read_ms"], 0.0);
}

TEST_F(LabLayout, PrintsAReportForPeople) {
  const test::ProgramRun ran = run({"layout", file_of(square(1.0, true)), "--init", "file"});
  ASSERT_EQ(ran.status, 0) << ran.err;
  EXPECT_THAT(ran.out, HasSubstr("4 vertices, 4 edges\n"));
  EXPECT_THAT(ran.out, HasSubstr("from the file's poses: chi2 "));
  EXPECT_THAT(ran.out, HasSubstr("from the chordal start: chi2 "));
  EXPECT_THAT(ran.out, HasSubstr("converged; "));
  EXPECT_THAT(ran.out, HasSubstr("ms of CPU time"));
  EXPECT_EQ(ran.err, "");
}

TEST_F(LabLayout, BeginsAtThePosesOfTheFileIfAsked) {
  const std::string file = file_of(square(1000.0, true));
  const Json chordal = Json::parse(run({"layout", file, "--json"}).out);
  const Json from_file = Json::parse(run({"layout", file, "--init", "file", "--json"}).out);
  EXPECT_GT(from_file["initial_chi2"], 1e6);
  EXPECT_NEAR(from_file["chi2"], chordal["chi2"], 1e-6 * chordal["chi2"].get<double>());
  EXPECT_EQ(from_file["starts"].size(), 2U);
}

TEST_F(LabLayout, WritesAllVerticesUnderTheirIdsWithTheFixedOneInItsPlace) {
  const std::string out = (folder_ / "out.g2o").string();
  const test::ProgramRun ran =
      run({"layout", file_of(square(1.0, true) + "FIX 20\n"), "--out", out, "--json"});
  ASSERT_EQ(ran.status, 0) << ran.err;
  const Result<PoseGraph> graph = parse_pose_graph(test::content_of(out));
  ASSERT_TRUE(graph) << graph.error().message;
  EXPECT_THAT(graph->ids, ElementsAre(0, 10, 20, 30));
  EXPECT_NEAR(graph->T_frame_vertex[2].x(), 5.0, 1e-12);
  EXPECT_NEAR(graph->T_frame_vertex[2].theta(), 0.5, 1e-12);
  const double chi2 = Json::parse(ran.out)["chi2"];
  EXPECT_NEAR(chi2_of(*graph, graph->T_frame_vertex), chi2, 1e-9 * chi2);
}

TEST_F(LabLayout, PosesOfAFileWithoutVerticesCannotBeBegunWith) {
  const test::ProgramRun ran = run({"layout", file_of(square(0.0, false)), "--init", "file"});
  EXPECT_EQ(ran.status, 65);
  EXPECT_THAT(ran.err, HasSubstr("--init file: expected vertices with poses"));
  EXPECT_EQ(ran.out, "");
}

TEST_F(LabLayout, WhatDoesNotConvergeIsNoLayout) {
  const std::string out = (folder_ / "out.g2o").string();
  const std::string file = file_of(square(0.0, false));
  const test::ProgramRun ran =
      run({"layout", file, "--max-iterations", "1", "--json", "--out", out});
  EXPECT_EQ(ran.status, 1);
  EXPECT_EQ(Json::parse(ran.out)["converged"], false);
  EXPECT_THAT(ran.err, HasSubstr("not written"));
  EXPECT_FALSE(std::filesystem::exists(out));
  const test::ProgramRun told = run({"layout", file, "--max-iterations", "1"});
  EXPECT_THAT(told.out, HasSubstr("NOT CONVERGED"));
  EXPECT_THAT(told.out, Not(HasSubstr(", converged;")));
}

TEST_F(LabLayout, NamesTheFileAndTheLineOfBadData) {
  const std::string file = file_of(square(0.0, false) + "EDGE_SE2 0 10 1 0 nan 1 0 0 1 0 1\n");
  const test::ProgramRun ran = run({"layout", file});
  EXPECT_EQ(ran.status, 65);
  EXPECT_EQ(ran.err,
            "cairn-lab: " + file + ": line 5: expected a finite number for theta, got nan\n");
}

TEST_F(LabLayout, RefusesWhatIsNoFile) {
  EXPECT_EQ(run({"layout", "/no/such/file"}).status, 65);
  const test::ProgramRun folder = run({"layout", (folder_ / "").string()});
  EXPECT_EQ(folder.status, 65);
  EXPECT_THAT(folder.err, HasSubstr("expected a file, got a folder"));
}

TEST_F(LabLayout, RefusesAWrongCommandLine) {
  const std::string file = file_of(square(0.0, false));
  EXPECT_EQ(run({"layout"}).status, 64);
  EXPECT_EQ(run({"layout", file, "--init", "odometry"}).status, 64);
  EXPECT_EQ(run({"layout", file, "--out", file}).status, 64);
  EXPECT_EQ(run({"layout", file, "--max-iterations", "0"}).status, 64);
  EXPECT_EQ(run({"layout", file, "--out", "/no/such/folder/out.g2o"}).status, 73);
}

}  // namespace
}  // namespace cairn::lab
