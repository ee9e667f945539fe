#include "wire/bus.hpp"

#include <cerrno>
#include <cstdlib>
#include <system_error>

#include <arpa/inet.h>
#include <lcm/lcm.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

namespace cairn::wire {

namespace {

constexpr std::string_view kUdp = "udpm://";
constexpr std::string_view kTcp = "tcpq://";
constexpr std::uint16_t kDefaultUdpPort = 7667;
constexpr std::uint16_t kDefaultTcpPort = 7700;

/// What a person can do about a machine without a route to the group.
std::string route_advice(const std::string& group) {
  return "type: sudo ip route add " + group +
         "/32 dev lo src 127.0.0.1\nor run cairn-hub and give every program --lcm-url " +
         std::string(kHubUrl);
}

struct Address {
  std::string host;
  std::uint16_t port = 0;
};

/// Host and port behind the scheme of an LCM url; what is not said stays as in `address`.
Address address_of(std::string_view url, Address address) {
  url.remove_prefix(url.find("//") + 2);
  url = url.substr(0, url.find('?'));
  const std::size_t colon = url.find(':');
  const std::string_view host = url.substr(0, colon);
  if (!host.empty()) {
    address.host = host;
  }
  if (colon != std::string_view::npos) {
    const int port = std::atoi(std::string(url.substr(colon + 1)).c_str());  // NOLINT: 0 is refused
    address.port = static_cast<std::uint16_t>(port > 0 && port < 65536 ? port : 0);
  }
  return address;
}

/// Whether a socket can be connected there. For UDP this asks the routing table alone, and spares
/// LCM's own failing, which writes garbage to stderr.
/// @return errno; 0 where all is well, or where the host is a name that LCM may resolve
int probe(const Address& address, int socket_type) {
  sockaddr_in target{};
  target.sin_family = AF_INET;
  target.sin_port = htons(address.port);
  if (inet_pton(AF_INET, address.host.c_str(), &target.sin_addr) != 1) {
    return 0;
  }
  const int fd = ::socket(AF_INET, socket_type | SOCK_CLOEXEC, 0);
  if (fd < 0) {
    return errno;
  }
  const int failed = ::connect(fd, reinterpret_cast<const sockaddr*>(&target),  // NOLINT: sockets
                               sizeof target);
  const int error = failed == 0 ? 0 : errno;
  ::close(fd);
  return error;
}

/// Empty where the bus can be reached.
std::string reachability_complaint(const std::string& url) {
  const auto because = [&url](int error) {
    return "no LCM bus at " + url + ": " + std::generic_category().message(error);
  };
  if (url.starts_with(kUdp)) {
    const Address group = address_of(url, {"239.255.76.67", kDefaultUdpPort});
    const int error = probe(group, SOCK_DGRAM);
    return error == 0 ? "" : because(error) + "\n" + route_advice(group.host);
  }
  if (url.starts_with(kTcp)) {
    const int error = probe(address_of(url, {"127.0.0.1", kDefaultTcpPort}), SOCK_STREAM);
    return error == 0 ? "" : because(error) + "\nstart the hub first: cairn-hub";
  }
  return "";
}

std::string escaped(const std::string& channel) {
  static const std::string kSpecial = "\\^$.|?*+()[]{}";
  std::string pattern;
  for (const char letter : channel) {
    if (kSpecial.find(letter) != std::string::npos) {
      pattern += '\\';
    }
    pattern += letter;
  }
  return pattern;
}

}  // namespace

std::string effective_url(const std::string& url) {
  if (!url.empty()) {
    return url;
  }
  const char* const chosen = std::getenv("LCM_DEFAULT_URL");  // NOLINT(concurrency-mt-unsafe)
  return chosen != nullptr && *chosen != '\0' ? chosen : std::string(kDefaultUrl);
}

Expected<std::unique_ptr<Bus>> Bus::open(const std::string& url) {
  using Opened = Expected<std::unique_ptr<Bus>>;
  const std::string effective = effective_url(url);
  const std::string complaint = reachability_complaint(effective);
  if (!complaint.empty()) {
    return Opened::failure(complaint);
  }
  lcm_t* const lcm = lcm_create(effective.c_str());
  if (lcm == nullptr) {
    return Opened::failure("LCM cannot open '" + effective + "': is it a valid LCM url?");
  }
  std::unique_ptr<Bus> bus(new Bus(lcm, effective));
  // Asked early, since over UDP this runs LCM's self test: a message to itself, up to ten seconds.
  if (bus->fileno() < 0) {
    const bool is_udp = effective.starts_with(kUdp);
    return Opened::failure("LCM's self test failed on " + effective +
                           (is_udp
                                ? ": multicast does not come back to this machine\n" +
                                      route_advice(address_of(effective, {"239.255.76.67", 0}).host)
                                : std::string()));
  }
  return bus;
}

Bus::~Bus() {
  lcm_destroy(lcm_);
}

bool Bus::subscribe(const std::string& channel, int queue_capacity, Handler handler) {
  // LCM takes a regular expression.
  return subscribe_to_pattern(escaped(channel), queue_capacity, std::move(handler));
}

bool Bus::subscribe_to_all(int queue_capacity, Handler handler) {
  return subscribe_to_pattern(".*", queue_capacity, std::move(handler));
}

bool Bus::subscribe_to_pattern(const std::string& pattern, int queue_capacity, Handler handler) {
  auto subscription = std::make_unique<Subscription>(Subscription{this, std::move(handler)});
  lcm_subscription_t* const accepted =
      lcm_subscribe(lcm_, pattern.c_str(), &Bus::receive, subscription.get());
  if (accepted == nullptr) {
    return false;
  }
  lcm_subscription_set_queue_capacity(accepted, queue_capacity);
  subscriptions_.push_back(std::move(subscription));
  return true;
}

// An exception that left here would leave LCM locked for ever.
void Bus::receive(const lcm_recv_buf_t* buffer, const char* channel, void* user) noexcept {
  auto* const subscription = static_cast<Subscription*>(user);
  try {
    subscription->handler({channel, static_cast<const std::uint8_t*>(buffer->data),
                           static_cast<std::size_t>(buffer->data_size), buffer->recv_utime});
  } catch (...) {
    ++subscription->bus->failed_handlers_;
  }
}

bool Bus::publish(const std::string& channel, const Bytes& bytes) {
  if (channel.empty() || channel.size() > kMaxChannelLength) {
    return false;
  }
  const std::lock_guard<std::mutex> lock(publish_mutex_);
  return lcm_publish(lcm_, channel.c_str(), bytes.data(), static_cast<unsigned>(bytes.size())) == 0;
}

// Not lcm_handle_timeout: it uses select(), and aborts on a lost connection and on large
// descriptors.
int Bus::handle(int timeout_ms, int max_messages) {
  int handled = 0;
  for (; handled < max_messages; ++handled) {
    pollfd waiting{fileno(), POLLIN, 0};
    if (waiting.fd < 0) {
      return -1;
    }
    if (::poll(&waiting, 1, handled == 0 ? timeout_ms : 0) <= 0) {
      break;
    }
    if (lcm_handle(lcm_) < 0) {
      return -1;
    }
  }
  return handled;
}

bool Bus::reconnect() {
  // Publishing connects again, and repeats the subscriptions; lcm_handle would, too, but then waits
  // for a message. Nobody listens to LCM's own channel of self tests.
  return fileno() >= 0 || (publish("LCM_SELF_TEST", Bytes{0}) && fileno() >= 0);
}

int Bus::fileno() {
  return lcm_get_fileno(lcm_);
}

}  // namespace cairn::wire
