#include "wire/tcpq_hub.hpp"

#include <cerrno>
#include <system_error>
#include <vector>

#include <arpa/inet.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include "wire/tcpq_client.hpp"

namespace cairn::wire {

class TcpqHub::Impl {
 public:
  Impl(int fd, std::uint16_t port, const TcpqHubOptions& options)
      : fd_(fd), port_(port), options_(options) {}
  ~Impl() { ::close(fd_); }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  bool serve(int timeout_ms) {
    std::vector<pollfd> waiting{{fd_, POLLIN, 0}};
    for (const auto& client : clients_) {
      const int events = POLLIN | (client->has_output() ? POLLOUT : 0);
      waiting.push_back({client->fd(), static_cast<short>(events), 0});
    }
    if (::poll(waiting.data(), waiting.size(), timeout_ms) < 0) {
      return errno == EINTR;
    }
    for (std::size_t i = 1; i < waiting.size(); ++i) {
      serve_client(*clients_[i - 1], waiting[i].revents);
    }
    std::erase_if(clients_, [](const auto& client) { return client->is_dead(); });
    if ((waiting[0].revents & POLLIN) != 0) {
      accept_client();
    }
    return (waiting[0].revents & (POLLERR | POLLNVAL)) == 0;
  }

  [[nodiscard]] std::uint16_t port() const { return port_; }
  [[nodiscard]] std::size_t num_clients() const { return clients_.size(); }
  [[nodiscard]] std::uint64_t passed() const { return passed_; }
  [[nodiscard]] std::uint64_t dropped() const { return dropped_; }

 private:
  void serve_client(TcpqClient& client, short events) {
    if ((events & POLLOUT) != 0) {
      client.flush();
    }
    if ((events & (POLLIN | POLLHUP | POLLERR)) == 0) {
      return;
    }
    client.receive();
    while (const std::optional<TcpqFrame> frame = client.next_frame(options_.max_message_bytes)) {
      switch (frame->kind) {
        case TcpqFrame::Kind::kSubscribe:
          client.subscribe(frame->channel);
          break;
        case TcpqFrame::Kind::kUnsubscribe:
          client.unsubscribe(frame->channel);
          break;
        case TcpqFrame::Kind::kPublish:
          pass_on(*frame);
      }
    }
  }

  // The publisher, too, gets what it has subscribed to.
  void pass_on(const TcpqFrame& frame) {
    std::shared_ptr<const std::string> bytes;
    for (const auto& client : clients_) {
      if (client->is_dead() || !client->wants(frame.channel)) {
        continue;
      }
      if (!bytes) {
        bytes = std::make_shared<const std::string>(to_bytes(frame));
      }
      ++(client->queue(bytes, options_.max_queued_bytes) ? passed_ : dropped_);
      client->flush();
    }
  }

  void accept_client() {
    const int fd = ::accept4(fd_, nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC);
    if (fd < 0) {
      return;
    }
    if (clients_.size() >= options_.max_clients) {
      ::close(fd);
      return;
    }
    clients_.push_back(std::make_unique<TcpqClient>(fd));
  }

  int fd_;
  std::uint16_t port_;
  TcpqHubOptions options_;
  std::vector<std::unique_ptr<TcpqClient>> clients_;
  std::uint64_t passed_ = 0;
  std::uint64_t dropped_ = 0;
};

TcpqHub::TcpqHub(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
TcpqHub::TcpqHub(TcpqHub&& other) noexcept = default;
TcpqHub& TcpqHub::operator=(TcpqHub&& other) noexcept = default;
TcpqHub::~TcpqHub() = default;

Expected<TcpqHub> TcpqHub::open(const TcpqHubOptions& options) {
  const auto failed = [&options](int fd) {
    const std::string reason = std::generic_category().message(errno);
    if (fd >= 0) {
      ::close(fd);
    }
    return Expected<TcpqHub>::failure("cannot listen on 127.0.0.1:" + std::to_string(options.port) +
                                      ": " + reason);
  };
  const int fd = ::socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  if (fd < 0) {
    return failed(fd);
  }
  const int on = 1;
  ::setsockopt(fd, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(options.port);
  // Nobody outside of this machine may speak on the bus.
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  auto* const generic = reinterpret_cast<sockaddr*>(&address);  // NOLINT: sockets
  socklen_t size = sizeof address;
  constexpr int kBacklog = 32;
  if (::bind(fd, generic, size) != 0 || ::listen(fd, kBacklog) != 0 ||
      ::getsockname(fd, generic, &size) != 0) {
    return failed(fd);
  }
  return TcpqHub(std::make_unique<Impl>(fd, ntohs(address.sin_port), options));
}

std::string TcpqHub::url() const {
  return "tcpq://127.0.0.1:" + std::to_string(impl_->port());
}
bool TcpqHub::serve(int timeout_ms) {
  return impl_->serve(timeout_ms);
}
std::size_t TcpqHub::num_clients() const {
  return impl_->num_clients();
}
std::uint64_t TcpqHub::messages_passed() const {
  return impl_->passed();
}
std::uint64_t TcpqHub::messages_dropped() const {
  return impl_->dropped();
}

}  // namespace cairn::wire
