#pragma once

#include <cstddef>
#include <cstdint>

#include "wire/expected.hpp"
#include "wire/wire_check.hpp"

namespace cairn::wire {

/// A document larger than this is refused, whatever it claims to be.
inline constexpr std::size_t kMaxDocumentBytes = std::size_t{512} << 20U;

/// As of zlib; the wire carries it as int32_t.
[[nodiscard]] std::int32_t crc32_of(const std::uint8_t* bytes, std::size_t size);
[[nodiscard]] inline std::int32_t crc32_of(const Bytes& bytes) {
  return crc32_of(bytes.data(), bytes.size());
}

/// One zstd frame that names the size of its content.
[[nodiscard]] Bytes compressed(const std::uint8_t* bytes, std::size_t size);
[[nodiscard]] inline Bytes compressed(const Bytes& bytes) {
  return compressed(bytes.data(), bytes.size());
}

/// The content of one zstd frame. What a frame claims is checked before anything is allocated.
/// @param max_size the content may have
[[nodiscard]] Expected<Bytes> decompressed(const std::uint8_t* bytes,
                                           std::size_t size,
                                           std::size_t max_size = kMaxDocumentBytes);

/// A snapshot document: the encoded message, compressed.
template <class T>
[[nodiscard]] Bytes to_document(const T& message) {
  return compressed(encode(message));
}

template <class T>
[[nodiscard]] Expected<T> from_document(const Bytes& document,
                                        std::size_t max_size = kMaxDocumentBytes) {
  const Expected<Bytes> bytes = decompressed(document.data(), document.size(), max_size);
  if (!bytes) {
    return Expected<T>::failure(bytes.error());
  }
  Expected<T, DecodeError> message = decode<T>(*bytes, max_size);
  if (!message) {
    return Expected<T>::failure("document is " + std::string(to_string(message.error())));
  }
  return *std::move(message);
}

}  // namespace cairn::wire
