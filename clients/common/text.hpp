#pragma once

#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

namespace cairn::clients {

/// A number with that many decimals, never "-0.00"; "nan" and "inf" where it is not finite.
[[nodiscard]] std::string fixed(double value, int decimals);

/// Radians as degrees with one decimal, "-90.0".
[[nodiscard]] std::string degrees(double angle_rad);

/// "12.3 s", "4 min 05 s", "2 h 03 min".
[[nodiscard]] std::string duration(double seconds);

/// "812 B", "14.2 kB", "3.1 MB".
[[nodiscard]] std::string byte_size(std::int64_t bytes);

/// Text from the bus or a file, safe for a terminal: control characters and what is no UTF-8 are
/// replaced by '?'.
[[nodiscard]] std::string printable(const std::string& text);

/// The same for XML and HTML, content or attributes.
[[nodiscard]] std::string xml_escaped(const std::string& text);

/// Columns lined up below their headings, two spaces apart. Numbers stand to the right.
class Table {
 public:
  explicit Table(std::vector<std::string> headings);
  /// @pre as many cells as headings
  void add(std::vector<std::string> cells);
  void print(std::ostream& out) const;

 private:
  std::vector<std::vector<std::string>> rows_;
};

/// Makes a folder to write into, where there is none. Throws Failure(kCannotCreate).
void make_folder(const std::filesystem::path& folder);

/// Writes a file as a whole: into a temporary file beside it, then renamed. Throws
/// Failure(kCannotCreate).
void write_file(const std::filesystem::path& path, const std::string& content);

}  // namespace cairn::clients
