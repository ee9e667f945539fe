#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <nlohmann/json.hpp>

#include "base/result.hpp"

namespace cairn {

using Json = nlohmann::ordered_json;

/// One object of the configuration file, described once and bound to the struct it fills. Reading,
/// writing, the schema and the table in docs/configuration.md all follow from this description.
///
///     OptionObject("lpm", "The local perceptual map")
///         .number("cell_m", &lpm.cell_m, {0.01, 1.0}, "Side of a grid cell.")
///         .integer("width_cells", &lpm.width_cells, {100, 4000}, "Side of the window.");
///
/// The bound struct must outlive the description.
class OptionObject {
 public:
  struct Range {
    double low;
    double high;
  };

  OptionObject(std::string key, std::string meaning)
      : key_(std::move(key)), meaning_(std::move(meaning)) {}

  OptionObject& number(const std::string& key,
                       double* value,
                       Range range,
                       const std::string& meaning);
  OptionObject& integer(const std::string& key,
                        int* value,
                        Range range,
                        const std::string& meaning);
  OptionObject& integer(const std::string& key,
                        std::int64_t* value,
                        Range range,
                        const std::string& meaning);
  OptionObject& flag(const std::string& key, bool* value, const std::string& meaning);
  OptionObject& text(const std::string& key, std::string* value, const std::string& meaning);
  /// An enumeration: its value is the position of the name in the list.
  OptionObject& choice(const std::string& key,
                       std::function<int()> get,
                       std::function<void(int)> set,
                       std::vector<std::string> names,
                       const std::string& meaning);
  /// A list of strings.
  OptionObject& texts(const std::string& key,
                      std::vector<std::string>* value,
                      const std::string& meaning);
  OptionObject& object(OptionObject child);
  /// A list of objects: `size` and `resize` work on the bound vector, `element` describes one.
  OptionObject& list(const std::string& key,
                     std::function<std::size_t()> size,
                     std::function<void(std::size_t)> resize,
                     std::function<OptionObject(std::size_t)> element,
                     const std::string& meaning);

  [[nodiscard]] const std::string& key() const { return key_; }

  /// Takes over what the JSON says; what it does not say keeps its default. All violations are told
  /// in one round, each with its path, its rule and what came; unknown keys are violations. On an
  /// error the bound struct may have been changed in part.
  Status read(const Json& json);

  [[nodiscard]] Json write() const;
  /// JSON Schema, draft 7.
  [[nodiscard]] Json schema() const;
  /// A Markdown table of every option with default, range and meaning.
  [[nodiscard]] std::string table() const;

 private:
  struct Number {
    double* value;
    Range range;
  };
  struct Integer {
    std::variant<int*, std::int64_t*> value;
    Range range;
  };
  struct Choice {
    std::function<int()> get;
    std::function<void(int)> set;
    std::vector<std::string> names;
  };
  struct List {
    std::function<std::size_t()> size;
    std::function<void(std::size_t)> resize;
    std::function<OptionObject(std::size_t)> element;
  };
  using Binding = std::variant<Number,
                               Integer,
                               bool*,
                               std::string*,
                               std::vector<std::string>*,
                               Choice,
                               List,
                               std::vector<OptionObject>>;
  struct Entry {
    std::string key;
    Binding binding;
    std::string meaning;
  };
  struct Reader;
  struct Writer;
  struct SchemaWriter;
  struct RangeText;

  OptionObject& add(const std::string& key, Binding binding, const std::string& meaning);
  void read_into(const Json& json, const std::string& path, std::vector<std::string>* complaints);
  void add_rows(const std::string& path, std::string* rows) const;

  std::string key_;
  std::string meaning_;
  std::vector<Entry> entries_;
};

/// Parses text as JSON; comments are allowed. An error tells line and column.
[[nodiscard]] Result<Json> parse_json(const std::string& text);

}  // namespace cairn
