#include "bench/lab/vectors_file.hpp"

#include <array>
#include <climits>
#include <fstream>
#include <set>
#include <utility>

#include "bench/lab/codes.hpp"
#include "clients/common/failure.hpp"
#include "clients/common/text.hpp"
#include "star/isomorphism.hpp"

namespace cairn::lab {
namespace {

using clients::ExitCode;
using clients::Failure;

/// A part of the file that knows where it stands.
class Field {
 public:
  Field(const Json& value, std::string where) : value_(&value), where_(std::move(where)) {}

  [[noreturn]] void reject(const std::string& expected) const {
    // replaced: a string cut short may end amid a character.
    std::string got = value_->dump(-1, ' ', false, Json::error_handler_t::replace);
    if (got.size() > 60) {
      got = got.substr(0, 57) + "...";
    }
    throw Failure(ExitCode::kBadData,
                  clients::printable(where_ + ": expected " + expected + ", got " + got));
  }
  [[nodiscard]] bool is_null() const { return value_->is_null(); }
  [[nodiscard]] bool has(const std::string& name) const { return value_->contains(name); }
  [[nodiscard]] const Json& json() const { return *value_; }
  [[nodiscard]] const std::string& where() const { return where_; }

  [[nodiscard]] Field at(const std::string& name) const {
    if (!value_->is_object()) {
      reject("an object");
    }
    if (!value_->contains(name)) {
      throw Failure(ExitCode::kBadData,
                    clients::printable(where_ + ": expected a field \"" + name + "\", got none"));
    }
    return {(*value_)[name], where_ + ", " + name};
  }
  [[nodiscard]] std::vector<Field> items(const std::string& item_name) const {
    if (!value_->is_array()) {
      reject("an array");
    }
    std::vector<Field> items;
    for (std::size_t i = 0; i < value_->size(); ++i) {
      items.emplace_back((*value_)[i], where_ + ", " + item_name + " " + std::to_string(i));
    }
    return items;
  }
  [[nodiscard]] int integer(int low, int high) const {
    const std::string range =
        "an integer from " + std::to_string(low) + " to " + std::to_string(high);
    if (!value_->is_number_integer()) {
      reject(range);
    }
    // Beyond 64 bits signed, unsigned values wrap to negative ones, which no range here contains.
    const auto number = value_->get<std::int64_t>();
    if (number < low || number > high) {
      reject(range);
    }
    return static_cast<int>(number);
  }
  [[nodiscard]] std::string string() const {
    if (!value_->is_string()) {
      reject("a string");
    }
    return value_->get<std::string>();
  }
  [[nodiscard]] Field called(const std::string& where) const { return {*value_, where}; }

