#include <cmath>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "bench/lab/localmap_run.hpp"
#include "bench/lab/program.hpp"
#include "support/files.hpp"

namespace cairn::lab {
namespace {

using Json = nlohmann::json;
using test::TemporaryFolder;
using test::write_file;
using testing::HasSubstr;

struct Ran {
  int status = -1;
  std::string output;
  std::string errors;
};

Ran run(const std::vector<std::string>& arguments) {
  std::ostringstream out;
  std::ostringstream err;
  const int status = run_lab(arguments, out, err);
  return {status, out.str(), err.str()};
}

/// A robot that goes 2 m towards a wall, within four walls, one scan a second.
std::string carmen_log() {
  std::ostringstream log;
  for (int i = 0; i <= 10; ++i) {
    const double x_m = 0.2 * i;
    log << "FLASER 180";
    for (int beam = 0; beam < 180; ++beam) {
      const double bearing_rad = (beam - 90) * M_PI / 180.0;
      const double ahead_m = (6.0 - x_m) / std::max(std::cos(bearing_rad), 1e-9);
      const double aside_m = (bearing_rad > 0.0 ? 3.0 : 4.0) / std::abs(std::sin(bearing_rad));
      log << ' ' << std::min({ahead_m, aside_m, 50.0});
    }
    const std::string pose = " " + std::to_string(x_m) + " 0 0";
    log << pose << pose << ' ' << 100 + i << " robot " << i << '\n';
  }
  return log.str();
}

TEST(LabLocalmap, RelationsMostOfWhichHaveNoPoseAreOfAnotherLog) {
  const TemporaryFolder folder;
  const std::string log = (folder / "a.clf").string();
  const std::string relations = (folder / "b.relations").string();
  write_file(log, carmen_log());
  write_file(relations, "100 110 2 0 0 0 0 0\n502 506 0.8 0 0 0 0 0\n500 501 0 0 0 0 0 0\n");
  const Ran ran = run({"localmap", log, "--relations", relations});
  EXPECT_EQ(ran.status, 65);
  EXPECT_THAT(ran.errors, HasSubstr("1 of 3 have"));
}

TEST(LabLocalmap, TracksALogAndJudgesItByRelations) {
  const TemporaryFolder folder;
  const std::string log = (folder / "a.clf").string();
  const std::string relations = (folder / "a.relations").string();
  const std::string trajectory = (folder / "a.txt").string();
  const std::string png = (folder / "a.png").string();
  write_file(log, carmen_log());
  write_file(relations,
             "# true\n100 110 2 0 0 0 0 0\n102 106 0.8 0 0 0 0 0\n500 501 0 0 0 0 0 0\n");
  const Ran ran = run({"localmap", log, "--relations", relations, "--json", "--trajectory",
                       trajectory, "--png", png});
  ASSERT_EQ(ran.status, 0) << ran.errors;
  const Json json = Json::parse(ran.output);
  EXPECT_EQ(json["scans"], 11);
  EXPECT_EQ(json["refused"], 0);
  EXPECT_NEAR(json["travel_m"].get<double>(), 2.0, 0.1);
  EXPECT_EQ(json["relations"]["missing"], 1);
  EXPECT_EQ(json["relations"]["all"]["relations"], 2);
  EXPECT_LT(json["relations"]["near"]["translation_m"]["max"].get<double>(), 0.05);
  EXPECT_EQ(json["relations"]["near_and_sure"]["relations"], 2);
  EXPECT_THAT(test::content_of(trajectory), HasSubstr("\n110.000000 "));
  EXPECT_THAT(test::content_of(png), HasSubstr("PNG"));
}

TEST(LabLocalmap, CountsTheMessagesItRefused) {
  const TemporaryFolder folder;
  const std::string log = (folder / "a.clf").string();
  std::string text = carmen_log();
  const std::size_t line = text.find("FLASER", text.find("FLASER") + 1);
  const std::size_t end = text.find('\n', line);
  std::string blind = "FLASER 180";
  for (int beam = 0; beam < 180; ++beam) {
    blind += " 0.0";
  }
  text.replace(line, end - line, blind + " 0.2 0 0 0.2 0 0 101 robot 1");
  write_file(log, text);
  const Ran ran = run({"localmap", log, "--json"});
  ASSERT_EQ(ran.status, 0) << ran.errors;
  const Json inputs = Json::parse(ran.output)["inputs"];
  EXPECT_EQ(inputs["refused_messages"], 1);
  EXPECT_THAT(inputs["last_refusal"].get<std::string>(), HasSubstr("no range says anything"));
  EXPECT_THAT(run({"localmap", log}).output, HasSubstr("messages refused by their content: 1"));
}

TEST(LabLocalmap, DrawsEveryVisitIntoAFolder) {
  const TemporaryFolder folder;
  const std::string log = (folder / "a.clf").string();
  write_file(log, carmen_log());
  const Ran ran = run({"localmap", log, "--places", (folder / "places").string()});
  EXPECT_EQ(ran.status, 0) << ran.errors;
  EXPECT_TRUE(std::filesystem::is_directory(folder / "places"));
  EXPECT_EQ(run({"localmap", log, "--places", log}).status, 64) << "it is read";
  write_file((folder / "taken").string(), "a file");
  EXPECT_EQ(run({"localmap", log, "--places", (folder / "taken").string()}).status, 73);
}

TEST(LabPlaces, PrintsVisitsAndDrawsThemOnASheet) {
  const TemporaryFolder folder;
  const std::string log = (folder / "a.clf").string();
  const std::string png = (folder / "a.png").string();
  write_file(log, carmen_log());
  const Ran ran = run({"places", log, "--json", "--png", png});
  ASSERT_EQ(ran.status, 0) << ran.errors;
  const Json json = Json::parse(ran.output);
  EXPECT_EQ(json["scans"], 11);
  ASSERT_FALSE(json["poses"].empty());
  for (const Json& pose : json["poses"]) {
    EXPECT_GE(pose["distinctiveness"].get<double>(), 0.0);
    EXPECT_LE(pose["distinctiveness"].get<double>(), 1.0);
  }
  EXPECT_THAT(test::content_of(png), HasSubstr("PNG"));
  EXPECT_EQ(run({"places", log, "--frob"}).status, 64);
}

TrackedPose tracked(double time_s, const Pose2& pose, bool is_of_scan) {
  return {time_s, pose, pose.x(), is_of_scan, 1};
}

TEST(LabLocalmap, TakesTheMeanWhereABurstBearsOneStamp) {
  const std::vector<TrackedPose> poses = one_pose_per_stamp(
      {tracked(2.0, Pose2(9.0, 0.0, 0.0), true), tracked(1.0, Pose2(1.0, 0.0, 3.1), false),
       tracked(1.0, Pose2(3.0, 1.0, -3.1), false)});
  ASSERT_EQ(poses.size(), 2U);
  EXPECT_EQ(poses[0].sharing, 2);
  EXPECT_NEAR(poses[0].T_lpm_robot.x(), 2.0, 1e-12);
  EXPECT_NEAR(poses[0].T_lpm_robot.y(), 0.5, 1e-12);
  EXPECT_NEAR(std::abs(poses[0].T_lpm_robot.theta()), M_PI, 1e-9);
  EXPECT_NEAR(poses[0].travel_m, 2.0, 1e-12);
  EXPECT_EQ(poses[1].sharing, 1);
  EXPECT_EQ(poses[1].T_lpm_robot, Pose2(9.0, 0.0, 0.0));
}

TEST(LabLocalmap, TrustsThePosesOfScansMoreThanThoseBetween) {
  const std::vector<TrackedPose> poses = one_pose_per_stamp(
      {tracked(1.0, Pose2(0.0, 0.0, 0.0), false), tracked(1.0, Pose2(1.0, 0.0, 0.0), true),
       tracked(1.0, Pose2(2.0, 0.0, 0.2), true)});
  ASSERT_EQ(poses.size(), 1U);
  EXPECT_EQ(poses[0].sharing, 3);
  EXPECT_NEAR(poses[0].T_lpm_robot.x(), 1.5, 1e-12);
  EXPECT_NEAR(poses[0].T_lpm_robot.theta(), 0.1, 1e-12);
}

TEST(LabLocalmap, LeavesPartsOutByName) {
  const TemporaryFolder folder;
  const std::string log = (folder / "a.clf").string();
  write_file(log, carmen_log());
  for (const char* part : {"wall-orientation", "motion-learning", "motion-compensation",
                           "degeneracy-handling", "wall-orientation,motion-learning"}) {
    const Ran ran = run({"localmap", log, "--without", part, "--json"});
    ASSERT_EQ(ran.status, 0) << ran.errors;
    EXPECT_NEAR(Json::parse(ran.output)["travel_m"].get<double>(), 2.0, 0.1) << part;
  }
  const Ran ran = run({"localmap", log, "--without", "luck"});
  EXPECT_EQ(ran.status, 64);
  EXPECT_THAT(ran.errors, HasSubstr("luck"));
}

TEST(LabLocalmap, EveryPartLeftOutChangesTheSetup) {
  LocalmapSetup setup;
  leave_out("motion-compensation", &setup);
  EXPECT_FALSE(setup.compensates_motion);
  leave_out("wall-orientation", &setup);
  EXPECT_FALSE(setup.options.service.lpm.wall_orientation.enabled);
  leave_out("motion-learning", &setup);
  EXPECT_FALSE(setup.options.service.lpm.motion.learns);
  leave_out("degeneracy-handling", &setup);
  EXPECT_EQ(setup.options.service.lpm.motion.least_sigma_m, 1.0);
  EXPECT_TRUE(validate(setup.options.service.lpm).ok());
}

TEST(LabLocalmap, RefusesWhatIsNotThere) {
  const TemporaryFolder folder;
  const std::string log = (folder / "a.clf").string();
  EXPECT_EQ(run({"localmap", log}).status, 65);
  EXPECT_EQ(run({"localmap"}).status, 64);
  EXPECT_EQ(run({"localmap", log, "--fast"}).status, 64);
  write_file(log, "# nothing\n");
  EXPECT_EQ(run({"localmap", log}).status, 65);
  write_file(log, carmen_log());
  const std::string relations = (folder / "a.relations").string();
  EXPECT_EQ(run({"localmap", log, "--relations", relations}).status, 65);
  write_file(relations, "100 110 2 zero\n");
  const Ran ran = run({"localmap", log, "--relations", relations});
  EXPECT_EQ(ran.status, 65);
  EXPECT_THAT(ran.errors, HasSubstr("line 1"));
  write_file(relations, "# none\n");
  EXPECT_EQ(run({"localmap", log, "--relations", relations}).status, 65);
  EXPECT_EQ(run({"localmap", log, "--png", (folder / "nowhere" / "a.png").string()}).status, 73);
  const std::string config = (folder / "a.json").string();
  write_file(config, R"({"lpm": {"insert_every": 1}})");
  EXPECT_EQ(run({"localmap", log, "--config", config}).status, 78);
}

}  // namespace
}  // namespace cairn::lab
