#pragma once

#include <functional>
#include <string>
#include <utility>

#include "clients/common/failure.hpp"
#include "wire/bus.hpp"
#include "wire/signatures.hpp"

namespace cairn::clients {

/// Largest message taken from the bus: a topology travels as one message up to 60 kB, chunks and
/// deltas up to 16 kB.
inline constexpr std::size_t kMaxMessageBytes = 256'000;
/// Messages LCM keeps for us. A snapshot comes in a burst; a few thousand chunks of it fit.
inline constexpr int kQueueCapacity = 4'096;

/// Subscribes to the messages of one type on one channel. Unsound bytes are passed over: the daemon
/// counts what is wrong on the bus, and whatever is missing is asked for again.
/// Throws Failure(kConfiguration) where LCM refuses.
template <typename Message, typename Use>
void subscribe(wire::Bus& bus, const std::string& channel, Use use) {
  const auto handler = [use = std::move(use)](const wire::Received& received) {
    const auto message = wire::decode<Message>(received.bytes, received.size, kMaxMessageBytes);
    if (message) {
      use(*message);
    }
  };
  if (!bus.subscribe(channel, kQueueCapacity, handler)) {
    throw Failure(ExitCode::kConfiguration, "cannot subscribe to " + channel + " on " + bus.url());
  }
}

}  // namespace cairn::clients
