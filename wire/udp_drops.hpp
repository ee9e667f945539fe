#pragma once

#include <cstdint>
#include <optional>

namespace cairn::wire {

/// Datagrams that the kernel has thrown away because the UDP sockets of this process were full,
/// since they were opened. Nothing where the kernel does not say.
[[nodiscard]] std::optional<std::int64_t> own_udp_drops();

}  // namespace cairn::wire
