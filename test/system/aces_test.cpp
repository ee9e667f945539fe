// The papers' own experiment, from the recorded log alone: the corners and sides of a square of
// corridors, and a hall in its middle.
//
// Source: Kuipers et al., ICRA 2004, Sec. IV and Fig. 5; Modayil et al., IROS 2004, Sec. V.

#include <cmath>
#include <map>
#include <string>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "process.hpp"
#include "support/recorded_data.hpp"

namespace cairn::test {
namespace {

using nlohmann::json;
using ::testing::ContainerEq;
using ::testing::HasSubstr;

constexpr char kLog[] = "carmen/aces/aces.clf";

/// The place of the lattice within three metres of a point, as read off the map by eye. The robot
/// starts near N, in the frame of its odometry.
std::string name_of(double x_m, double y_m) {
  const std::map<std::string, std::pair<double, double>> kLattice{
      {"NW", {-18.0, -9.0}}, {"N", {-0.5, 0.0}},   {"NE", {20.0, 10.0}},
      {"W", {-10.5, -25.0}}, {"C", {7.5, -17.0}},  {"E", {28.0, -7.5}},
      {"SW", {-2.0, -43.5}}, {"S", {16.0, -35.5}}, {"SE", {35.0, -25.0}}};
  std::string nearest = "nowhere";
  double least_m = 3.0;
  for (const auto& [name, at] : kLattice) {
    const double distance_m = std::hypot(x_m - at.first, y_m - at.second);
    if (distance_m < least_m) {
      least_m = distance_m;
      nearest = name;
    }
  }
  return nearest;
}

TEST(Aces, FifteenVisitsMakeTheTrueLatticeOfNinePlaces) {
  CAIRN_NEED_DATA(kLog);
  const TemporaryFolder folder;
  const std::string map = (folder / "aces.cairn").string();
  const Finished replay =
      run({CAIRND, "--replay", recorded_data(kLog).string(), "--map", map}, folder);
  ASSERT_EQ(replay.status, 0) << replay.errors;
  EXPECT_THAT(replay.output, HasSubstr("4 loop closures"));
  EXPECT_THAT(replay.output, HasSubstr("guarantee kept"));
  const json topology = json::parse(run({CAIRN, "places", "--json", map}, folder).output);
  std::map<std::string, int> visits;
  for (const json& place : topology["places"]) {
    const std::string name = name_of(place["x_m"], place["y_m"]);
    EXPECT_EQ(visits.count(name), 0U) << "two places at " << name;
    visits[name] = place["num_visits"];
  }
  // The walk: N NE E SE S SW W NW N C S C W C E.
  EXPECT_THAT(visits, ContainerEq(std::map<std::string, int>{{"N", 2},
                                                             {"NE", 1},
                                                             {"E", 2},
                                                             {"SE", 1},
                                                             {"S", 2},
                                                             {"SW", 1},
                                                             {"W", 2},
                                                             {"NW", 1},
                                                             {"C", 3}}));
}

}  // namespace
}  // namespace cairn::test
