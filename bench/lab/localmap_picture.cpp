#include "bench/lab/localmap_picture.hpp"

#include <algorithm>
#include <cmath>

#include "clients/common/canvas.hpp"

namespace cairn::lab {
namespace {

using clients::Canvas;
using clients::Colour;
using clients::PixelPoint;

constexpr double kMargin_m = 1.0;
constexpr double kFinest_m = 0.05;  // per pixel
constexpr double kMostPixels = 1'600.0;

struct Frame {
  double left_m = 0.0;
  double top_m = 0.0;
  double pixel_m = kFinest_m;
  int width = 1;
  int height = 1;

  [[nodiscard]] PixelPoint at(const Vector2d& p) const {
    return {(p.x() - left_m) / pixel_m, (top_m - p.y()) / pixel_m};
  }
};

Frame frame_of(const LocalmapRun& run) {
  Vector2d low = run.track.front().T_lpm_robot.translation();
  Vector2d high = low;
  const auto take_in = [&](const Vector2d& p) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  };
  for (const TrackedPose& scan : run.track) {
    take_in(scan.T_lpm_robot.translation());
  }
  for (const Vector2d& wall : run.walls_lpm) {
    take_in(wall);
  }
  const Vector2d size = high - low + Vector2d::Constant(2.0 * kMargin_m);
  Frame frame;
  frame.left_m = low.x() - kMargin_m;
  frame.top_m = high.y() + kMargin_m;
  frame.pixel_m = std::max(kFinest_m, size.maxCoeff() / kMostPixels);
  frame.width = std::max(1, static_cast<int>(std::ceil(size.x() / frame.pixel_m)));
  frame.height = std::max(1, static_cast<int>(std::ceil(size.y() / frame.pixel_m)));
  return frame;
}

void draw_walls(const LocalmapRun& run, const Frame& frame, Canvas* canvas) {
  constexpr int kDarker = 40;
  for (const Vector2d& wall : run.walls_lpm) {
    const PixelPoint p = frame.at(wall);
    const int x = std::clamp(static_cast<int>(p.x), 0, frame.width - 1);
    const int y = std::clamp(static_cast<int>(p.y), 0, frame.height - 1);
    const auto grey = static_cast<std::uint8_t>(std::max(0, canvas->at(x, y).red - kDarker));
    canvas->set(x, y, {grey, grey, grey});
  }
}

void draw_way(const LocalmapRun& run, const Frame& frame, Canvas* canvas) {
  for (std::size_t i = 1; i < run.track.size(); ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(run.track.size());
    const auto red = static_cast<std::uint8_t>(std::lround(255.0 * share));
    const Colour colour{red, 60, static_cast<std::uint8_t>(255 - red)};
    canvas->line(frame.at(run.track[i - 1].T_lpm_robot.translation()),
                 frame.at(run.track[i].T_lpm_robot.translation()), {colour, 1.2, 0.8});
  }
}

}  // namespace

void draw_localmap(const LocalmapRun& run, const std::filesystem::path& png) {
  const Frame frame = frame_of(run);
  Canvas canvas(frame.width, frame.height, {255, 255, 255});
  draw_walls(run, frame, &canvas);
  draw_way(run, frame, &canvas);
  clients::write_png(canvas, png);
}

}  // namespace cairn::lab
