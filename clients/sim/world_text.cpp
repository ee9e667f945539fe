#include <algorithm>
#include <cstddef>
#include <map>
#include <numbers>
#include <sstream>
#include <utility>

#include "clients/sim/text_file.hpp"
#include "clients/sim/world.hpp"

namespace cairn::sim {
namespace {

constexpr std::size_t kMaxSide_cells = 4'000;
constexpr std::size_t kMaxTourWaypoints = 1'000;

/// Of ASCII, in every locale.
bool is_letter_or_digit(char symbol) {
  return (symbol >= 'a' && symbol <= 'z') || (symbol >= 'A' && symbol <= 'Z') ||
         (symbol >= '0' && symbol <= '9');
}

struct Line {
  std::size_t number = 0;
  std::string text;
};

/// Reads one world; a first pass collects the lines, then the drawing gives names their points.
class WorldParser {
 public:
  explicit WorldParser(std::string source) : source_(std::move(source)) {}

  World parse(std::string_view text) {
    read_lines(text);
    read_drawing();
    for (const Line& line : tour_lines_) {
      tours_.push_back(tour_of(line));
    }
    World world;
    if (!start_line_.text.empty()) {
      world.start = read_start();
    }
    for (const auto& [name, at] : points_) {
      world.junctions.push_back({name, at});
    }
    world.plan = std::move(plan_);
    world.tours = std::move(tours_);
    return world;
  }

 private:
  [[noreturn]] void fail(std::size_t line, const std::string& what) const {
    throw BadWorld(source_ + ":" + std::to_string(line) + ": " + what);
  }

  void read_lines(std::string_view text) {
    bool in_drawing = false;
    std::size_t number = 0;
    while (!text.empty()) {
      const std::size_t end = std::min(text.find('\n'), text.size());
      Line line = {++number, std::string(text.substr(0, end))};
      text.remove_prefix(std::min(end + 1, text.size()));
      if (!line.text.empty() && line.text.back() == '\r') {
        line.text.pop_back();
      }
      if (in_drawing) {
        drawing_.push_back(std::move(line));
      } else {
        in_drawing = read_header(line);
      }
    }
    last_line_ = number;
    while (!drawing_.empty() && drawing_.back().text.empty()) {
      drawing_.pop_back();
    }
  }

  /// @return whether the drawing begins after this line
  bool read_header(const Line& line) {
    std::istringstream words(line.text);
    std::string keyword;
    words >> keyword;
    if (keyword.empty() || keyword.front() == ';') {
      return false;
    }
    if (keyword == "map") {
      return true;
    }
    if (keyword == "cell_m") {
      read_cell(line, words);
    } else if (keyword == "tour") {
      tour_lines_.push_back(line);
    } else if (keyword == "start") {
      if (!start_line_.text.empty()) {
        fail(line.number, "expected one line 'start', this is the second");
      }
      start_line_ = line;
    } else {
      fail(line.number, "expected 'cell_m', 'start', 'tour', 'map' or a comment after ';', got '" +
                            keyword + "'");
    }
    return false;
  }

  void read_cell(const Line& line, std::istringstream& words) {
    std::string word;
    words >> word;
    cell_m_ = number_in(line, word, "the side of a cell in metres");
    if (!(cell_m_ >= 0.01 && cell_m_ <= 2.0)) {
      fail(line.number, "expected a cell of 0.01 to 2 m, got " + word);
    }
    expect_end(line, words);
  }

  [[nodiscard]] double number_in(const Line& line,
                                 const std::string& word,
                                 const std::string& meaning) const {
    return number_of(word, meaning, source_ + ":" + std::to_string(line.number));
  }

  void expect_end(const Line& line, std::istringstream& words) const {
    std::string word;
    if (words >> word) {
      fail(line.number, "expected the end of the line, got '" + word + "'");
    }
  }

