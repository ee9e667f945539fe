#include "bench/lab/pose_graph_text.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <system_error>

#include "clients/common/text.hpp"

namespace cairn::lab {
namespace {

constexpr std::size_t kMostShown = 60;

bool is_space(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f';
}

std::vector<std::string_view> words_of(std::string_view line) {
  std::vector<std::string_view> words;
  std::size_t at = 0;
  while (at < line.size()) {
    while (at < line.size() && is_space(line[at])) {
      ++at;
    }
    const std::size_t begin = at;
    while (at < line.size() && !is_space(line[at])) {
      ++at;
    }
    if (at > begin) {
      words.push_back(line.substr(begin, at - begin));
    }
  }
  return words;
}

/// from_chars does not take a plus sign, which files have.
std::string_view unsigned_plus(std::string_view word) {
  return word.size() > 1 && word[0] == '+' && word[1] != '-' && word[1] != '+' ? word.substr(1)
                                                                               : word;
}

}  // namespace

Error TextLine::error(const std::string& expected, std::string_view got) const {
  std::string shown(got.substr(0, kMostShown));
  if (got.size() > kMostShown) {
    shown += "...";
  }
  return {ErrorCode::kMalformed, "line " + std::to_string(number) + ": expected " + expected +
                                     ", got " + clients::printable(shown)};
}

Result<int> TextLine::id(std::size_t word) const {
  const std::string_view text = unsigned_plus(words[word]);
  int value = 0;
  const auto [stop, status] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (status != std::errc() || stop != text.data() + text.size() || value < 0) {
    return error("an id from 0 to 2147483647", words[word]);
  }
  return value;
}

Result<double> TextLine::number_at(std::size_t word, const char* name) const {
  const std::string_view text = unsigned_plus(words[word]);
  double value = 0.0;
  const auto [stop, status] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (status != std::errc() || stop != text.data() + text.size() || !std::isfinite(value)) {
    return error("a finite number for " + std::string(name), words[word]);
  }
  return value;
}

std::vector<TextLine> text_lines(std::string_view text) {
  std::vector<TextLine> lines;
  int number = 0;
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    ++number;
    TextLine line{number, words_of(text.substr(0, end))};
    if (!line.words.empty() && line.words.front().front() != '#') {
      lines.push_back(std::move(line));
    }
    text = end == std::string_view::npos ? std::string_view() : text.substr(end + 1);
  }
  return lines;
}

std::string exact(double value) {
  std::array<char, 32> digits{};
  const auto [stop, status] = std::to_chars(digits.data(), digits.data() + digits.size(), value);
  return status == std::errc() ? std::string(digits.data(), stop) : std::string();
}

}  // namespace cairn::lab
