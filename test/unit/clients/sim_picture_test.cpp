#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <png.h>

#include "clients/sim/world.hpp"
#include "support/files.hpp"

namespace cairn::sim {
namespace {

using ::testing::HasSubstr;
using ::testing::SizeIs;

namespace fs = std::filesystem;

class FloorPicture : public ::testing::Test {
 protected:
  /// '.' white, '#' black, '?' grey.
  fs::path picture_of(const std::vector<std::string>& rows) const {
    std::vector<std::uint8_t> grey;
    for (const std::string& row : rows) {
      for (const char symbol : row) {
        grey.push_back(symbol == '.' ? 255 : symbol == '#' ? 0 : 205);
      }
    }
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = static_cast<png_uint_32>(rows.front().size());
    image.height = static_cast<png_uint_32>(rows.size());
    image.format = PNG_FORMAT_GRAY;
    const fs::path file = folder_ / "plan.png";
    EXPECT_NE(png_image_write_to_file(&image, file.c_str(), 0, grey.data(), 0, nullptr), 0);
    return file;
  }

  fs::path file_of(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return folder_ / name;
  }

  std::string complaint_about(const fs::path& picture, const std::string& tour) const {
    try {
      const World world = read_floor_plan(picture, 1.0, file_of("tour.txt", tour));
      return "no complaint";
    } catch (const BadWorld& error) {
      return error.what();
    }
  }

  const std::vector<std::string> rows_ = {"######",  //
                                          "#....#",  //
                                          "#.??.#",  //
                                          "#....#",  //
                                          "######"};

 private:
  test::TemporaryFolder folder_;
};

TEST_F(FloorPicture, WhiteIsFreeAndUnknownIsWall) {
  const World world =
      read_floor_plan(picture_of(rows_), 1.0, file_of("tour.txt", "1.5 1.5\n4.5 1.5\n"));
  EXPECT_FALSE(world.plan.is_wall({1, 2}));
  EXPECT_TRUE(world.plan.is_wall({2, 2}));
  EXPECT_TRUE(world.plan.is_wall({0, 0}));
}

TEST_F(FloorPicture, WaypointsWithANameAreNamedPoints) {
  const std::string tour =
      "# around\n1.5 1.5 sw\n\n4.5 1.5\n4.5 3.5 ne # corner\n4.5 1.5\n1.5 1.5 sw\n";
  const World world = read_floor_plan(picture_of(rows_), 1.0, file_of("tour.txt", tour));
  EXPECT_THAT(world.tours.front().waypoints, SizeIs(5));
  ASSERT_THAT(world.junctions, SizeIs(2));
  EXPECT_EQ(world.junctions[1].name, "ne");
  EXPECT_EQ(world.junctions[1].at, (Point{4.5, 3.5}));
}

TEST_F(FloorPicture, ComplaintsNameTheLineOfTheTour) {
  const fs::path picture = picture_of(rows_);
  EXPECT_THAT(complaint_about(picture, "1.5 1.5\n4.5 3.5\n"),
              HasSubstr("tour.txt:2: expected a free straight leg"));
  EXPECT_THAT(complaint_about(picture, "1.5 1.5\n1e300 -1e300\n"), HasSubstr("tour.txt:2: "));
  EXPECT_THAT(complaint_about(picture, "1.5\n"), HasSubstr("tour.txt:1: expected y in metres"));
  EXPECT_THAT(complaint_about(picture, "1.5 nan\n"), HasSubstr("expected y in metres, got 'nan'"));
  EXPECT_THAT(complaint_about(picture, "1.5 1.5 a b\n"), HasSubstr("expected 'x_m y_m [name]'"));
  EXPECT_THAT(complaint_about(picture, "1.5 1.5 a\n4.5 1.5 a\n"),
              HasSubstr("the name 'a' already means another point"));
  EXPECT_THAT(complaint_about(picture, "1.5 1.5\n1.5 1.5\n"), HasSubstr("differs from the one"));
  EXPECT_THAT(complaint_about(picture, ""), HasSubstr("expected two waypoints or more"));
}

TEST_F(FloorPicture, WhatIsNoPictureIsRefused) {
  const std::string tour = "1.5 1.5\n4.5 1.5\n";
  EXPECT_THAT(complaint_about(file_of("text.png", "P5 no picture"), tour),
              HasSubstr("expected a PNG picture"));
  EXPECT_THAT(complaint_about("/no/such.png", tour), HasSubstr("/no/such.png"));

  const fs::path picture = picture_of(rows_);
  fs::resize_file(picture, fs::file_size(picture) - 20);
  EXPECT_THAT(complaint_about(picture, tour), HasSubstr("the picture is damaged"));
}

}  // namespace
}  // namespace cairn::sim
