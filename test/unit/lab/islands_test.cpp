#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "bench/lab/islands_experiment.hpp"
#include "bench/lab/program.hpp"
#include "support/files.hpp"
#include "support/program_run.hpp"

namespace cairn::lab {
namespace {

using test::TemporaryFolder;
using test::write_file;
using ::testing::HasSubstr;

/// A corridor 40 m long with rooms at its ends and a side corridor at its middle.
std::string corridor_and_junction() {
  std::string text = "cell_m 0.5\ntour way A B\nmap\n";
  std::vector<std::string> lines(28, std::string(96, '#'));
  const auto clear = [&](std::size_t top, std::size_t left, std::size_t rows, std::size_t columns) {
    for (std::size_t row = top; row < top + rows; ++row) {
      lines[row].replace(left, columns, columns, '.');
    }
  };
  clear(10, 8, 5, 80);
  clear(4, 1, 17, 14);
  clear(4, 81, 17, 14);
  clear(15, 46, 12, 5);
  lines[12][10] = 'A';
  lines[12][85] = 'B';
  for (const std::string& line : lines) {
    text += line + '\n';
  }
  return text;
}

TEST(Spearman, IsOneForTheSameOrderAndMinusOneForTheReverse) {
  EXPECT_DOUBLE_EQ(spearman({1.0, 2.0, 5.0}, {0.1, 0.2, 90.0}), 1.0);
  EXPECT_DOUBLE_EQ(spearman({1.0, 2.0, 5.0}, {3.0, 2.0, -7.0}), -1.0);
  EXPECT_DOUBLE_EQ(spearman({1.0, 1.0, 2.0, 2.0}, {5.0, 6.0, 5.0, 6.0}), 0.0);
  EXPECT_DOUBLE_EQ(spearman({1.0, 1.0}, {1.0, 2.0}), 0.0);
  EXPECT_DOUBLE_EQ(spearman({}, {}), 0.0);
}

TEST(Islands, WhereDistinctivenessIsHighTheRobotFindsItself) {
  const sim::World world = sim::parse_world(corridor_and_junction(), "test");
  IslandsOptions options;
  options.spacing_m = 2.0;
  options.starts = 4;
  const IslandsRun run = run_islands(world, options);
  ASSERT_GT(run.poses.size(), 30U);
  EXPECT_LT(run.rank_correlation, -0.4);
}

TEST(LabIslands, ReportsTheRankCorrelationAndDrawsIt) {
  const TemporaryFolder folder;
  const std::string world = (folder / "w.txt").string();
  const std::string png = (folder / "w.png").string();
  write_file(world, corridor_and_junction());

  const auto text =
      test::run_program(run_lab, {"islands", world, "--spacing", "4", "--starts", "1"});
  EXPECT_EQ(text.status, 0) << text.err;
  EXPECT_THAT(text.out, HasSubstr("rank correlation of distinctiveness and error"));

  const auto ran = test::run_program(
      run_lab, {"islands", world, "--spacing", "4", "--starts", "1", "--json", "--png", png});
  EXPECT_EQ(ran.status, 0) << ran.err;
  const nlohmann::json json = nlohmann::json::parse(ran.out);
  EXPECT_EQ(json["tried"].size(), json["poses"]);
  EXPECT_THAT(test::content_of(png), ::testing::StartsWith("\x89PNG"));
}

TEST(LabIslands, WrongUseIsSaid) {
  const TemporaryFolder folder;
  const std::string world = (folder / "w.txt").string();
  write_file(world, corridor_and_junction());
  EXPECT_EQ(test::run_program(run_lab, {"islands", world, "--frob"}).status, 64);
  EXPECT_EQ(test::run_program(run_lab, {"islands", world, "--spacing", "nan"}).status, 64);
  EXPECT_EQ(test::run_program(run_lab, {"islands", world, "--starts", "0"}).status, 64);
  EXPECT_EQ(test::run_program(run_lab, {"islands", world, "--png", world}).status, 64);
  EXPECT_EQ(test::run_program(run_lab, {"islands", (folder / "none").string()}).status, 65);
}

}  // namespace
}  // namespace cairn::lab
