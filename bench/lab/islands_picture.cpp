#include "bench/lab/islands_picture.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "clients/common/canvas.hpp"
#include "clients/common/text.hpp"

namespace cairn::lab {
namespace {

using clients::Canvas;
using clients::Colour;
using clients::PixelPoint;

constexpr double kLongestSide = 1'200.0;
constexpr int kHeading = 34;
constexpr Colour kInk{30, 34, 40};
constexpr Colour kWall{70, 72, 76};

/// From red over yellow to green.
Colour graded(double goodness) {
  const double share = std::clamp(goodness, 0.0, 1.0);
  const double red = std::min(1.0, 2.0 * (1.0 - share));
  const double green = std::min(1.0, 2.0 * share);
  return {static_cast<std::uint8_t>(std::lround(220.0 * red)),
          static_cast<std::uint8_t>(std::lround(190.0 * green)), 40};
}

/// One of the two drawings.
struct Panel {
  double top = 0.0;
  double pixels_per_m = 1.0;
  double height_m = 0.0;

  [[nodiscard]] PixelPoint at(double x_m, double y_m) const {
    return {x_m * pixels_per_m, top + (height_m - y_m) * pixels_per_m};
  }
};

/// The walls alone: what is coloured is floor.
void draw_walls(const sim::World& world, const Panel& panel, Canvas* canvas) {
  const sim::FloorPlan& plan = world.plan;
  const double cell_m = plan.cell_m();
  for (int row = 0; row < plan.rows(); ++row) {
    for (int column = 0; column < plan.columns(); ++column) {
      if (plan.is_wall({column, row})) {
        canvas->rectangle(panel.at(column * cell_m, (row + 1) * cell_m),
                          panel.at((column + 1) * cell_m, row * cell_m), kWall);
      }
    }
  }
}

template <typename Goodness>
void draw_panel(const sim::World& world,
                const IslandsRun& run,
                double side_m,
                const Panel& panel,
                const Goodness& goodness_of,
                Canvas* canvas) {
  for (const TriedPose& pose : run.poses) {
    canvas->rectangle(panel.at(pose.p_world.x() - 0.5 * side_m, pose.p_world.y() + 0.5 * side_m),
                      panel.at(pose.p_world.x() + 0.5 * side_m, pose.p_world.y() - 0.5 * side_m),
                      graded(goodness_of(pose)), 0.85);
  }
  draw_walls(world, panel, canvas);
}

void write(const std::string& text, double y, Canvas* canvas) {
  canvas->text({10.0, y}, 11.0, text, {.colour = kInk, .width_pixels = 1.5});
}

}  // namespace

void draw_islands(const sim::World& world,
                  const IslandsRun& run,
                  const IslandsOptions& options,
                  const std::filesystem::path& png) {
  const double width_m = world.plan.columns() * world.plan.cell_m();
  const double height_m = world.plan.rows() * world.plan.cell_m();
  const double pixels_per_m = kLongestSide / std::max({1.0, width_m, height_m});
  const int panel_height = static_cast<int>(std::ceil(height_m * pixels_per_m));
  Canvas canvas(std::max(640, static_cast<int>(std::ceil(width_m * pixels_per_m))),
                2 * (kHeading + panel_height) + 4, {245, 246, 248});
  double worst_m = 0.0;
  for (const TriedPose& pose : run.poses) {
    worst_m = std::max(worst_m, pose.error_m);
  }
  write("distinctiveness: red 0, yellow 0.5, green 1, rank correlation with the error " +
            clients::fixed(run.rank_correlation, 2),
        22.0, &canvas);
  draw_panel(
      world, run, options.spacing_m, {static_cast<double>(kHeading), pixels_per_m, height_m},
      [](const TriedPose& pose) { return pose.island.distinctiveness; }, &canvas);
  const double top = 2.0 * kHeading + panel_height;
  write("mean error of localisation: green 0, red " + clients::fixed(worst_m, 2) +
            " m, starts off by up to " + clients::fixed(options.offset_m, 2) + " m",
        top - 12.0, &canvas);
  draw_panel(
      world, run, options.spacing_m, {top, pixels_per_m, height_m},
      [&](const TriedPose& pose) { return worst_m > 0.0 ? 1.0 - pose.error_m / worst_m : 1.0; },
      &canvas);
  clients::write_png(canvas, png);
}

}  // namespace cairn::lab
