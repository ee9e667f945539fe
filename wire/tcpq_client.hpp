#pragma once
// One connection of the hub; nobody else's business.

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <regex.h>

namespace cairn::wire {

/// A pattern for channel names, matched as a whole.
class ChannelPattern {
 public:
  /// Nothing where it is no regular expression, or one that could cost too much.
  [[nodiscard]] static std::unique_ptr<ChannelPattern> compile(const std::string& text);
  ~ChannelPattern() { ::regfree(&regex_); }
  ChannelPattern(const ChannelPattern&) = delete;
  ChannelPattern& operator=(const ChannelPattern&) = delete;

  [[nodiscard]] bool matches(const std::string& channel) const;
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  ChannelPattern() = default;
  std::string text_;
  regex_t regex_{};
};

/// What a client says, in LCM's tcpq protocol.
struct TcpqFrame {
  enum class Kind : std::uint32_t { kPublish = 1, kSubscribe = 2, kUnsubscribe = 3 };
  Kind kind = Kind::kPublish;
  std::string channel;  ///< A pattern, when subscribing.
  std::string data;
};

/// A client's socket with what has been read and what waits to be written.
class TcpqClient {
 public:
  /// Takes the socket over, which does not block, and greets.
  explicit TcpqClient(int fd);
  ~TcpqClient();
  TcpqClient(const TcpqClient&) = delete;
  TcpqClient& operator=(const TcpqClient&) = delete;

  /// Reads once from the socket.
  void receive();
  /// The next frame that is there as a whole.
  [[nodiscard]] std::optional<TcpqFrame> next_frame(std::size_t max_message_bytes);

  void subscribe(const std::string& pattern);
  void unsubscribe(const std::string& pattern);
  [[nodiscard]] bool wants(const std::string& channel);

  /// @return false where more than `max_queued_bytes` wait already: the message is dropped
  bool queue(std::shared_ptr<const std::string> bytes, std::size_t max_queued_bytes);
  /// Writes as much as the socket takes.
  void flush();

  [[nodiscard]] int fd() const { return fd_; }
  [[nodiscard]] bool has_output() const { return !output_.empty(); }
  /// The connection is over, or has broken the protocol.
  [[nodiscard]] bool is_dead() const { return is_dead_; }

 private:
  [[nodiscard]] std::string_view unread() const;
  [[nodiscard]] bool read_greeting();

  int fd_;
  std::string input_;
  std::size_t used_ = 0;  ///< Bytes of the input that have been taken.
  std::deque<std::shared_ptr<const std::string>> output_;
  std::size_t written_ = 0;  ///< Of the first of them.
  std::size_t queued_bytes_ = 0;
  std::vector<std::unique_ptr<ChannelPattern>> patterns_;
  std::map<std::string, bool> wanted_;  ///< What the patterns said about channels seen.
  bool has_greeted_ = false;
  bool is_dead_ = false;
};

/// The bytes of a message for a client.
[[nodiscard]] std::string to_bytes(const TcpqFrame& frame);

}  // namespace cairn::wire