 private:
  const Json* value_;
  std::string where_;
};

constexpr int kMostSlots = 64;
using Stars = std::map<std::string, Star>;

Star read_star(const Field& field) {
  Star star;
  const std::vector<Field> gateways = field.at("slots").items("slot");
  const std::vector<Field> partners = field.at("partner_slot").items("slot");
  const int size = static_cast<int>(gateways.size());
  if (size < 1 || size > kMostSlots) {
    field.at("slots").reject("1 to " + std::to_string(kMostSlots) + " slots");
  }
  if (partners.size() != gateways.size()) {
    field.at("partner_slot").reject("as many entries as slots (" + std::to_string(size) + ")");
  }
  for (std::size_t slot = 0; slot < gateways.size(); ++slot) {
    const int gateway = gateways[slot].integer(-1, size - 1);
    const int partner = partners[slot].integer(0, size - 1);
    star.slots.push_back({gateway, static_cast<std::size_t>(partner),
                          gateway < 0 ? ControlLaw::kDeadEnd : ControlLaw::kMidline});
  }
  if (const Status status = validate(star); !status) {
    field.reject("a star that can be (" + status.error().message + ")");
  }
  return star;
}

Stars read_stars(const Field& field, ViewNames* names) {
  Stars stars;
  if (!field.json().is_object()) {
    field.reject("an object with a star for each name");
  }
  for (const auto& [name, value] : field.json().items()) {
    const Star star = read_star({value, field.where() + ", " + name});
    const std::vector<int> classes = view_classes(star);
    for (std::size_t gateway = 0; gateway < classes.size(); ++gateway) {
      names->emplace(view_token(star, static_cast<int>(gateway)),
                     name + std::to_string(classes[gateway]));
    }
    stars.emplace(name, star);
  }
  return stars;
}

const Star& star_named(const Field& field, const Stars& stars) {
  const auto star = stars.find(field.string());
  if (star == stars.end()) {
    std::string known;
    for (const auto& [name, unused] : stars) {
      known += (known.empty() ? "" : ", ") + name;
    }
    field.reject("the name of a star of this file (" + known + ")");
  }
  return star->second;
}

/// Lowest gateway that looks the same.
int read_view(const Field& field, const Star& star) {
  const int gateway = field.integer(0, gateway_count(star) - 1);
  if (view_classes(star)[static_cast<std::size_t>(gateway)] != gateway) {
    field.reject("a view class: the lowest gateway of those that look the same");
  }
  return gateway;
}

Exploration read_exploration(const Field& vector, const Stars& stars) {
  Exploration exploration;
  const Field start = vector.at("start");
  exploration.start = star_named(start.at("star"), stars);
  exploration.start_gateway = start.at("gate").integer(0, gateway_count(exploration.start) - 1);
  int gateways = gateway_count(exploration.start);
  for (const Field& step : vector.at("steps").items("step")) {
    const std::vector<Field> parts = step.items("part");
    if (parts.size() != 3) {
      step.reject("[turn, star, view]");
    }
    const int turn = parts[0].called(step.where() + ", turn").integer(0, gateways - 1);
    const Star& star = star_named(parts[1].called(step.where() + ", star"), stars);
    const int view = read_view(parts[2].called(step.where() + ", view"), star);
    exploration.steps.push_back({turn, star, view});
    gateways = gateway_count(star);
  }
  return exploration;
}

void check_series(const Field& series, std::size_t steps) {
  const std::vector<Field> counts = series.items("step");
  if (counts.size() != steps) {
    series.reject("a count for each of the " + std::to_string(steps) + " steps");
  }
  for (const Field& count : counts) {
    static_cast<void>(count.integer(0, INT_MAX));
  }
}

void check_simplest(const Field& simplest) {
  if (simplest.is_null()) {
    return;
  }
  for (const char* name : {"count", "paths", "places"}) {
    static_cast<void>(simplest.at(name).integer(0, INT_MAX));
  }
  if (simplest.has("codes")) {
    for (const Field& code : simplest.at("codes").items("code")) {
      static_cast<void>(code.string());
    }
  }
}

constexpr std::array<const char*, 8> kCounts = {
    "tree_nodes",   "maps_built",        "view_mismatches",          "final_maps",
    "closed_paper", "closed_no_pending", "region_consistent_finals", "perpendicular_closed_paper"};

Json read_expected(const Field& expected, std::size_t steps) {
  for (const char* name : kCounts) {
    static_cast<void>(expected.at(name).integer(0, INT_MAX));
  }
  check_simplest(expected.at("optimal"));
  check_series(expected.at("leaves_per_step"), steps);
  if (expected.has("region_leaves_per_step")) {
    check_series(expected.at("region_leaves_per_step"), steps);
  }
  if (expected.has("minimal_region")) {
    check_simplest(expected.at("minimal_region"));
  }
  return expected.json();
}

TestVector read_vector(const Field& field, const Stars& stars) {
  TestVector vector;
  vector.name = field.at("name").string();
  const Field named = field.called("vector " + vector.name);
  vector.exploration = read_exploration(named, stars);
  const Field bound = named.at("max_places");
  if (!bound.is_null()) {
    vector.max_places = bound.integer(1, INT_MAX);
  }
  vector.nonplanar = read_expected(named.at("nonplanar"), vector.exploration.steps.size());
  vector.planar = read_expected(named.at("planar"), vector.exploration.steps.size());
  return vector;
}

Json parsed(const std::filesystem::path& path) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) {
    throw Failure(ExitCode::kBadData, path.string() + ": expected a file, got a folder");
  }
  if (!std::filesystem::is_regular_file(path, error)) {
    throw Failure(ExitCode::kBadData, path.string() + ": no such file");
  }
  std::ifstream in(path, std::ios::binary);
  if (!in) {
    throw Failure(ExitCode::kBadData, path.string() + ": cannot be read");
  }
  try {
    return Json::parse(in);
  } catch (const Json::exception& failure) {
    throw Failure(ExitCode::kBadData,
                  path.string() + ": not JSON: " + clients::printable(failure.what()));
  }
}

}  // namespace

VectorsFile read_vectors(const std::filesystem::path& path) {
  const Json json = parsed(path);
  const Field root(json, "the file");
  VectorsFile file;
  try {
    const Stars stars = read_stars(root.at("stars").called("stars"), &file.names);
    const Field vectors = root.at("vectors").called("vectors");
    std::set<std::string> names;
    for (const Field& vector : vectors.items("number")) {
      file.vectors.push_back(read_vector(vector, stars));
      if (!names.insert(file.vectors.back().name).second) {
        vector.at("name").reject("a name of its own (another one has this)");
      }
    }
    if (file.vectors.empty()) {
      vectors.reject("one exploration or more");
    }
  } catch (const Failure& failure) {
    throw Failure(failure.code(), path.string() + ": " + failure.what());
  }
  return file;
}

}  // namespace cairn::lab
