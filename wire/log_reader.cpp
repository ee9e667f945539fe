#include "wire/log_reader.hpp"

#include <array>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <system_error>

#include "wire/log_source.hpp"

namespace cairn::wire {

namespace {

bool is_event_mark(const std::array<std::uint8_t, 4>& start) {
  return start == std::array<std::uint8_t, 4>{0xED, 0xA1, 0xDA, 0x01};
}

/// Logs of text have no byte like this.
bool is_binary(const std::array<std::uint8_t, 4>& start, std::size_t size) {
  for (std::size_t i = 0; i < size; ++i) {
    if (start[i] == 0 || start[i] >= 0x80) {
      return true;
    }
  }
  return false;
}

}  // namespace

LogReader::LogReader(std::unique_ptr<Source> source) : source_(std::move(source)) {}
LogReader::LogReader(LogReader&& other) noexcept = default;
LogReader& LogReader::operator=(LogReader&& other) noexcept = default;
LogReader::~LogReader() = default;

Expected<LogReader> LogReader::open(const std::string& file) {
  using Opened = Expected<LogReader>;
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) {
    const bool is_folder = std::filesystem::is_directory(file, error);
    return Opened::failure("cannot read " + file +
                           (is_folder ? ": expected a file, got a folder" : ": no such file"));
  }
  const auto size = static_cast<std::int64_t>(std::filesystem::file_size(file, error));
  FileHandle stream(std::fopen(file.c_str(), "rbe"));
  if (!stream || error) {
    return Opened::failure("cannot read " + file + ": " + std::generic_category().message(errno));
  }
  std::array<std::uint8_t, 4> start{};
  const std::size_t length = std::fread(start.data(), 1, start.size(), stream.get());
  if (length == 0) {
    return Opened::failure(file + " is empty");
  }
  std::rewind(stream.get());
  if (is_event_mark(start)) {
    return Opened(LogReader(open_event_log(std::move(stream), size)));
  }
  if (is_binary(start, length)) {
    return Opened::failure(file + " is neither an LCM event log nor a CARMEN log");
  }
  return Opened(LogReader(open_carmen_log(std::move(stream), size)));
}

std::optional<LogMessage> LogReader::next() {
  return source_->next();
}
const std::optional<std::string>& LogReader::damage() const {
  return source_->damage;
}
std::int64_t LogReader::bytes_read() const {
  return source_->bytes_read;
}
std::int64_t LogReader::bytes_total() const {
  return source_->bytes_total;
}
const std::map<std::string, std::int64_t>& LogReader::skipped_lines() const {
  return source_->skipped_lines;
}

}  // namespace cairn::wire
