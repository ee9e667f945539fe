#include <array>

#include "wire/log_source.hpp"

namespace cairn::wire {

namespace {

constexpr std::uint32_t kMaxChannelBytes = 1024;
/// LCM's own bound for a message over UDP.
constexpr std::uint32_t kMaxMessageBytes = 1U << 28U;

template <class T>
T big_endian(const std::uint8_t* bytes) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < sizeof(T); ++i) {
    value = value << 8U | bytes[i];
  }
  return static_cast<T>(value);
}

class EventLog : public LogReader::Source {
 public:
  EventLog(FileHandle file, std::int64_t total) : file_(std::move(file)) { bytes_total = total; }

  // LCM's own reader cannot tell damage from the end of the file.
  std::optional<LogMessage> next() override {
    if (damage) {
      return std::nullopt;
    }
    std::array<std::uint8_t, kEventHeaderSize> header{};
    const std::size_t length = std::fread(header.data(), 1, header.size(), file_.get());
    if (length == 0 && bytes_read == bytes_total) {
      return std::nullopt;
    }
    if (length < header.size()) {
      return damaged("the file ends within an event");
    }
    if (big_endian<std::uint32_t>(header.data()) != kEventMark) {
      return damaged("no event begins here");
    }
    const auto channel_size = big_endian<std::uint32_t>(&header[20]);
    const auto message_size = big_endian<std::uint32_t>(&header[24]);
    if (channel_size == 0 || channel_size > kMaxChannelBytes || message_size > kMaxMessageBytes) {
      return damaged("an event of impossible size");
    }
    if (std::int64_t{channel_size} + message_size > bytes_total - bytes_read - kHeaderBytes) {
      return damaged("the file ends within an event");
    }
    LogMessage message{big_endian<std::int64_t>(&header[12]), std::string(channel_size, ' '),
                       Bytes(message_size)};
    if (!read(message.channel.data(), channel_size) || !read(message.bytes.data(), message_size)) {
      return damaged("the file cannot be read further");
    }
    bytes_read += kHeaderBytes + channel_size + message_size;
    return message;
  }

 private:
  static constexpr auto kHeaderBytes = static_cast<std::int64_t>(kEventHeaderSize);

  bool read(void* target, std::size_t size) {
    return size == 0 || std::fread(target, 1, size, file_.get()) == size;
  }

  std::nullopt_t damaged(const std::string& what) {
    damage = "byte " + std::to_string(bytes_read) + ": " + what;
    return std::nullopt;
  }

  FileHandle file_;
};

}  // namespace

std::unique_ptr<LogReader::Source> open_event_log(FileHandle file, std::int64_t bytes_total) {
  return std::make_unique<EventLog>(std::move(file), bytes_total);
}

}  // namespace cairn::wire
