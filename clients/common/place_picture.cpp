#include "clients/common/place_picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>
#include <sstream>

#include "clients/common/perceived_place.hpp"
#include "clients/common/place_window.hpp"
#include "clients/common/text.hpp"

namespace cairn::clients {
namespace {

using cairn_lcm::opening_t;
using cairn_lcm::perceived_place_t;

constexpr int kWidth = 900;
constexpr int kMapSide = 780;
constexpr int kTitle = 66;
constexpr int kLine = 24;
constexpr int kTile = 440;
constexpr int kTileTitle = 26;
constexpr double kLetters = 10.0;
constexpr double kTitleLetters = 13.0;
constexpr Colour kPaper{245, 246, 248};
constexpr Colour kInk{30, 34, 40};

std::string utc(std::int64_t utime) {
  const auto seconds = static_cast<std::time_t>(utime / 1'000'000);
  std::tm parts{};
  std::array<char, 32> text{};
  const bool is_time = gmtime_r(&seconds, &parts) != nullptr &&
                       std::strftime(text.data(), text.size(), "%Y-%m-%d %H:%M:%S", &parts) > 0;
  return is_time ? text.data() : "?";
}

std::string gateway_text(std::int32_t gateway, const char* none) {
  return gateway < 0 ? none : std::to_string(gateway);
}

/// The gist of a path fragment.
std::string fragment_text(const perceived_place_t& place, std::size_t i) {
  const std::string from = std::to_string(place.fragment_from[i]);
  return place.fragment_through[i] < 0 ? "the path through gateway " + from + " ends here"
                                       : "a path passes through, " + from + " to " +
                                             std::to_string(place.fragment_through[i]);
}

/// Writes lines below each other.
class Writer {
 public:
  Writer(Canvas* canvas, double top) : canvas_(canvas), y_(top) {}

  void line(const std::string& text, Colour colour) {
    double height = kLetters;
    while (height > 5.0 && Canvas::text_width(height, text) > kWidth - 28.0) {
      height -= 0.5;
    }
    canvas_->text({14.0, y_ + 14.0}, height, text, {.colour = colour, .width_pixels = 1.3});
    y_ += kLine;
  }

 private:
  Canvas* canvas_;
  double y_;
};

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) {
    lines.push_back(line);
  }
  return lines;
}

std::string title_of(const perceived_place_t& place, const PlaceCaption& caption) {
  return (place.place_id < 0 ? std::string() : "place " + std::to_string(place.place_id) + ", ") +
         "visit " + std::to_string(place.visit) +
         (caption.name.empty() ? "" : ": " + printable(caption.name));
}

void write_title(const perceived_place_t& place, const PlaceCaption& caption, Canvas* canvas) {
  canvas->text({14.0, 28.0}, kTitleLetters, title_of(place, caption),
               {.colour = kInk, .width_pixels = 2.0});
  canvas->text({14.0, 52.0}, kLetters,
               utc(place.entered_utime) + " to " + utc(place.left_utime).substr(11) +
                   " UTC, in by " + gateway_text(place.arrival_gateway, "none (started here)") +
                   ", out by " + gateway_text(place.departure_gateway, "none (still here)") +
                   ", distinctiveness " + fixed(place.distinctiveness_share, 2),
               {.colour = kInk, .width_pixels = 1.3});
}

std::string opening_text(const perceived_place_t& place, std::size_t i) {
  const opening_t& opening = place.openings[i];
  std::string text = opening_label(place, i) + "  " + printable(opening.state_name);
  text += opening.width_m > 0.0 ? ", " + fixed(opening.width_m, 1) + " m wide" : "";
  return text + ": " + printable(opening.reason);
}

}  // namespace

Canvas draw_perceived_place(const perceived_place_t& place, const PlaceCaption& caption) {
  check_perceived_place(place);
  constexpr std::size_t kMostLines = 200;
  const std::vector<std::string> star = lines_of(place.star);
  const std::size_t lines =
      std::min(kMostLines, place.openings.size() + place.fragment_from.size() + star.size() + 1);
  Canvas canvas(kWidth, kTitle + kMapSide + static_cast<int>(lines) * kLine + 14, kPaper);
  write_title(place, caption, &canvas);
  const Window window(place, {0.5 * (kWidth - kMapSide), kTitle}, kMapSide);
  draw_window(place, window, &canvas);
  draw_scale(window, &canvas);
  Writer writer(&canvas, kTitle + kMapSide + 8);
  for (std::size_t i = 0; i < place.openings.size(); ++i) {
    writer.line(opening_text(place, i), opening_colour(place.openings[i]));
  }
  for (std::size_t i = 0; i < place.fragment_from.size(); ++i) {
    writer.line(fragment_text(place, i), fragment_colour(i));
  }
  writer.line("star, clockwise:", kInk);
  for (const std::string& line : star) {
    writer.line(printable(line), kInk);
  }
  return canvas;
}

Canvas draw_place_sheet(const std::vector<perceived_place_t>& places) {
  const std::size_t count = std::max<std::size_t>(1, places.size());
  const auto columns = static_cast<std::size_t>(
      std::clamp(std::ceil(std::sqrt(1.2 * static_cast<double>(count))), 1.0, 60.0));
  const std::size_t rows = std::min<std::size_t>(60, (count + columns - 1) / columns);
  Canvas canvas(static_cast<int>(columns) * kTile, static_cast<int>(rows) * (kTile + kTileTitle),
                kPaper);
  for (std::size_t i = 0; i < std::min(places.size(), rows * columns); ++i) {
    check_perceived_place(places[i]);
    const PixelPoint corner{static_cast<double>(i % columns) * kTile,
                            static_cast<double>(i / columns) * (kTile + kTileTitle)};
    draw_window(places[i], Window(places[i], {corner.x + 4, corner.y + kTileTitle}, kTile - 8.0),
                &canvas);
    canvas.text({corner.x + 6.0, corner.y + 18.0}, kLetters,
                title_of(places[i], {}) + ": in " + gateway_text(places[i].arrival_gateway, "-") +
                    ", out " + gateway_text(places[i].departure_gateway, "-") +
                    ", distinctiveness " + fixed(places[i].distinctiveness_share, 2),
                {.colour = kInk, .width_pixels = 1.3});
  }
  return canvas;
}

}  // namespace cairn::clients
