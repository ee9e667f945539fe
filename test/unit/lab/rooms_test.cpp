#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "bench/lab/program.hpp"
#include "bench/lab/rooms_score.hpp"
#include "support/files.hpp"

namespace cairn::lab {
namespace {

using Json = nlohmann::json;
using test::TemporaryFolder;
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

/// Two rooms of 3 m x 3 m side by side, in 5 cm; the door of 1 m is open or shut.
std::string two_rooms_pgm(bool is_open) {
  constexpr int kWidth = 123;
  constexpr int kHeight = 62;
  std::string text = "P5\n# two rooms\n123 62\n255\n";
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const bool is_border = x == 0 || y == 0 || x == kWidth - 1 || y == kHeight - 1;
      const bool is_wall = x == 61 && !(is_open && y > 20 && y <= 40);
      text += is_border || is_wall ? '\0' : static_cast<char>(254);
    }
  }
  return text;
}

class LabRooms : public testing::Test {
 protected:
  LabRooms() {
    test::write_file(map_, two_rooms_pgm(true));
    test::write_file(truth_, two_rooms_pgm(false));
  }

  TemporaryFolder folder_;
  std::string map_ = (folder_ / "map.pgm").string();
  std::string truth_ = (folder_ / "rooms.pgm").string();
  std::string png_ = (folder_ / "regions.png").string();
};

TEST_F(LabRooms, FindsThemAndJudgesThemByTheTrueOnes) {
  const Ran ran = run({"rooms", map_, "--truth", truth_, "--json", "--png", png_});
  ASSERT_EQ(ran.status, 0) << ran.errors;
  const Json json = Json::parse(ran.output);
  EXPECT_EQ(json["rooms"], 2);
  EXPECT_EQ(json["regions"], 2);
  EXPECT_EQ(json["critical_lines"], 1);
  EXPECT_GT(json["recall"].get<double>(), 99.0);
  EXPECT_GT(json["precision"].get<double>(), 98.0);
  EXPECT_GT(json["time_ms"].get<double>(), 0.0);
  EXPECT_NEAR(json["graph"]["critical_lines"][0]["width_m"].get<double>(), 1.0, 0.051);
  EXPECT_NEAR(json["graph"]["regions"][0]["area_m2"].get<double>(), 9.0, 0.1);
  EXPECT_THAT(test::content_of(png_), HasSubstr("PNG"));
}

TEST_F(LabRooms, OfSeveralMapsGetARowEachAndTheMean) {
  const Ran ran = run({"rooms", map_, truth_, "--truth", truth_, "--truth", truth_});
  ASSERT_EQ(ran.status, 0) << ran.errors;
  EXPECT_THAT(ran.output, HasSubstr("map.pgm"));
  EXPECT_THAT(ran.output, HasSubstr("rooms.pgm"));
  EXPECT_THAT(ran.output, HasSubstr("mean"));
  const Ran as_json = run({"rooms", map_, truth_, "--json"});
  const Json json = Json::parse(as_json.output);
  EXPECT_EQ(json["maps"].size(), 2U);
  EXPECT_DOUBLE_EQ(json["regions"].get<double>(), 2.0);
  EXPECT_FALSE(json.contains("recall"));
}

TEST_F(LabRooms, RefusesAWrongCommandLine) {
  EXPECT_EQ(run({"rooms"}).status, 64);
  EXPECT_EQ(run({"rooms", map_, "--colour"}).status, 64);
  EXPECT_EQ(run({"rooms", map_, map_, "--truth", truth_}).status, 64);
  EXPECT_EQ(run({"rooms", map_, map_, "--png", png_}).status, 64);
  EXPECT_EQ(run({"rooms", map_, "--cell", "0"}).status, 64);
  const Ran overwritten = run({"rooms", map_, "--png", map_});
  EXPECT_EQ(overwritten.status, 64);
  EXPECT_THAT(overwritten.errors, HasSubstr("is read: choose another name"));
  const Ran ran = run({"rooms", map_, "--max-narrowing", "2"});
  EXPECT_EQ(ran.status, 64);
  EXPECT_THAT(ran.errors, HasSubstr("max_narrowing"));
}

