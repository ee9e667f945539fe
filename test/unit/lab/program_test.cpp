#include "bench/lab/program.hpp"

#include <filesystem>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "support/files.hpp"
#include "support/program_run.hpp"

namespace cairn::lab {
namespace {

using Json = nlohmann::json;
using test::TemporaryFolder;
using testing::HasSubstr;

using Ran = test::ProgramRun;

Ran run(const std::vector<std::string>& arguments) {
  return test::run_program(run_lab, arguments);
}

TEST(LabTopology, CountsTheGridsOfFigure4) {
  const Ran ran = run({"topology", "--grid", "3x3", "--planar", "--json"});
  ASSERT_EQ(ran.status, 0) << ran.err;
  const Json json = Json::parse(ran.out);
  EXPECT_EQ(json["tree_nodes"], 240);
  EXPECT_EQ(json["maps_built"], 147);
  EXPECT_EQ(json["final_maps"], 62);
  EXPECT_EQ(json["closed_paper"], 3);
  EXPECT_EQ(json["optimal"]["count"], 1);
  EXPECT_EQ(json["leaves_per_step"].size(), 16U);
  EXPECT_EQ(json["is_complete"], true);
}

TEST(LabTopology, FollowsTheWalkItIsGiven) {
  const Ran ran = run({"topology", "--grid", "3x4", "--walk", "ESSENNESSWWWNEEENWWWS", "--json"});
  ASSERT_EQ(ran.status, 0) << ran.err;
  EXPECT_EQ(Json::parse(ran.out)["tree_nodes"], 4239);
}

TEST(LabTopology, BestFirstSearchFindsTheTrueMap) {
  const Ran ran = run({"topology", "--grid", "5x5", "--planar", "--perpendicular", "--search",
                       "best", "--order", "corners", "--json"});
  ASSERT_EQ(ran.status, 0) << ran.err;
  const Json json = Json::parse(ran.out);
  EXPECT_EQ(json["best"]["places"], 25);
  EXPECT_EQ(json["best"]["paths"], 10);
}

TEST(LabTopology, BestFirstSearchFindsAnOptimalMap) {
  const std::vector<std::string> grid = {"topology", "--grid",       "4x4", "--planar",
                                         "--json",   "--max-places", "16"};
  const Json all = Json::parse(run(grid).out);
  EXPECT_EQ(all["minimised"],
            "paths, then places, of region-consistent maps without pending gateways");
  for (const std::string order : {"paths", "places"}) {
    SCOPED_TRACE(order);
    std::vector<std::string> best_first = grid;
    best_first.insert(best_first.end(), {"--search", "best", "--order", order});
    const Json found = Json::parse(run(best_first).out);
    EXPECT_EQ(found["best"]["paths"], all["optimal"]["paths"]);
    EXPECT_EQ(found["best"]["places"], all["optimal"]["places"]);
    EXPECT_THAT(all["optimal"]["codes"], testing::Contains(found["best"]["code"]));
    EXPECT_EQ(found["minimised"] == all["minimised"], order == "paths");
  }
}

TEST(LabTopology, SaysWhenItGivesUp) {
  const Ran ran = run({"topology", "--grid", "4x4", "--max-nodes", "1000"});
  ASSERT_EQ(ran.status, 0) << ran.err;
  EXPECT_THAT(ran.out, HasSubstr("given up after 1,000 nodes"));
}

TEST(LabTopology, ABoundOnNodesIsReachedOnlyIfMoreAreNeeded) {
  for (const std::string search : {"depth", "breadth"}) {
    SCOPED_TRACE(search);
    const auto bounded = [&](const std::string& nodes) {
      return Json::parse(run({"topology", "--grid", "3x3", "--planar", "--search", search,
                              "--max-nodes", nodes, "--json"})
                             .out);
    };
    EXPECT_EQ(bounded("240")["is_complete"], true);
    EXPECT_EQ(bounded("240")["final_maps"], 62);
    EXPECT_EQ(bounded("239")["is_complete"], false);
    EXPECT_LE(bounded("239")["tree_nodes"], 239);
  }
}

TEST(LabTopology, SaysInWhichTravelBreadthFirstSearchGivesUp) {
  const Ran ran = run({"topology", "--grid", "3x3", "--planar", "--search", "breadth",
                       "--max-nodes", "239", "--json"});
  EXPECT_EQ(Json::parse(ran.out)["leaves_per_step"].size(), 15U);
  EXPECT_THAT(
      run({"topology", "--grid", "3x3", "--planar", "--search", "breadth", "--max-nodes", "239"})
          .out,
      HasSubstr("given up in travel 16 of 16, which makes more than 239 nodes"));
}

TEST(LabTopology, SaysWhatAHypothesisCosts) {
  const auto cost = [](const std::string& search) {
    return Json::parse(
        run({"topology", "--grid", "3x3", "--planar", "--search", search, "--json"}).out);
  };
  EXPECT_TRUE(cost("depth")["bytes_per_hypothesis"].is_null());
  EXPECT_TRUE(cost("depth")["counting_cpu_ms"].is_null());
  for (const std::string search : {"breadth", "best"}) {
    SCOPED_TRACE(search);
    const Json json = cost(search);
    EXPECT_GT(json["bytes_per_stored_node"], 0.0);
    EXPECT_GT(json["bytes_per_leaf"], 0.0);
    EXPECT_GT(json["bytes_per_hypothesis"], json["bytes_per_leaf"]);
  }
  EXPECT_GE(cost("breadth")["counting_cpu_ms"], 0.0);
  EXPECT_THAT(run({"topology", "--grid", "3x3", "--search", "breadth"}).out,
              HasSubstr(" ms to count final maps and regions"));
  EXPECT_THAT(run({"topology", "--grid", "3x3"}).out, HasSubstr("counting included"));
}

TEST(LabTopology, WritesItsDrawings) {
  const TemporaryFolder folder;
  std::vector<std::string> arguments = {"topology", "--grid", "3x3", "--planar"};
  for (const char* kind : {"svg", "dot", "graphml", "tree-dot"}) {
    arguments.push_back(std::string("--") + kind);
    arguments.push_back((folder / kind).string());
  }
  const Ran ran = run(arguments);
  ASSERT_EQ(ran.status, 0) << ran.err;
  EXPECT_THAT(test::content_of(folder / "svg"), HasSubstr("the simplest closed map"));
  EXPECT_THAT(test::content_of(folder / "dot"), HasSubstr("graph map"));
  EXPECT_THAT(test::content_of(folder / "graphml"), HasSubstr("<graphml"));
  EXPECT_THAT(test::content_of(folder / "tree-dot"), HasSubstr("digraph tree"));
}

TEST(LabTopology, DrawsAMapOfAWalkThatIsNotFinished) {
  const TemporaryFolder folder;
  const std::string path = (folder / "map.svg").string();
  const Ran ran = run({"topology", "--grid", "3x3", "--walk", "EESWWN", "--svg", path});
  ASSERT_EQ(ran.status, 0) << ran.err;
  EXPECT_THAT(test::content_of(path), HasSubstr("a simplest perpendicular map; none is closed"));
  EXPECT_EQ(
      run({"topology", "--grid", "3x3", "--walk", "E", "--search", "best", "--svg", path}).status,
      65);
}

TEST(LabTopology, DrawsNoTreeThatNobodyCanRead) {
  const TemporaryFolder folder;
  const std::string path = (folder / "tree.dot").string();
  const Ran ran = run({"topology", "--grid", "4x4", "--tree-dot", path});
  EXPECT_EQ(ran.status, 65);
  EXPECT_THAT(ran.err, HasSubstr("more than 2,000 nodes"));
  EXPECT_FALSE(std::filesystem::exists(path));
}

TEST(LabTopology, ExploresRandomWorlds) {
  const Ran ran = run({"topology", "--random", "1", "--count", "20", "--json"});
  EXPECT_EQ(ran.status, 0) << ran.out << ran.err;
  const Json json = Json::parse(ran.out);
  EXPECT_EQ(json["planar"]["true_map_among_leaves"], 20);
  EXPECT_EQ(json["nonplanar"]["obvious_implementation_agrees"], 20);
}

TEST(LabTopology, RejectsWrongCommandLines) {
  const std::vector<std::vector<std::string>> wrong = {
      {},
      {"metric"},
      {"topology"},
      {"topology", "--grid", "3by3"},
      {"topology", "--grid", "0x3"},
      {"topology", "--grid", "1x1"},
      {"topology", "--grid", "3x3x3"},
      {"topology", "--grid", "3x3", "--walk", "EEE"},
      {"topology", "--grid", "3x3", "--walk", "EQ"},
      {"topology", "--grid", "3x3", "--start", "3,0"},
      {"topology", "--grid", "3x3", "--search", "widest"},
      {"topology", "--grid", "3x3", "--order", "paths"},
      {"topology", "--grid", "3x3", "--search", "best", "--order", "shortest"},
      {"topology", "--grid", "3x3", "--search", "1"},
      {"topology", "--grid", "3x3", "--search", "best", "--order", "corners"},
      {"topology", "--grid", "3x3", "--max-places", "0"},
      {"topology", "--grid", "3x3", "--max-corners", "4"},
      {"topology", "--grid", "3x3", "--random", "1"},
      {"topology", "--walk", "E", "--random", "1"},
      {"topology", "--random", "1", "--perpendicular"},
      {"topology", "--random", "1", "--count", "0"},
      {"topology", "--count", "3", "--grid", "3x3"},
  };
  for (const std::vector<std::string>& arguments : wrong) {
    const Ran ran = run(arguments);
    std::string line;
    for (const std::string& argument : arguments) {
      line += " " + argument;
    }
    EXPECT_EQ(ran.status, 64) << "cairn-lab" << line;
    EXPECT_NE(ran.err, "") << "cairn-lab" << line;
  }
}

TEST(LabTopology, NamesWhatIsWrongInACommandLine) {
  const std::vector<std::pair<std::vector<std::string>, std::string>> wrong = {
      {{"--random", "-1"}, "--random: expected a seed from 0 to 18446744073709551615, got '-1'"},
      {{"--random", "18446744073709551616"}, "expected a seed from 0 to 18446744073709551615"},
      {{"--random", "18446744073709551615", "--count", "2"}, "would not fit into 64 bits"},
      {{"--vectors", ""}, "--vectors: expected the name of a file"},
      {{"--grid", "2x2", "--svg", ""}, "--svg: expected the name of a file"},
      {{"--grid", "2x2", "--svg", "a.x", "--dot", "./a.x"}, "./a.x is the file of --svg, too"},
      {{"--grid", "2x2", "--max-corners", "4"}, "--max-corners needs --planar and --perpendicular"},
      {{"--grid", "1x3", "--compass"}, "--compass must come with stars of four slots only"},
      {{"--grid", "2x2", "--tree-dot", "t", "--search", "best"}, "--search best grows a part only"},
      {{"--grid", "2x2", "--tree-dot", "t", "--max-nodes", "9"}, "--max-nodes leaves out a part"},
  };
  for (const auto& [options, message] : wrong) {
    std::vector<std::string> arguments = {"topology"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const Ran ran = run(arguments);
    EXPECT_EQ(ran.status, 64) << message;
    EXPECT_THAT(ran.err, HasSubstr(message));
  }
}

TEST(LabTopology, CannotWriteWhereNobodyCan) {
  const Ran ran = run({"topology", "--grid", "2x2", "--svg", "/no/such/folder/map.svg"});
  EXPECT_EQ(ran.status, 73);
}

TEST(LabProgram, RefusesEmptyNamesOfWhateverItWrites) {
  const std::vector<std::vector<std::string>> lines = {{"localmap", "any.clf", "--png", ""},
                                                       {"localmap", "any.clf", "--png="},
                                                       {"localmap", "any.clf", "--trajectory", ""},
                                                       {"places", "any.clf", "--png", ""},
                                                       {"islands", "any.png", "--png", ""},
                                                       {"layout", "any.g2o", "--out", ""},
                                                       {"rooms", "", "--png", "a.png"}};
  for (const std::vector<std::string>& line : lines) {
    const Ran ran = run(line);
    EXPECT_EQ(ran.status, 64) << line[0];
    EXPECT_THAT(ran.err, HasSubstr("expected the name of a file")) << line[0];
  }
}

}  // namespace
}  // namespace cairn::lab
