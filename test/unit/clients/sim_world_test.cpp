#include <filesystem>
#include <string>

#include <gmock/gmock.h>

#include "clients/sim/world.hpp"

namespace cairn::sim {
namespace {

using ::testing::ElementsAre;
using ::testing::Field;
using ::testing::HasSubstr;
using ::testing::SizeIs;

constexpr const char* kRing =
    "; a ring\n"
    "cell_m 1\n"
    "start A 90\n"
    "tour loop A B C D A\n"
    "map\n"
    "######\n"
    "#D..C#\n"
    "#.##.#\n"
    "#A..B#\n"
    "######\n";

std::string complaint_about(const std::string& text) {
  try {
    const World world = parse_world(text, "w.txt");
    return "no complaint";
  } catch (const BadWorld& error) {
    return error.what();
  }
}

std::string replaced(std::string text, const std::string& part, const std::string& by) {
  return text.replace(text.find(part), part.size(), by);
}

TEST(World, TheTopLineOfTheDrawingHasTheLargestY) {
  const World world = parse_world(kRing, "w.txt");

  ASSERT_THAT(world.junctions, SizeIs(4));
  EXPECT_EQ(world.junctions[0].name, "A");
  EXPECT_EQ(world.junctions[0].at, (Point{1.5, 1.5}));
  EXPECT_EQ(world.junctions[2].name, "C");
  EXPECT_EQ(world.junctions[2].at, (Point{4.5, 3.5}));
  EXPECT_TRUE(world.plan.is_wall({2, 2}));
  EXPECT_FALSE(world.plan.is_wall({1, 2}));
}

TEST(World, ATourGoesThroughItsPointsInOrder) {
  const World world = parse_world(kRing, "w.txt");
  const auto named = [](const char* name) { return Field(&NamedPoint::name, name); };
  EXPECT_THAT(tour_named(world, "loop").waypoints,
              ElementsAre(named("A"), named("B"), named("C"), named("D"), named("A")));
}

TEST(World, TheStartSaysWhereTheRobotStandsAndItsHeading) {
  const World world = parse_world(kRing, "w.txt");
  const Pose start = start_of(world, world.tours.front());
  EXPECT_EQ(start.at, (Point{1.5, 1.5}));
  EXPECT_DOUBLE_EQ(start.theta_rad, std::numbers::pi / 2.0);
}

TEST(World, WithoutAStartTheRobotFacesTheSecondPoint) {
  const World world = parse_world(replaced(kRing, "start A 90\n", ""), "w.txt");
  EXPECT_DOUBLE_EQ(start_of(world, world.tours.front()).theta_rad, 0.0);
}

TEST(World, AStartElsewhereIsTheFirstLegOfThePath) {
  const World world = parse_world(replaced(kRing, "start A", "start D"), "w.txt");
  EXPECT_THAT(path_of(world, world.tours.front()), SizeIs(6));
  EXPECT_THAT(complaint_about(replaced(kRing, "start A", "start C")),
              HasSubstr("w.txt:3: expected a free straight leg from 'C' to 'A'"));
}

TEST(World, LineEndsOfOtherSystemsAreRead) {
  std::string text;
  for (const char symbol : std::string(kRing)) {
    text += symbol == '\n' ? "\r\n" : std::string(1, symbol);
  }
  EXPECT_THAT(parse_world(text, "w.txt").junctions, SizeIs(4));
}

TEST(World, ComplaintsNameTheLineAndWhatWasExpected) {
  EXPECT_THAT(complaint_about(replaced(kRing, "cell_m 1", "cell_m 1x")),
              HasSubstr("w.txt:2: expected the side of a cell in metres, got '1x'"));
  EXPECT_THAT(complaint_about(replaced(kRing, "cell_m 1", "cell_m nan")), HasSubstr("w.txt:2: "));
  EXPECT_THAT(complaint_about(replaced(kRing, "cell_m 1", "cell_m 1e9")),
              HasSubstr("w.txt:2: expected a cell of 0.01 to 2 m"));
  EXPECT_THAT(complaint_about(replaced(kRing, "cell_m 1", "cell_m 1 m")),
              HasSubstr("w.txt:2: expected the end of the line, got 'm'"));
  EXPECT_THAT(complaint_about(replaced(kRing, "cell_m 1\n", "")), HasSubstr("cell_m METRES"));
  EXPECT_THAT(complaint_about(replaced(kRing, "start A 90", "start A north")),
              HasSubstr("w.txt:3: expected a heading in degrees, got 'north'"));
  EXPECT_THAT(complaint_about(replaced(kRing, "start A 90", "begin A 90")),
              HasSubstr("w.txt:3: expected 'cell_m', 'start', 'tour', 'map'"));
  EXPECT_THAT(complaint_about(replaced(kRing, "start A 90", "start A 90\nstart B 0")),
              HasSubstr("w.txt:4: expected one line 'start'"));
}

TEST(World, ComplaintsAboutToursNameTheLeg) {
  EXPECT_THAT(complaint_about(replaced(kRing, "A B C D A", "A B X")),
              HasSubstr("w.txt:4: expected a point of the drawing, got 'X'"));
  EXPECT_THAT(complaint_about(replaced(kRing, "A B C D A", "A C")),
              HasSubstr("w.txt:4: expected a free straight leg from 'A' to 'C', but a wall is"));
  EXPECT_THAT(complaint_about(replaced(kRing, "loop A", "lo\"op A")),
              HasSubstr("expected a tour's name of letters and digits"));
  EXPECT_THAT(complaint_about(replaced(kRing, "A B C D A", "A A")),
              HasSubstr("the point 'A' follows itself"));
  EXPECT_THAT(complaint_about(replaced(kRing, "A B C D A", "A")),
              HasSubstr("expected 'tour NAME' and two points or more"));
  EXPECT_THAT(complaint_about(replaced(kRing, "loop A B C D A", "loop A B\ntour loop B A")),
              HasSubstr("w.txt:5: the tour 'loop' is there twice"));
}

TEST(World, ComplaintsAboutTheDrawingNameItsLine) {
  EXPECT_THAT(complaint_about(replaced(kRing, "#.##.#", "#.##.##")),
              HasSubstr("w.txt:8: expected 6 characters as in the first line of the drawing"));
  EXPECT_THAT(complaint_about(replaced(kRing, "#.##.#", "#.# .#")),
              HasSubstr("w.txt:8: expected '#', '.', a letter or a digit in column 4, got ' '"));
  EXPECT_THAT(complaint_about(replaced(kRing, "#.##.#", "#A##.#")),
              HasSubstr("w.txt:9: the name 'A' is in the drawing twice"));
  EXPECT_THAT(complaint_about("cell_m 1\n"), HasSubstr("expected a line 'map'"));
  EXPECT_THAT(complaint_about(""), HasSubstr("cell_m METRES"));
}

// Whatever the bytes are, they are a world or a complaint.
TEST(World, MutilatedTextIsRefusedOrReadButNeverBreaksTheParser) {
  const std::string good = kRing;
  for (std::size_t position = 0; position < good.size(); ++position) {
    for (const char byte : {'\0', '\n', '#', 'A', '9', '-', '\xff'}) {
      std::string text = good;
      text[position] = byte;
      complaint_about(text);
    }
    complaint_about(good.substr(0, position));
  }
}

TEST(World, AnUnknownTourIsAnsweredWithTheNamesThereAre) {
  const World world = parse_world(kRing, "w.txt");
  EXPECT_EQ(tour_named(world, "").name, "loop");
  try {
    const Tour tour = tour_named(world, "walk");
    FAIL() << "found " << tour.name;
  } catch (const BadWorld& error) {
    EXPECT_STREQ(error.what(), "there is no tour walk; there are: loop");
  }
}

TEST(World, AMissingFileIsNamed) {
  try {
    const World world = read_world("/no/such/world.txt");
    FAIL() << "read " << world.tours.size() << " tours";
  } catch (const BadWorld& error) {
    EXPECT_STREQ(error.what(), "/no/such/world.txt: cannot be opened");
  }
}

TEST(World, TheWorldsThatAreShippedCanBeDriven) {
  for (const char* const name : {"office", "square", "lattice"}) {
    SCOPED_TRACE(name);
    const std::filesystem::path worlds = std::filesystem::path(CAIRN_SOURCE_DIR) / "config/worlds";
    const World world = read_world(worlds / (std::string(name) + ".txt"));
    EXPECT_GE(world.tours.size(), 2U);
    EXPECT_GE(world.junctions.size(), 8U);
  }
}

}  // namespace
}  // namespace cairn::sim
