// Files of vectors: what is counted, compared and refused.

#include <fstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "bench/lab/program.hpp"
#include "support/files.hpp"
#include "support/program_run.hpp"
#include "support/recorded_data.hpp"

namespace cairn::lab {
namespace {

using Json = nlohmann::json;
using test::recorded_data;
using test::TemporaryFolder;
using testing::HasSubstr;
using Ran = test::ProgramRun;

Ran run(const std::vector<std::string>& arguments) {
  return test::run_program(run_lab, arguments);
}

/// A file of one exploration: a square loop of corners.
Json square_loop() {
  const Json counts = {{"tree_nodes", 11},
                       {"maps_built", 8},
                       {"view_mismatches", 0},
                       {"final_maps", 4},
                       {"closed_paper", 3},
                       {"closed_no_pending", 3},
                       {"region_consistent_finals", 3},
                       {"perpendicular_closed_paper", 1},
                       {"optimal", {{"count", 1}, {"paths", 3}, {"places", 3}}},
                       {"leaves_per_step", {1, 2, 3, 4}}};
  Json file;
  file["stars"]["L"] = {{"slots", {0, 1, -1, -1}}, {"partner_slot", {2, 3, 0, 1}}};
  Json& vector = file["vectors"][0];
  vector["name"] = "square";
  vector["start"] = {{"star", "L"}, {"gate", 0}};
  vector["max_places"] = nullptr;
  for (int step = 0; step < 4; ++step) {
    vector["steps"].push_back(Json::array({step == 0 ? 0 : 1, "L", 1}));
  }
  vector["nonplanar"] = counts;
  vector["planar"] = counts;
  return file;
}

Ran run_on(const Json& file, const std::vector<std::string>& options = {}) {
  const TemporaryFolder folder;
  const std::string path = (folder / "vectors.json").string();
  std::ofstream(path) << file.dump();
  std::vector<std::string> arguments = {"topology", "--vectors", path};
  arguments.insert(arguments.end(), options.begin(), options.end());
  return run(arguments);
}

TEST(LabVectors, ComparesWithAFileOfVectors) {
  const Ran ran = run_on(square_loop());
  EXPECT_EQ(ran.status, 0) << ran.out << ran.err;
  EXPECT_THAT(ran.out, HasSubstr("2 of 2 agree"));
}

TEST(LabVectors, SaysWhatItCompared) {
  Json file = square_loop();
  file["vectors"][0]["planar"]["final_genus"] = 0;
  const Ran all = run_on(file);
  EXPECT_THAT(all.out, HasSubstr("final_maps, leaves_per_step, maps_built"));
  EXPECT_THAT(all.out, HasSubstr("in the file, but not compared (not counted here): final_genus"));
  const Ran under_axiom = run_on(file, {"--region-axiom", "--json"});
  EXPECT_EQ(under_axiom.status, 0) << under_axiom.out << under_axiom.err;
  const Json json = Json::parse(under_axiom.out);
  EXPECT_THAT(json["fields_compared"], testing::Contains("final_maps"));
  EXPECT_THAT(json["fields_not_compared"], testing::Contains("tree_nodes"));
  EXPECT_THAT(json["fields_not_compared"], testing::Contains("closed_paper"));
}

TEST(LabVectors, SaysWhichCountDiffers) {
  Json file = square_loop();
  file["vectors"][0]["planar"]["leaves_per_step"][2] = 7;
  const Ran ran = run_on(file);
  EXPECT_EQ(ran.status, 1);
  EXPECT_THAT(ran.out, HasSubstr("square, planar: leaves_per_step[2]: expected 7, got 3"));
  EXPECT_THAT(ran.out, HasSubstr("1 of 2 agree"));
}

TEST(LabVectors, AgreesWithThePublishedVectors) {
  CAIRN_NEED_DATA("topology/vectors.json");
  for (const char* name : {"topology/vectors.json", "topology/office.json"}) {
    const Ran ran = run({"topology", "--json", "--vectors", recorded_data(name).string()});
    EXPECT_EQ(ran.status, 0) << ran.err;
    const Json json = Json::parse(ran.out);
    const Json file = Json::parse(std::ifstream(recorded_data(name)));
    ASSERT_EQ(json["vectors"].size(), file["vectors"].size());
    for (std::size_t i = 0; i < json["vectors"].size(); ++i) {
      EXPECT_EQ(json["vectors"][i]["nonplanar"]["tree_nodes"],
                file["vectors"][i]["nonplanar"]["tree_nodes"]);
    }
  }
}

struct BadFile {
  const char* name;
  void (*spoil)(Json& file);
  const char* message;
};

void PrintTo(const BadFile& bad, std::ostream* out) {
  *out << bad.name;
}

class LabBadVectors : public testing::TestWithParam<BadFile> {};

TEST_P(LabBadVectors, AreNamed) {
  Json file = square_loop();
  GetParam().spoil(file);
  const Ran ran = run_on(file);
  EXPECT_EQ(ran.status, 65);
  EXPECT_THAT(ran.err, HasSubstr(GetParam().message));
}

INSTANTIATE_TEST_SUITE_P(
    Files,
    LabBadVectors,
    testing::Values(
        BadFile{"UnknownStar", [](Json& file) { file["vectors"][0]["steps"][2][1] = "Q"; },
                "vector square, steps, step 2, star: expected the name of a star of this file (L), "
                "got \"Q\""},
        BadFile{"TurnTooFar", [](Json& file) { file["vectors"][0]["steps"][1][0] = 2; },
                "vector square, steps, step 1, turn: expected an integer from 0 to 1, got 2"},
        BadFile{"ViewIsText", [](Json& file) { file["vectors"][0]["steps"][3][2] = "one"; },
                "step 3, view: expected an integer from 0 to 1, got \"one\""},
        BadFile{"StepIsShort", [](Json& file) { file["vectors"][0]["steps"][0] = {1}; },
                "step 0: expected [turn, star, view], got [1]"},
        BadFile{"NoStart", [](Json& file) { file["vectors"][0].erase("start"); },
                "vector square: expected a field \"start\", got none"},
        BadFile{"NoStars", [](Json& file) { file.erase("stars"); },
                "the file: expected a field \"stars\", got none"},
        BadFile{"NotAStar", [](Json& file) { file["stars"]["L"]["partner_slot"][0] = 0; },
                "stars, L: expected a star that can be"},
        BadFile{"HugeCount",
                [](Json& file) { file["vectors"][0]["planar"]["final_maps"] = ~std::uint64_t{0}; },
                "final_maps: expected an integer from 0 to 2147483647"},
        BadFile{"BoundOfNothing", [](Json& file) { file["vectors"][0]["max_places"] = 0; },
                "vector square, max_places: expected an integer from 1"},
        BadFile{"ShortSeries",
                [](Json& file) {
                  file["vectors"][0]["planar"]["leaves_per_step"] = {1, 2};
                },
                "planar, leaves_per_step: expected a count for each of the 4 steps, got [1,2]"},
        BadFile{"NoVectors", [](Json& file) { file["vectors"] = Json::array(); },
                "vectors: expected one exploration or more, got []"},
        BadFile{"SameName", [](Json& file) { file["vectors"][1] = file["vectors"][0]; },
                "vectors, number 1, name: expected a name of its own (another one has this), got "
                "\"square\""},
        BadFile{"AnArray", [](Json& file) { file = Json::array(); },
                "the file: expected an object, got []"}),
    [](const auto& param) { return std::string(param.param.name); });

TEST(LabVectors, RejectsWhatIsNoJson) {
  const TemporaryFolder folder;
  const std::string path = (folder / "vectors.json").string();
  std::ofstream(path) << "{\"stars\": ";
  const Ran ran = run({"topology", "--vectors", path});
  EXPECT_EQ(ran.status, 65);
  EXPECT_THAT(ran.err, HasSubstr("not JSON"));
  EXPECT_EQ(run({"topology", "--vectors", path + ".gone"}).status, 65);
  const Ran on_folder = run({"topology", "--vectors", (folder / "").string()});
  EXPECT_EQ(on_folder.status, 65);
  EXPECT_THAT(on_folder.err, HasSubstr("expected a file, got a folder"));
}

}  // namespace
}  // namespace cairn::lab
