#include "clients/sim/text_file.hpp"

#include <charconv>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <system_error>

#include "clients/sim/world.hpp"

namespace cairn::sim {
namespace {

constexpr std::size_t kMaxFileBytes = 32'000'000;

}  // namespace

std::string read_text(const std::filesystem::path& file) {
  std::error_code error;
  if (std::filesystem::is_directory(file, error)) {
    throw BadWorld(file.string() + ": expected a file, is a folder");
  }
  std::ifstream stream(file, std::ios::binary);
  if (!stream) {
    throw BadWorld(file.string() + ": cannot be opened");
  }
  // One byte more than allowed tells whether there is more; the size of a pipe is not known.
  std::string text(kMaxFileBytes + 1, '\0');
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(stream.gcount()));
  if (text.size() > kMaxFileBytes) {
    throw BadWorld(file.string() + ": expected at most 32 MB");
  }
  return text;
}

double number_of(const std::string& word, const std::string& meaning, const std::string& where) {
  double value = 0.0;
  const char* const end = word.data() + word.size();
  const auto [stopped, error] = std::from_chars(word.data(), end, value);
  if (error != std::errc{} || stopped != end || !std::isfinite(value)) {
    throw BadWorld(where + ": expected " + meaning + ", got '" + word + "'");
  }
  return value;
}

}  // namespace cairn::sim
