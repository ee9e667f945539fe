#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace cairn::lab {

/// 1234567 as "1,234,567".
[[nodiscard]] std::string grouped(std::int64_t number);

/// "1 2 3".
template <typename Number>
[[nodiscard]] std::string joined(const std::vector<Number>& numbers) {
  std::string text;
  for (const Number number : numbers) {
    if (!text.empty()) {
      text += ' ';
    }
    text += std::to_string(number);
  }
  return text;
}

/// Throws clients::Failure(kUsage) where an output would be written over a file that is read, or
/// over another output. Empty names are none.
void check_outputs(const std::vector<std::string>& inputs, const std::vector<std::string>& outputs);

}  // namespace cairn::lab
