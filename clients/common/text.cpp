#include "clients/common/text.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <numbers>
#include <ostream>
#include <string_view>

#include <unistd.h>

#include "clients/common/failure.hpp"

namespace cairn::clients {
namespace {

bool is_number(const std::string& cell) {
  return !cell.empty() && cell.find_first_not_of("0123456789.+-%") == std::string::npos;
}

// Counts characters, not bytes, so that names with accents keep the columns lined up.
std::size_t columns_of(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U;
  }));
}

// Bytes of the character at `begin` if it is sound UTF-8, no control character, and allowed in XML;
// otherwise 0.
std::size_t printable_size(const std::string& text, std::size_t begin) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned first = byte(begin);
  if (first < 0x80) {
    return first >= 0x20 && first != 0x7F ? 1 : 0;
  }
  const std::size_t size = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  if (first < 0xC2 || first > 0xF4 || begin + size > text.size()) {
    return 0;
  }
  unsigned code = first & (0xFFU >> (size + 1));
  for (std::size_t i = begin + 1; i < begin + size; ++i) {
    if ((byte(i) & 0xC0U) != 0x80U) {
      return 0;
    }
    code = code << 6U | (byte(i) & 0x3FU);
  }
  const bool is_too_long = code < (size == 4 ? 0x10000U : size == 3 ? 0x800U : 0x80U);
  const bool is_surrogate = code >= 0xD800 && code <= 0xDFFF;
  const bool is_control = code < 0xA0;  // Some terminals take orders by U+0080 to U+009F too.
  const bool is_character = code <= 0x10FFFF && (code & 0xFFFEU) != 0xFFFE;
  return is_too_long || is_surrogate || is_control || !is_character ? 0 : size;
}

}  // namespace

std::string fixed(double value, int decimals) {
  if (!std::isfinite(value)) {
    return std::isnan(value) ? "nan" : value > 0 ? "inf" : "-inf";
  }
  std::array<char, 352> buffer{};
  std::snprintf(buffer.data(), buffer.size(), "%.*f", std::clamp(decimals, 0, 17), value);
  std::string text = buffer.data();
  const bool is_zero = text.find_first_not_of("-0.") == std::string::npos;
  return is_zero && text.front() == '-' ? text.substr(1) : text;
}

std::string degrees(double angle_rad) {
  return fixed(angle_rad * 180.0 / std::numbers::pi, 1);
}

std::string duration(double seconds) {
  if (!std::isfinite(seconds) || std::abs(seconds) < 60.0) {
    return fixed(seconds, 1) + " s";
  }
  const auto whole = static_cast<std::int64_t>(std::min(std::abs(seconds), 1e15));
  const std::string sign = seconds < 0 ? "-" : "";
  const auto two_digits = [](std::int64_t n) { return (n < 10 ? "0" : "") + std::to_string(n); };
  if (whole < 3600) {
    return sign + std::to_string(whole / 60) + " min " + two_digits(whole % 60) + " s";
  }
  return sign + std::to_string(whole / 3600) + " h " + two_digits(whole / 60 % 60) + " min";
}

std::string byte_size(std::int64_t bytes) {
  if (bytes < 1000) {
    return std::to_string(bytes) + " B";
  }
  const auto size = static_cast<double>(bytes);
  return size < 1e6   ? fixed(size / 1e3, 1) + " kB"
         : size < 1e9 ? fixed(size / 1e6, 1) + " MB"
                      : fixed(size / 1e9, 1) + " GB";
}

std::string printable(const std::string& text) {
  std::string result;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t size = printable_size(text, i);
    result += size == 0 ? "?" : text.substr(i, size);
    i += std::max<std::size_t>(size, 1);
  }
  return result;
}

std::string xml_escaped(const std::string& text) {
  std::string result;
  for (const char c : printable(text)) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

Table::Table(std::vector<std::string> headings) : rows_{std::move(headings)} {}

void Table::add(std::vector<std::string> cells) {
  cells.resize(rows_.front().size());
  rows_.push_back(std::move(cells));
}

void Table::print(std::ostream& out) const {
  const std::size_t columns = rows_.front().size();
  std::vector<std::size_t> widths(columns, 0);
  std::vector<bool> right(columns, rows_.size() > 1);
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    for (std::size_t c = 0; c < columns; ++c) {
      widths[c] = std::max(widths[c], columns_of(rows_[r][c]));
      right[c] = right[c] && (r == 0 || is_number(rows_[r][c]));
    }
  }
  for (const std::vector<std::string>& row : rows_) {
    std::string line;
    for (std::size_t c = 0; c < columns; ++c) {
      const std::string padding(widths[c] - columns_of(row[c]), ' ');
      line += (right[c] ? padding + row[c] : row[c] + padding) + "  ";
    }
    out << line.substr(0, line.find_last_not_of(' ') + 1) << '\n';
  }
}

void make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  std::error_code ignored;
  if (!std::filesystem::is_directory(folder, ignored)) {
    const bool is_taken = std::filesystem::exists(folder, ignored);
    throw Failure(ExitCode::kCannotCreate,
                  folder.string() + (is_taken ? " is a file, and no folder to write into"
                                              : " cannot be made: " + error.message()));
  }
}

void write_file(const std::filesystem::path& path, const std::string& content) {
  const auto refuse = [&](const char* what) {
    throw Failure(ExitCode::kCannotCreate, "cannot " + std::string(what) + " " + path.string());
  };
  const std::filesystem::path temporary = path.string() + ".tmp" + std::to_string(::getpid());
  std::error_code error;
  // Whoever names the map as the picture's file must not lose the map.
  constexpr std::string_view kDatabase = "SQLite format 3";
  std::string start(kDatabase.size(), '\0');
  if (std::ifstream(path, std::ios::binary).read(start.data(), std::ssize(start)) &&
      start == kDatabase) {
    throw Failure(ExitCode::kCannotCreate,
                  path.string() + " is a map file: it is not written over");
  }
  // A device or a pipe is written to as it is: nothing may be renamed over it.
  const bool is_plain =
      !std::filesystem::exists(path, error) || std::filesystem::is_regular_file(path, error);
  std::ofstream file(is_plain ? temporary : path, std::ios::binary | std::ios::trunc);
  if (!file) {
    refuse("create");
  }
  file.write(content.data(), static_cast<std::streamsize>(content.size()));
  file.close();
  if (!file) {
    if (is_plain) {
      std::filesystem::remove(temporary, error);
    }
    refuse("write");
  }
  if (!is_plain) {
    return;
  }
  std::filesystem::rename(temporary, path, error);
  if (error) {
    std::error_code ignored;
    std::filesystem::remove(temporary, ignored);
    refuse("create");
  }
}

}  // namespace cairn::clients
