#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/result.hpp"

namespace cairn::lab {

/// A line of a text of words and numbers, which knows its number for messages.
struct TextLine {
  int number = 0;  ///< From 1.
  std::vector<std::string_view> words;

  /// "line 7: expected ..., got ...", with what came cut short.
  [[nodiscard]] Error error(const std::string& expected, std::string_view got) const;
  /// An id of a vertex, 0 to 2147483647.
  [[nodiscard]] Result<int> id(std::size_t word) const;
  /// A finite number.
  [[nodiscard]] Result<double> number_at(std::size_t word, const char* name) const;
};

/// The lines that are not blank and no remarks ('#').
[[nodiscard]] std::vector<TextLine> text_lines(std::string_view text);

/// The shortest decimal that reads as the same double.
[[nodiscard]] std::string exact(double value);

}  // namespace cairn::lab
