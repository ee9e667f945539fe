#include "codec/option_object.hpp"

#include <algorithm>
#include <cmath>

namespace cairn {
namespace {

std::string number_text(double value) {
  return value == std::floor(value) && std::abs(value) < 1e15
             ? std::to_string(static_cast<std::int64_t>(value))
             : Json(value).dump();
}

std::string range_text(double low, double high) {
  return "[" + number_text(low) + ", " + number_text(high) + "]";
}

std::string joined(const std::vector<std::string>& words, const std::string& between) {
  std::string all;
  for (const std::string& word : words) {
    all += (all.empty() ? "" : between) + word;
  }
  return all;
}

}  // namespace

OptionObject& OptionObject::add(const std::string& key,
                                Binding binding,
                                const std::string& meaning) {
  entries_.push_back({key, std::move(binding), meaning});
  return *this;
}

OptionObject& OptionObject::number(const std::string& key,
                                   double* value,
                                   Range range,
                                   const std::string& meaning) {
  return add(key, Number{value, range}, meaning);
}

OptionObject& OptionObject::integer(const std::string& key,
                                    int* value,
                                    Range range,
                                    const std::string& meaning) {
  return add(key, Integer{value, range}, meaning);
}

OptionObject& OptionObject::integer(const std::string& key,
                                    std::int64_t* value,
                                    Range range,
                                    const std::string& meaning) {
  return add(key, Integer{value, range}, meaning);
}

OptionObject& OptionObject::flag(const std::string& key, bool* value, const std::string& meaning) {
  return add(key, value, meaning);
}

OptionObject& OptionObject::text(const std::string& key,
                                 std::string* value,
                                 const std::string& meaning) {
  return add(key, value, meaning);
}

OptionObject& OptionObject::choice(const std::string& key,
                                   std::function<int()> get,
                                   std::function<void(int)> set,
                                   std::vector<std::string> names,
                                   const std::string& meaning) {
  return add(key, Choice{std::move(get), std::move(set), std::move(names)}, meaning);
}

OptionObject& OptionObject::texts(const std::string& key,
                                  std::vector<std::string>* value,
                                  const std::string& meaning) {
  return add(key, value, meaning);
}

OptionObject& OptionObject::object(OptionObject child) {
  const std::string key = child.key_;
  const std::string meaning = child.meaning_;
  return add(key, std::vector<OptionObject>{std::move(child)}, meaning);
}

OptionObject& OptionObject::list(const std::string& key,
                                 std::function<std::size_t()> size,
                                 std::function<void(std::size_t)> resize,
                                 std::function<OptionObject(std::size_t)> element,
                                 const std::string& meaning) {
  return add(key, List{std::move(size), std::move(resize), std::move(element)}, meaning);
}

/// Takes one JSON value over into one binding, or says what was expected.
struct OptionObject::Reader {
  const Json& json;
  const std::string& path;
  std::vector<std::string>* complaints;

  void expect(const std::string& rule) const {
    complaints->push_back(path + " must " + rule + ", is " + json.dump());
  }