  void read_drawing() {
    if (cell_m_ == 0.0) {
      fail(last_line_, "expected a line 'cell_m METRES' before the drawing");
    }
    if (drawing_.empty()) {
      fail(last_line_, "expected a line 'map' and the drawing after it");
    }
    const std::size_t width = drawing_.front().text.size();
    if (width == 0 || width > kMaxSide_cells || drawing_.size() > kMaxSide_cells) {
      fail(drawing_.front().number, "expected a drawing of 1 to 4000 cells a side");
    }
    plan_ = FloorPlan(static_cast<int>(width), static_cast<int>(drawing_.size()), cell_m_);
    for (std::size_t i = 0; i < drawing_.size(); ++i) {
      if (drawing_[i].text.size() != width) {
        fail(drawing_[i].number, "expected " + std::to_string(width) +
                                     " characters as in the first line of the drawing, got " +
                                     std::to_string(drawing_[i].text.size()));
      }
      read_row(drawing_[i], static_cast<int>(drawing_.size() - 1 - i));
    }
  }

  void read_row(const Line& line, int row) {
    for (std::size_t i = 0; i < line.text.size(); ++i) {
      const char symbol = line.text[i];
      const Cell cell = {static_cast<int>(i), row};
      if (symbol == '#') {
        continue;
      }
      plan_.set_free(cell);
      const bool is_name = is_letter_or_digit(symbol);
      if (is_name && !points_.emplace(std::string(1, symbol), plan_.centre_of(cell)).second) {
        fail(line.number, std::string("the name '") + symbol + "' is in the drawing twice");
      }
      if (!is_name && symbol != '.') {
        fail(line.number, "expected '#', '.', a letter or a digit in column " +
                              std::to_string(i + 1) + ", got '" + symbol + "'");
      }
    }
  }

  [[nodiscard]] Point point_named(const Line& line, const std::string& name) const {
    const auto found = points_.find(name);
    if (found == points_.end()) {
      fail(line.number, "expected a point of the drawing, got '" + name + "'");
    }
    return found->second;
  }

  [[nodiscard]] Tour tour_of(const Line& line) const {
    std::istringstream words(line.text);
    std::string word;
    Tour tour;
    words >> word >> tour.name;
    if (!std::all_of(tour.name.begin(), tour.name.end(), is_letter_or_digit)) {
      fail(line.number, "expected a tour's name of letters and digits, got '" + tour.name + "'");
    }
    for (const Tour& other : tours_) {
      if (other.name == tour.name) {
        fail(line.number, "the tour '" + tour.name + "' is there twice");
      }
    }
    while (words >> word) {
      add_waypoint(line, {word, point_named(line, word)}, tour);
    }
    if (tour.waypoints.size() < 2) {
      fail(line.number, "expected 'tour NAME' and two points or more");
    }
    return tour;
  }

  void add_waypoint(const Line& line, const NamedPoint& waypoint, Tour& tour) const {
    if (tour.waypoints.size() >= kMaxTourWaypoints) {
      fail(line.number, "expected at most 1000 points in a tour");
    }
    if (!tour.waypoints.empty()) {
      const NamedPoint& last = tour.waypoints.back();
      if (last.name == waypoint.name) {
        fail(line.number, "the point '" + waypoint.name + "' follows itself");
      }
      check_leg(line, last, waypoint);
    }
    tour.waypoints.push_back(waypoint);
  }

  void check_leg(const Line& line, const NamedPoint& from, const NamedPoint& to) const {
    if (const auto obstacle = obstacle_on(plan_, from.at, to.at)) {
      fail(line.number, "expected a free straight leg from '" + from.name + "' to '" + to.name +
                            "', but " + *obstacle);
    }
  }

  [[nodiscard]] Pose read_start() const {
    std::istringstream words(start_line_.text);
    std::string keyword;
    std::string name;
    std::string heading;
    words >> keyword >> name >> heading;
    const Point at = point_named(start_line_, name);
    const double degrees = number_in(start_line_, heading, "a heading in degrees");
    expect_end(start_line_, words);
    for (const Tour& tour : tours_) {
      check_leg(start_line_, {name, at}, tour.waypoints.front());
    }
    return {at, wrap_angle(degrees * std::numbers::pi / 180.0)};
  }

  std::string source_;
  double cell_m_ = 0.0;
  std::vector<Line> tour_lines_;
  Line start_line_;
  std::vector<Line> drawing_;
  std::size_t last_line_ = 0;
  FloorPlan plan_;
  std::map<std::string, Point> points_;
  std::vector<Tour> tours_;
};

}  // namespace

World parse_world(std::string_view text, const std::string& source) {
  return WorldParser(source).parse(text);
}

World read_world(const std::filesystem::path& file) {
  return parse_world(read_text(file), file.string());
}

}  // namespace cairn::sim
