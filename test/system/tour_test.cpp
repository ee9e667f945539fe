// The simulated tour against its ground truth: in the preferred hypothesis every true loop is
// closed and no false one.

#include <cctype>
#include <cmath>
#include <map>
#include <sstream>
#include <vector>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "process.hpp"

namespace cairn::test {
namespace {

using nlohmann::json;

struct Junction {
  double x_m = 0.0;
  double y_m = 0.0;
  int passes = 0;
};

/// What the robot really passed, by name. Lines `t name x y`; '#' starts a comment.
std::map<std::string, Junction> junctions_passed(const std::filesystem::path& file) {
  std::map<std::string, Junction> junctions;
  std::istringstream lines(content_of(file));
  for (std::string line; std::getline(lines, line);) {
    if (line.empty() || line.front() == '#') {
      continue;
    }
    std::istringstream words(line);
    double t_s = 0.0;
    std::string name;
    Junction at;
    words >> t_s >> name >> at.x_m >> at.y_m;
    Junction& junction = junctions.try_emplace(name, at).first->second;
    ++junction.passes;
  }
  return junctions;
}

class TourTest : public ::testing::TestWithParam<int> {
 protected:
  TemporaryFolder folder_;
};

TEST_P(TourTest, ClosesEveryTrueLoopAndNoFalseOne) {
  const std::string log = (folder_ / "tour.log").string();
  const std::string map = (folder_ / "tour.cairn").string();
  const Finished sim = run({CAIRN_SIM, CAIRN_SOURCE_DIR "/config/worlds/office.txt", "--tour",
                            "demo", "--log", log, "--seed", std::to_string(GetParam())},
                           folder_);
  ASSERT_EQ(sim.status, 0) << sim.errors;
  const Finished replay = run({CAIRND, "--replay", log, "--map", map}, folder_);
  ASSERT_EQ(replay.status, 0) << replay.errors;
  const json topology = json::parse(run({CAIRN, "places", "--json", map}, folder_).output);
  std::map<std::string, Junction> junctions = junctions_passed(folder_ / "tour.junctions.txt");
  ASSERT_GT(junctions.size(), 15U);

  // The robot starts at the first junction of the tour, heading along x: the frames differ by that.
  const Junction start = junctions.at("B");
  std::map<std::string, int> visits_of;
  int visits = 0;
  for (const json& place : topology["places"]) {
    std::string nearest;
    double least_m = 1e9;
    for (const auto& [name, junction] : junctions) {
      const double distance_m = std::hypot(place["x_m"].get<double>() + start.x_m - junction.x_m,
                                           place["y_m"].get<double>() + start.y_m - junction.y_m);
      if (distance_m < least_m) {
        least_m = distance_m;
        nearest = name;
      }
    }
    EXPECT_LT(least_m, 1.5) << "place " << place["id"] << " is no junction that was passed";
    EXPECT_EQ(visits_of.count(nearest), 0U) << "two places for junction " << nearest;
    visits_of[nearest] = place["num_visits"].get<int>();
    visits += visits_of[nearest];
    EXPECT_LE(visits_of[nearest], junctions[nearest].passes) << "a false closure at " << nearest;
  }
  int passes = 0;
  for (const auto& [name, junction] : junctions) {
    // Lower case: doorways that the robot does not go through, which make no place.
    passes += std::islower(static_cast<unsigned char>(name.front())) != 0 ? 0 : junction.passes;
  }
  // The start may lack what lies behind the robot, and a blind corridor may look like an alcove.
  EXPECT_GE(visits, passes - 3);
  EXPECT_EQ(replay.output.find("given up at visit"), std::string::npos) << replay.output;
}

INSTANTIATE_TEST_SUITE_P(Seed, TourTest, ::testing::Values(1, 2, 3));

}  // namespace
}  // namespace cairn::test