TEST_F(LabRooms, RefusesATruthWithoutRooms) {
  const std::string all_wall = (folder_ / "wall.pgm").string();
  std::ofstream(all_wall) << "P5 123 62 255\n" << std::string(std::size_t{123} * 62, '\0');
  const Ran ran = run({"rooms", map_, "--truth", all_wall});
  EXPECT_EQ(ran.status, 65);
  EXPECT_THAT(ran.errors, HasSubstr("expected white rooms"));
}

TEST_F(LabRooms, RefusesBadPicturesByName) {
  const std::string bad = (folder_ / "bad.pgm").string();
  const auto complaint = [&](const std::string& content) {
    test::write_file(bad, content);
    const Ran ran = run({"rooms", bad});
    EXPECT_EQ(ran.status, 65) << ran.output;
    EXPECT_THAT(ran.errors, HasSubstr("bad.pgm"));
    return ran.errors;
  };
  EXPECT_EQ(run({"rooms", (folder_ / "none.png").string()}).status, 65);
  EXPECT_EQ(run({"rooms", (folder_ / "").string()}).status, 65);
  EXPECT_THAT(complaint(""), HasSubstr("PNG"));
  EXPECT_THAT(complaint("no picture"), HasSubstr("PNG"));
  EXPECT_THAT(complaint("P5"), HasSubstr("header"));
  EXPECT_THAT(complaint("P5 4 -4 255 "), HasSubstr("header"));
  EXPECT_THAT(complaint("P5 0 4 255 "), HasSubstr("0 x 4"));
  EXPECT_THAT(complaint("P5 99999999999 99999999999 255 "), HasSubstr("million"));
  EXPECT_THAT(complaint("P5 4 4 65535 0123"), HasSubstr("8 bits"));
  EXPECT_THAT(complaint("P5 4 4 255 0123"), HasSubstr("short"));
  test::write_file(bad, "P5 2 2 255 0123");
  EXPECT_EQ(run({"rooms", map_, "--truth", bad}).status, 65) << "of another size";
}

TEST_F(LabRooms, HaveNoRegionsInAPictureThatIsAllWall) {
  test::write_file(map_, "P5 40 40 255 " + std::string(1600, '\0'));
  const Ran ran = run({"rooms", map_, "--json"});
  ASSERT_EQ(ran.status, 0) << ran.errors;
  EXPECT_EQ(Json::parse(ran.output)["regions"], 0);
}

TEST(RoomsScore, CreditsARegionToTheRoomItOverlapsMost) {
  // One region over two rooms of 20 x 20 and 10 x 20 cells.
  GreyPicture truth{31, 20, std::vector<std::uint8_t>(31 * 20, 255)};
  RegionGraph graph;
  graph.geometry.width = 31;
  graph.geometry.height = 20;
  graph.region_of.assign(31 * 20, 0);
  graph.regions.resize(1);
  for (std::size_t y = 0; y < 20; ++y) {
    truth.grey[y * 31 + 20] = 0;
    graph.region_of[y * 31 + 20] = RegionGraph::kNoRegion;
  }
  const RoomsScore score = score_of(graph, true_rooms(truth));
  EXPECT_EQ(score.rooms, 2U);
  EXPECT_NEAR(score.recall, 100.0, 1e-9);
  EXPECT_NEAR(score.credited_recall, 50.0, 1e-9);
  EXPECT_NEAR(score.precision, 100.0 * 2.0 / 3.0, 1e-9);
}

TEST(RoomsScore, HasNoSpecksForRooms) {
  GreyPicture truth{30, 30, std::vector<std::uint8_t>(900, 0)};
  for (std::size_t i = 0; i < 10; ++i) {
    truth.grey[i * 30 + i] = 255;  // Joined at corners only: ten pieces of one cell.
  }
  EXPECT_TRUE(true_rooms(truth).cells.empty());
}

}  // namespace
}  // namespace cairn::lab