  void operator()(const Number& bound) const {
    const bool fits = json.is_number() && json.get<double>() >= bound.range.low &&
                      json.get<double>() <= bound.range.high;
    if (!fits) {
      expect("be in " + range_text(bound.range.low, bound.range.high));
      return;
    }
    *bound.value = json.get<double>();
  }
  void operator()(const Integer& bound) const {
    const bool fits = json.is_number_integer() && json.get<double>() >= bound.range.low &&
                      json.get<double>() <= bound.range.high;
    if (!fits) {
      expect("be a whole number in " + range_text(bound.range.low, bound.range.high));
      return;
    }
    std::visit([&](auto* value) { *value = json.get<std::remove_pointer_t<decltype(value)>>(); },
               bound.value);
  }
  void operator()(bool* bound) const {
    if (!json.is_boolean()) {
      expect("be true or false");
      return;
    }
    *bound = json.get<bool>();
  }
  void operator()(std::string* bound) const {
    if (!json.is_string()) {
      expect("be a string");
      return;
    }
    *bound = json.get<std::string>();
  }
  void operator()(std::vector<std::string>* bound) const {
    const bool fits = json.is_array() && std::all_of(json.begin(), json.end(), [](const Json& one) {
                        return one.is_string();
                      });
    if (!fits) {
      expect("be a list of strings");
      return;
    }
    *bound = json.get<std::vector<std::string>>();
  }
  void operator()(const Choice& bound) const {
    const auto name = std::find(bound.names.begin(), bound.names.end(),
                                json.is_string() ? json.get<std::string>() : std::string());
    if (name == bound.names.end()) {
      expect("be one of " + joined(bound.names, ", "));
      return;
    }
    bound.set(static_cast<int>(name - bound.names.begin()));
  }
  void operator()(const List& bound) const {
    if (!json.is_array() || json.size() > 64) {
      expect("be a list of at most 64 objects");
      return;
    }
    bound.resize(json.size());
    for (std::size_t i = 0; i < json.size(); ++i) {
      bound.element(i).read_into(json[i], path + "[" + std::to_string(i) + "]", complaints);
    }
  }
  void operator()(std::vector<OptionObject>& child) const {
    child.front().read_into(json, path, complaints);
  }
};

void OptionObject::read_into(const Json& json,
                             const std::string& path,
                             std::vector<std::string>* complaints) {
  const std::string prefix = path.empty() ? "" : path + ".";
  if (!json.is_object()) {
    complaints->push_back((path.empty() ? "the configuration" : path) + " must be an object, is " +
                          json.dump().substr(0, 40));
    return;
  }
  for (const auto& [key, value] : json.items()) {
    const auto entry = std::find_if(entries_.begin(), entries_.end(),
                                    [&key = key](const Entry& one) { return one.key == key; });
    if (entry == entries_.end()) {
      complaints->push_back(prefix + key + " is not an option");
      continue;
    }
    const std::string full_path = prefix + key;
    std::visit(Reader{value, full_path, complaints}, entry->binding);
  }
}

Status OptionObject::read(const Json& json) {
  std::vector<std::string> complaints;
  read_into(json, "", &complaints);
  if (complaints.empty()) {
    return {};
  }
  return Error{ErrorCode::kInvalidValue, joined(complaints, "; ")};
}

struct OptionObject::Writer {
  Json operator()(const Number& bound) const { return *bound.value; }
  Json operator()(const Integer& bound) const {
    return std::visit([](const auto* value) { return Json(*value); }, bound.value);
  }
  Json operator()(const bool* bound) const { return *bound; }
  Json operator()(const std::string* bound) const { return *bound; }
  Json operator()(const std::vector<std::string>* bound) const { return *bound; }
  Json operator()(const Choice& bound) const {
    return bound.names[static_cast<std::size_t>(bound.get())];
  }
  Json operator()(const List& bound) const {
    Json all = Json::array();
    for (std::size_t i = 0; i < bound.size(); ++i) {
      all.push_back(bound.element(i).write());
    }
    return all;
  }
  Json operator()(const std::vector<OptionObject>& child) const { return child.front().write(); }
};

Json OptionObject::write() const {
  Json json = Json::object();
  for (const Entry& entry : entries_) {
    json[entry.key] = std::visit(Writer{}, entry.binding);
  }
  return json;
}

struct OptionObject::SchemaWriter {
  Json operator()(const Number& bound) const {
    return {{"type", "number"}, {"minimum", bound.range.low}, {"maximum", bound.range.high}};
  }
  Json operator()(const Integer& bound) const {
    return {{"type", "integer"}, {"minimum", bound.range.low}, {"maximum", bound.range.high}};
  }
  Json operator()(const bool* /*bound*/) const { return {{"type", "boolean"}}; }
  Json operator()(const std::string* /*bound*/) const { return {{"type", "string"}}; }
  Json operator()(const std::vector<std::string>* /*bound*/) const {
    return {{"type", "array"}, {"items", {{"type", "string"}}}};
  }
  Json operator()(const Choice& bound) const { return {{"type", "string"}, {"enum", bound.names}}; }
  Json operator()(const List& bound) const {
    Json schema = {{"type", "array"}, {"maxItems", 64}};
    if (bound.size() > 0) {
      schema["items"] = bound.element(0).schema();
    }
    return schema;
  }
  Json operator()(const std::vector<OptionObject>& child) const { return child.front().schema(); }
};

Json OptionObject::schema() const {
  Json properties = Json::object();
  for (const Entry& entry : entries_) {
    Json property = std::visit(SchemaWriter{}, entry.binding);
    if (!entry.meaning.empty()) {
      property["description"] = entry.meaning;
    }
    if (!std::holds_alternative<std::vector<OptionObject>>(entry.binding)) {
      property["default"] = std::visit(Writer{}, entry.binding);
    }
    properties[entry.key] = std::move(property);
  }
  return {{"type", "object"},
          {"description", meaning_},
          {"additionalProperties", false},
          {"properties", std::move(properties)}};
}

struct OptionObject::RangeText {
  std::string operator()(const Number& bound) const {
    return range_text(bound.range.low, bound.range.high);
  }
  std::string operator()(const Integer& bound) const {
    return range_text(bound.range.low, bound.range.high);
  }
  std::string operator()(const bool* /*bound*/) const { return "true, false"; }
  std::string operator()(const std::string* /*bound*/) const { return "text"; }
  std::string operator()(const std::vector<std::string>* /*bound*/) const { return "texts"; }
  std::string operator()(const Choice& bound) const { return joined(bound.names, ", "); }
  std::string operator()(const List& /*bound*/) const { return "list"; }
  std::string operator()(const std::vector<OptionObject>& /*child*/) const { return "object"; }
};

void OptionObject::add_rows(const std::string& path, std::string* rows) const {
  for (const Entry& entry : entries_) {
    const std::string full_path = path.empty() ? entry.key : path + "." + entry.key;
    if (const auto* child = std::get_if<std::vector<OptionObject>>(&entry.binding)) {
      child->front().add_rows(full_path, rows);
      continue;
    }
    if (const auto* list = std::get_if<List>(&entry.binding); list != nullptr && list->size() > 0) {
      list->element(0).add_rows(full_path + "[]", rows);
      continue;
    }
    *rows += "| `" + full_path + "` | `" + std::visit(Writer{}, entry.binding).dump() + "` | " +
             std::visit(RangeText{}, entry.binding) + " | " + entry.meaning + " |\n";
  }
}

std::string OptionObject::table() const {
  std::string rows = "| option | default | range | meaning |\n|---|---|---|---|\n";
  add_rows("", &rows);
  return rows;
}

Result<Json> parse_json(const std::string& text) {
  if (text.find_first_not_of(" \t\r\n") == std::string::npos) {
    return Error{ErrorCode::kMalformed, "expected a JSON object, is empty"};
  }
  // The one place of lib/ where an exception is met: the library's own, turned into an Error here.
  try {
    return Json::parse(text, nullptr, true, true);
  } catch (const Json::exception& error) {
    // The library puts its own name for the error before what a person can use.
    const std::string what = error.what();
    const std::size_t end_of_name = what.find("] ");
    return Error{ErrorCode::kMalformed,
                 "expected JSON: " +
                     (end_of_name == std::string::npos ? what : what.substr(end_of_name + 2))};
  }
}

}  // namespace cairn
