#include "wire/log_writer.hpp"

#include <cerrno>
#include <system_error>

#include "wire/log_source.hpp"

namespace cairn::wire {

namespace {

void put_big_endian(std::uint64_t value, std::size_t size, Bytes* bytes) {
  for (std::size_t i = size; i-- > 0;) {
    bytes->push_back(static_cast<std::uint8_t>(value >> (8 * i)));
  }
}

}  // namespace

Expected<LogWriter> LogWriter::open(const std::string& file) {
  std::FILE* const stream = std::fopen(file.c_str(), "wbe");
  if (stream == nullptr) {
    return Expected<LogWriter>::failure("cannot write " + file + ": " +
                                        std::generic_category().message(errno));
  }
  return LogWriter(stream);
}

bool LogWriter::write(std::int64_t utime, std::string_view channel, const Bytes& bytes) {
  if (!file_ || has_failed_) {
    return false;
  }
  Bytes event;
  event.reserve(kEventHeaderSize + channel.size() + bytes.size());
  put_big_endian(kEventMark, 4, &event);
  put_big_endian(static_cast<std::uint64_t>(next_event_++), 8, &event);
  put_big_endian(static_cast<std::uint64_t>(utime), 8, &event);
  put_big_endian(channel.size(), 4, &event);
  put_big_endian(bytes.size(), 4, &event);
  event.insert(event.end(), channel.begin(), channel.end());
  event.insert(event.end(), bytes.begin(), bytes.end());
  has_failed_ = std::fwrite(event.data(), 1, event.size(), file_.get()) != event.size();
  return !has_failed_;
}

bool LogWriter::close() {
  if (!file_) {
    return false;
  }
  return std::fclose(file_.release()) == 0 && !has_failed_;
}

}  // namespace cairn::wire
