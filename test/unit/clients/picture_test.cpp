#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "clients/cairn/drawing.hpp"
#include "clients/cairn/topology_files.hpp"
#include "clients/common/failure.hpp"
#include "clients/common/text.hpp"
#include "unit/clients/sample_map.hpp"

namespace cairn::clients {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr Colour kWhite{255, 255, 255};
constexpr Colour kBlack{0, 0, 0};

MapLayers sample_layers() {
  MapLayers layers;
  layers.grid = raster_of(sample_grid());
  layers.topology = sample_topology();
  return layers;
}

Colour colour_at(const Canvas& canvas, const Viewport& view, double x_m, double y_m) {
  const PixelPoint p = view.pixel(x_m, y_m);
  return canvas.at(static_cast<int>(p.x), static_cast<int>(p.y));
}

int brightness(Colour c) {
  return c.red + c.green + c.blue;
}

TEST(MapPicture, ShowsFloorWhiteWallsDarkAndTheUnknownGrey) {
  const MapLayers layers = sample_layers();
  const Canvas canvas = draw_map(layers, 1000);
  const Viewport view(layers, 1000);

  EXPECT_EQ(colour_at(canvas, view, 8.0, 0.6), kWhite);
  EXPECT_LT(brightness(colour_at(canvas, view, 8.0, 1.025)), 150);
  EXPECT_EQ(colour_at(canvas, view, 8.0, 5.0), (Colour{205, 208, 213}));
  EXPECT_EQ(colour_at(canvas, view, 1.8, 0.0), path_colour(0));
  EXPECT_EQ(colour_at(canvas, view, 1.2, 0.7), kGatewayColour);
  EXPECT_EQ(colour_at(canvas, view, -1.2, 10.4), kPendingColour);
}

TEST(MapPicture, OfAnEmptyMapIsStillAPicture) {
  MapLayers layers;
  cairn_lcm::grid_map_t nothing{};
  nothing.cell_m = 0.05;
  layers.grid = raster_of(nothing);
  layers.topology = cairn_lcm::topology_t{};
  const Canvas canvas = draw_map(layers, 300);
  EXPECT_GT(canvas.width(), 0);
}

TEST(MapPicture, ValuesThatAreNoNumbersOrAreFarAwayDoNoHarm) {
  MapLayers layers = sample_layers();
  layers.trajectory = sample_trajectory();
  for (const double value : {std::nan(""), std::numeric_limits<double>::infinity(), 1e300, -1e9}) {
    layers.topology->places[0].x_m = value;
    layers.topology->places[1].theta_rad = value;
    layers.topology->places[1].gateways[0].width_m = value;
    layers.topology->places[2].gateways[0].bearing_rad = value;
    layers.trajectory->x_m[7] = value;
    const Viewport view(layers, 400);
    EXPECT_LE(view.width(), 400);
    EXPECT_GT(view.pixels_per_m(), 5.0) << "the sound part still fills the picture";
    EXPECT_LE(draw_map(layers, 400).width(), 400);
    EXPECT_THAT(topology_svg(*layers.topology), Not(HasSubstr("nan")));
  }
}

TEST(MapPicture, SegmentsToPlacesThatAreNotThereAreLeftOut) {
  cairn_lcm::topology_t map = sample_topology();
  map.segments[0].to_place = 77;
  map.segments[1].from_gateway = -1;
  map.segments[2].to_gateway = 9;

  EXPECT_TRUE(course_of(map, map.segments[0]).empty());
  EXPECT_TRUE(course_of(map, map.segments[1]).empty());
  EXPECT_TRUE(course_of(map, map.segments[2]).empty());
  EXPECT_EQ(course_of(map, map.segments[3]).size(), 4U);
  EXPECT_THAT(topology_graphml(map), Not(HasSubstr("p77")));
}

TEST(ScaleBar, IsARoundNumberThatFits) {
  for (double longest_m = 0.01; longest_m < 1e5; longest_m *= 1.07) {
    const double bar_m = scale_bar_m(longest_m);
    EXPECT_LE(bar_m, longest_m * (1.0 + 1e-9));
    EXPECT_GT(bar_m, longest_m / 2.51);
  }
  EXPECT_EQ(scale_bar_m(7.0), 5.0);
  EXPECT_EQ(length_text(0.2), "20 cm");
  EXPECT_EQ(length_text(2000.0), "2 km");
}

TEST(Canvas, LinesAreDrawnWithTheirWidthAndCutOffAtTheBorder) {
  Canvas canvas(20, 20, kWhite);
  canvas.line({-100.0, 10.0}, {100.0, 10.0}, {.colour = kBlack, .width_pixels = 4.0});

  for (int x = 0; x < 20; ++x) {
    EXPECT_EQ(canvas.at(x, 7), kWhite);
    EXPECT_EQ(canvas.at(x, 8), kBlack);
    EXPECT_EQ(canvas.at(x, 11), kBlack);
    EXPECT_EQ(canvas.at(x, 12), kWhite);
  }
}

TEST(Canvas, SlantingLinesAreAsThickAsStraightOnes) {
  for (int degree = 0; degree < 180; degree += 7) {
    Canvas canvas(120, 120, kWhite);
    const double a = degree * std::acos(-1.0) / 180.0;
    canvas.line({60 - 40 * std::cos(a), 60 - 40 * std::sin(a)},
                {60 + 40 * std::cos(a), 60 + 40 * std::sin(a)},
                {.colour = kBlack, .width_pixels = 3.0});
    double ink = 0.0;
    for (int y = 0; y < 120; ++y) {
      for (int x = 0; x < 120; ++x) {
        ink += (255.0 - canvas.at(x, y).red) / 255.0;
      }
    }
    EXPECT_NEAR(ink, 80.0 * 3.0 + std::acos(-1.0) * 1.5 * 1.5, 8.0) << degree;
  }
}

TEST(Canvas, TextWithAnyBytesIsDrawn) {
  Canvas canvas(400, 40, kWhite);
  std::string bytes;
  for (int c = 1; c < 256; ++c) {
    bytes += static_cast<char>(c);
  }
  canvas.text({0.0, 30.0}, 12.0, bytes, {.colour = kBlack});
  int ink = 0;
  for (int x = 0; x < 400; ++x) {
    ink += canvas.at(x, 24) == kWhite ? 0 : 1;
  }
  EXPECT_GT(ink, 20);
}

TEST(Raster, TilesOfTheWrongSizeAreRefused) {
  cairn_lcm::grid_map_t map = sample_grid();
  map.tiles[3].num_cells = 5;
  map.tiles[3].cells.resize(5);
  EXPECT_THROW((void)raster_of(map), Failure);

  map = sample_grid();
  map.cell_m = std::nan("");
  EXPECT_THROW((void)raster_of(map), Failure);

  map = sample_grid();
  map.tiles[0].tile_x = -2'000'000'000;
  EXPECT_THROW((void)raster_of(map), Failure);

  map = sample_grid();
  map.tiles[0].tile_x = -1'000'000;
  map.tiles[1].tile_y = 1'000'000;
  map.tiles[0].cells[0] = map.tiles[1].cells[0] = 0;
  EXPECT_THROW((void)raster_of(map), Failure) << "more cells than memory";
}

TEST(Text, IsSafeForTerminalsAndXml) {
  EXPECT_EQ(printable("B\xC3\xBCro \x1B[31m\n\xC2\x9B\xFF\xED\xA0\x80"),
            "B\xC3\xBCro ?[31m???????");
  EXPECT_EQ(xml_escaped("<a href=\"x\">&'\x01"), "&lt;a href=&quot;x&quot;&gt;&amp;'?");
}

TEST(Text, NumbersReadWell) {
  EXPECT_EQ(fixed(-0.001, 2), "0.00");
  EXPECT_EQ(fixed(-1.005, 1), "-1.0");
  EXPECT_EQ(fixed(std::nan(""), 2), "nan");
  EXPECT_EQ(duration(5.25), "5.2 s");
  EXPECT_EQ(duration(3725.0), "1 h 02 min");
  EXPECT_EQ(byte_size(3'100'000), "3.1 MB");
}

}  // namespace
}  // namespace cairn::clients
