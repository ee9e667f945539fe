#pragma once

#include <cinttypes>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <string>

#include "base/result.hpp"
#include "wire/bus.hpp"
#include "wire/signatures.hpp"
#include "wire/wire_check.hpp"

namespace cairn {

/// How a fingerprint is shown to a person, and how lcm-gen's users know it.
[[nodiscard]] inline std::string fingerprint_text(std::uint64_t fingerprint) {
  char text[sizeof "0x0123456789abcdef"] = {};
  std::snprintf(text, sizeof text, "0x%016" PRIx64, fingerprint);
  return text;
}

/// Bytes off the bus that may be one of several message types.
template <class Value>
struct ByFingerprint {
  const std::uint8_t* bytes = nullptr;
  std::size_t size = 0;
  std::size_t max_size = 0;

  /// Decodes as the type the fingerprint names and converts.
  template <class... Messages, class Convert>
  [[nodiscard]] Result<Value> as(const Convert& convert) const {
    std::optional<Result<Value>> converted;
    (try_as<Messages>(convert, &converted) || ...);
    if (converted) {
      return *std::move(converted);
    }
    const std::uint64_t fingerprint = wire::fingerprint_of(bytes, size);
    return size < sizeof fingerprint
               ? Error{ErrorCode::kMalformed, "message without a fingerprint"}
               : Error{ErrorCode::kNotFound,
                       "message of unknown type " + fingerprint_text(fingerprint)};
  }

 private:
  template <class Message, class Convert>
  bool try_as(const Convert& convert, std::optional<Result<Value>>* converted) const {
    if (wire::fingerprint_of(bytes, size) != static_cast<std::uint64_t>(Message::getHash())) {
      return false;
    }
    const auto message = wire::decode<Message>(bytes, size, max_size);
    if (message) {
      *converted = convert(*message);
    } else {
      *converted = Error{ErrorCode::kMalformed, std::string(Message::getTypeName()) + " is " +
                                                    std::string(to_string(message.error()))};
    }
    return true;
  }
};

}  // namespace cairn
