#include "wire/tcpq_client.hpp"

#include <algorithm>
#include <array>
#include <cerrno>

#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <unistd.h>

#include "wire/bus.hpp"

namespace cairn::wire {

namespace {

// Both sides greet with a word of their own and the version.
constexpr std::uint32_t kServerMagic = 0x287617FA;
constexpr std::uint32_t kClientMagic = 0x287617FB;
constexpr std::uint32_t kVersion = 0x0100;
constexpr std::size_t kGreetingSize = 8;
constexpr std::size_t kLongestPattern = 256;
constexpr std::size_t kMostPatterns = 1000;
constexpr std::size_t kMostRemembered = 10'000;

std::uint32_t word_at(std::string_view bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    value = value << 8U | static_cast<std::uint8_t>(bytes[at + i]);
  }
  return value;
}

void put_word(std::size_t value, std::string* bytes) {
  for (const unsigned shift : {24U, 16U, 8U, 0U}) {
    bytes->push_back(static_cast<char>(value >> shift & 0xFFU));
  }
}

}  // namespace

std::unique_ptr<ChannelPattern> ChannelPattern::compile(const std::string& text) {
  // Repetition counts can be nested until compiling takes all memory; nobody needs them here.
  bool is_escaped = false;
  for (const char letter : text) {
    if ((letter == '{' && !is_escaped) || letter == '\0') {
      return nullptr;
    }
    is_escaped = letter == '\\' && !is_escaped;
  }
  std::unique_ptr<ChannelPattern> pattern(new ChannelPattern);
  pattern->text_ = text;
  const std::string whole = "^(" + text + ")$";
  if (::regcomp(&pattern->regex_, whole.c_str(), REG_EXTENDED | REG_NOSUB) != 0) {
    pattern->regex_ = {};
    return nullptr;
  }
  return pattern;
}

bool ChannelPattern::matches(const std::string& channel) const {
  return ::regexec(&regex_, channel.c_str(), 0, nullptr, 0) == 0;
}

std::string to_bytes(const TcpqFrame& frame) {
  std::string bytes;
  bytes.reserve(12 + frame.channel.size() + frame.data.size());
  put_word(static_cast<std::size_t>(frame.kind), &bytes);
  put_word(frame.channel.size(), &bytes);
  bytes += frame.channel;
  put_word(frame.data.size(), &bytes);
  bytes += frame.data;
  return bytes;
}

TcpqClient::TcpqClient(int fd) : fd_(fd) {
  const int on = 1;
  ::setsockopt(fd_, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
  auto greeting = std::make_shared<std::string>();
  put_word(kServerMagic, greeting.get());
  put_word(kVersion, greeting.get());
  queue(std::move(greeting), kGreetingSize);
  flush();
}

TcpqClient::~TcpqClient() {
  ::close(fd_);
}

void TcpqClient::receive() {
  constexpr std::size_t kBlock = std::size_t{1} << 18U;
  if (used_ == input_.size() || used_ > kBlock) {
    input_.erase(0, used_);
    used_ = 0;
  }
  const std::size_t size = input_.size();
  input_.resize(size + kBlock);
  const ssize_t length = ::recv(fd_, input_.data() + size, kBlock, 0);
  const int error = errno;
  input_.resize(size + static_cast<std::size_t>(std::max<ssize_t>(length, 0)));
  is_dead_ = is_dead_ || length == 0 || (length < 0 && error != EAGAIN && error != EINTR);
  // LCM writes a message as five small segments and waits for the acknowledgement of each.
  const int on = 1;
  ::setsockopt(fd_, IPPROTO_TCP, TCP_QUICKACK, &on, sizeof on);
}

std::string_view TcpqClient::unread() const {
  return std::string_view(input_).substr(used_);
}

bool TcpqClient::read_greeting() {
  if (!has_greeted_ && unread().size() >= kGreetingSize) {
    is_dead_ = word_at(unread(), 0) != kClientMagic;
    has_greeted_ = true;
    used_ += kGreetingSize;
  }
  return has_greeted_ && !is_dead_;
}

std::optional<TcpqFrame> TcpqClient::next_frame(std::size_t max_message_bytes) {
  if (!read_greeting() || unread().size() < 8) {
    return std::nullopt;
  }
  const std::string_view bytes = unread();
  const std::uint32_t kind = word_at(bytes, 0);
  const std::size_t channel_size = word_at(bytes, 4);
  const bool is_message = kind == static_cast<std::uint32_t>(TcpqFrame::Kind::kPublish);
  if (kind < 1 || kind > 3 || channel_size > (is_message ? kMaxChannelLength : kLongestPattern)) {
    is_dead_ = true;
    return std::nullopt;
  }
  std::size_t size = 8 + channel_size;
  std::size_t data_size = 0;
  if (is_message && bytes.size() >= size + 4) {
    data_size = word_at(bytes, size);
    is_dead_ = data_size > max_message_bytes;
  }
  size += is_message ? 4 + data_size : 0;
  if (is_dead_ || bytes.size() < size) {
    return std::nullopt;
  }
  used_ += size;
  return TcpqFrame{static_cast<TcpqFrame::Kind>(kind), std::string(bytes.substr(8, channel_size)),
                   std::string(bytes.substr(size - data_size, data_size))};
}

void TcpqClient::subscribe(const std::string& pattern) {
  std::unique_ptr<ChannelPattern> compiled = ChannelPattern::compile(pattern);
  if (compiled && patterns_.size() < kMostPatterns) {
    patterns_.push_back(std::move(compiled));
    wanted_.clear();
  }
}

void TcpqClient::unsubscribe(const std::string& pattern) {
  const auto known = std::find_if(patterns_.begin(), patterns_.end(),
                                  [&pattern](const auto& held) { return held->text() == pattern; });
  if (known != patterns_.end()) {
    patterns_.erase(known);
    wanted_.clear();
  }
}

bool TcpqClient::wants(const std::string& channel) {
  const auto known = wanted_.find(channel);
  if (known != wanted_.end()) {
    return known->second;
  }
  const bool is_wanted =
      std::any_of(patterns_.begin(), patterns_.end(),
                  [&channel](const auto& pattern) { return pattern->matches(channel); });
  if (wanted_.size() < kMostRemembered) {
    wanted_.emplace(channel, is_wanted);
  }
  return is_wanted;
}

bool TcpqClient::queue(std::shared_ptr<const std::string> bytes, std::size_t max_queued_bytes) {
  if (queued_bytes_ + bytes->size() > max_queued_bytes) {
    return false;
  }
  queued_bytes_ += bytes->size();
  output_.push_back(std::move(bytes));
  return true;
}

void TcpqClient::flush() {
  while (!output_.empty() && !is_dead_) {
    const std::string& first = *output_.front();
    const ssize_t length =
        ::send(fd_, first.data() + written_, first.size() - written_, MSG_NOSIGNAL);
    if (length < 0) {
      is_dead_ = errno != EAGAIN && errno != EINTR;
      return;
    }
    written_ += static_cast<std::size_t>(length);
    if (written_ == first.size()) {
      queued_bytes_ -= first.size();
      written_ = 0;
      output_.pop_front();
    }
  }
}

}  // namespace cairn::wire
