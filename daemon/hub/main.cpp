// cairn-hub: the bus for machines without multicast.

#include <csignal>
#include <cstdio>

#include <CLI/CLI.hpp>

#include "wire/tcpq_hub.hpp"

namespace {

constexpr int kUsage = 64;
constexpr int kUnavailable = 69;

volatile std::sig_atomic_t stop_signal = 0;

void note_signal(int signal) {
  stop_signal = signal;
}

int run(const cairn::wire::TcpqHubOptions& options) {
  cairn::wire::Expected<cairn::wire::TcpqHub> hub = cairn::wire::TcpqHub::open(options);
  if (!hub) {
    std::fprintf(stderr, "cairn-hub: %s\n", hub.error().c_str());
    return kUnavailable;
  }
  // Who started us may wait for this line, and takes the url from it.
  std::printf("%s\n", hub->url().c_str());
  std::fflush(stdout);
  constexpr int kSignalCheck_ms = 200;
  while (stop_signal == 0) {
    if (!hub->serve(kSignalCheck_ms)) {
      std::fprintf(stderr, "cairn-hub: the listening socket has failed\n");
      return kUnavailable;
    }
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(
      "Passes LCM messages between the programs of this machine over TCP, for machines without\n"
      "multicast. Prints the url that every program needs as --lcm-url.",
      "cairn-hub");
  app.set_version_flag("--version", CAIRN_VERSION);
  cairn::wire::TcpqHubOptions options;
  app.add_option("--port", options.port, "TCP port on 127.0.0.1; 0 takes any free one")
      ->capture_default_str();
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : kUsage;
  }
  std::signal(SIGTERM, note_signal);
  std::signal(SIGINT, note_signal);
  return run(options);
}
