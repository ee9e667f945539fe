#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace cairn::clients {

/// Name of the type of an encoded message by its fingerprint, "cairn_lcm.laser_scan_t"; the
/// fingerprint in hexadecimal where the type is none of ours or of those we take as input.
[[nodiscard]] std::string message_type_of(const std::vector<std::uint8_t>& bytes);

}  // namespace cairn::clients
