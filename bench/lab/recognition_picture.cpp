#include "bench/lab/recognition_picture.hpp"

#include <algorithm>
#include <cmath>

#include "clients/common/canvas.hpp"
#include "clients/common/text.hpp"

namespace cairn::lab {
namespace {

using clients::Canvas;
using clients::Colour;
using clients::Pen;
using clients::PixelPoint;

constexpr int kWidth = 900;
constexpr int kHeight = 600;
constexpr double kMargin = 60.0;
constexpr double kLetter = 12.0;
constexpr Colour kGrey{200, 200, 200};
constexpr Colour kInk{40, 40, 40};
constexpr Colour kFalse{200, 40, 40};
constexpr Colour kMissed{40, 70, 200};

struct Axes {
  double low = -8.0;
  double high = 8.0;

  [[nodiscard]] PixelPoint at(double threshold, double share) const {
    return {kMargin + (kWidth - 2.0 * kMargin) * (threshold - low) / (high - low),
            kHeight - kMargin - (kHeight - 2.0 * kMargin) * share};
  }
};

void draw_axes(const Axes& axes, Canvas* canvas) {
  for (int tenth = 0; tenth <= 10; tenth += 2) {
    const double share = 0.1 * tenth;
    canvas->line(axes.at(axes.low, share), axes.at(axes.high, share), {kGrey});
    const PixelPoint label = axes.at(axes.low, share);
    canvas->text({label.x - 40.0, label.y + 5.0}, kLetter, std::to_string(10 * tenth) + "%",
                 {kInk});
  }
  for (double threshold = axes.low; threshold <= axes.high; threshold += 2.0) {
    canvas->line(axes.at(threshold, 0.0), axes.at(threshold, 1.0), {kGrey});
    const PixelPoint label = axes.at(threshold, 0.0);
    canvas->text({label.x - 8.0, label.y + 20.0}, kLetter, clients::fixed(threshold, 0), {kInk});
  }
  const PixelPoint middle = axes.at(0.5 * (axes.low + axes.high), 0.0);
  canvas->text({middle.x - 110.0, middle.y + 42.0}, kLetter, "threshold, log-likelihood ratio",
               {kInk});
}

}  // namespace

void draw_error_curves(const std::vector<ErrorCurve>& curves, const std::filesystem::path& png) {
  Axes axes;
  if (!curves.empty() && curves.front().rates.size() > 1) {
    axes.low = curves.front().rates.front().threshold;
    axes.high = curves.front().rates.back().threshold;
  }
  Canvas canvas(kWidth, kHeight, {255, 255, 255});
  draw_axes(axes, &canvas);
  for (std::size_t i = 0; i < curves.size(); ++i) {
    std::vector<PixelPoint> false_matches;
    std::vector<PixelPoint> missed_matches;
    for (const ErrorRates& rates : curves[i].rates) {
      false_matches.push_back(axes.at(rates.threshold, rates.false_matches));
      missed_matches.push_back(axes.at(rates.threshold, rates.missed_matches));
    }
    const double dash = i == 0 ? 0.0 : 12.0 / static_cast<double>(i);
    canvas.polyline(false_matches, {kFalse, 2.0, 1.0, dash});
    canvas.polyline(missed_matches, {kMissed, 2.0, 1.0, dash});
    const double line_y = 18.0 + 16.0 * static_cast<double>(i);
    canvas.line({kMargin, line_y}, {kMargin + 40.0, line_y}, {kFalse, 2.0, 1.0, dash});
    canvas.line({kMargin + 50.0, line_y}, {kMargin + 90.0, line_y}, {kMissed, 2.0, 1.0, dash});
    canvas.text({kMargin + 100.0, line_y + 4.0}, kLetter,
                "false, missed matches: " + curves[i].name, {kInk});
  }
  clients::write_png(canvas, png);
}

}  // namespace cairn::lab
