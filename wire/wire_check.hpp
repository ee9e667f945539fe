#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "wire/expected.hpp"

namespace cairn::wire {

using Bytes = std::vector<std::uint8_t>;

/// Why bytes are no message.
enum class DecodeError {
  kTooShort,       ///< Less than a fingerprint.
  kTooBig,         ///< More than the channel allows.
  kWrongType,      ///< The fingerprint of another type.
  kMalformed,      ///< A count, string or length that the bytes do not pay for.
  kTrailingBytes,  ///< More bytes than the message has.
};

[[nodiscard]] std::string_view to_string(DecodeError error);

/// The fields of a message type in the order of the wire, checked against bytes before the
/// generated decoder may see them. That decoder trusts every count: seventy bytes can make it
/// allocate gigabytes, throw, or read past the end.
///
/// One letter a field: b h i q for integers of 1, 2, 4, 8 bytes, f float, d double, s string,
/// {...} a nested message. An array follows its letter: x[2] has the count in field 2 of the same
/// message (counting from 0), x[=9] always nine, d[4][=3] two dimensions. Blanks are free:
/// planar_lidar_t of bot_core is "q i f[1] i f[3] f f".
class Signature {
 public:
  /// Aborts on a text that breaks the rules above: signatures are part of the program.
  explicit Signature(std::string_view text);

  /// Whether `body`, the bytes behind the fingerprint, is exactly one message: every count not
  /// negative and payable by the bytes that are left, every string with its final NUL, nothing
  /// left over. Allocates nothing.
  [[nodiscard]] std::optional<DecodeError> check(const std::uint8_t* body, std::size_t size) const;

 private:
  struct Dimension {
    bool is_fixed = false;
    std::int64_t value = 0;  ///< The count itself, or the number of the field that holds it.
  };
  struct Field {
    char kind = 0;
    std::size_t nested = 0;  ///< Of kind '{': which message.
    std::vector<Dimension> dimensions;
  };
  struct Message {
    std::vector<Field> fields;
    std::uint64_t min_size = 0;  ///< Bytes on the wire with all arrays empty.
  };
  struct Cursor;
  struct Counts;

  std::size_t parse(std::string_view& text, char end);
  static Dimension parse_dimension(std::string_view& text, std::size_t num_fields);
  [[nodiscard]] std::uint64_t min_size_of(const Field& field) const;
  [[nodiscard]] bool walk(Cursor& cursor, const Message& message) const;
  [[nodiscard]] bool walk_array(Cursor& cursor, const Field& field, const Counts& counts) const;

  std::vector<Message> messages_;
  std::size_t root_ = 0;
};

/// First eight bytes of a message, which name its type; 0 where there are fewer.
[[nodiscard]] std::uint64_t fingerprint_of(const std::uint8_t* bytes, std::size_t size);

/// The signature of a message type; signatures.hpp has it for every type of ours.
template <class T>
inline constexpr std::string_view kSignatureText;

template <class T>
[[nodiscard]] const Signature& signature_of() {
  static_assert(!kSignatureText<T>.empty(), "include wire/signatures.hpp");
  static const Signature signature(kSignatureText<T>);
  return signature;
}

/// Checks all but the decoder's own work: sizes, type and signature.
[[nodiscard]] std::optional<DecodeError> check_message(const std::uint8_t* bytes,
                                                       std::size_t size,
                                                       std::size_t max_size,
                                                       std::uint64_t fingerprint,
                                                       const Signature& signature);

/// The only way from bytes to a message in daemon and clients: a fresh object each time, since the
/// generated decoder leaves an array of count 0 as it was.
/// @param max_size bytes the channel allows
template <class T>
[[nodiscard]] Expected<T, DecodeError> decode(const std::uint8_t* bytes,
                                              std::size_t size,
                                              std::size_t max_size) noexcept {
  using Decoded = Expected<T, DecodeError>;
  try {
    const auto refused = check_message(bytes, size, max_size,
                                       static_cast<std::uint64_t>(T::getHash()), signature_of<T>());
    if (refused) {
      return Decoded::failure(*refused);
    }
    T message{};
    const int length = static_cast<int>(size);
    if (message.decode(bytes, 0, length) != length) {
      return Decoded::failure(DecodeError::kMalformed);
    }
    return message;
  } catch (...) {
    // Out of memory, at most: the sizes were checked. LCM calls us from C, nothing may be thrown.
    return Decoded::failure(DecodeError::kTooBig);
  }
}

template <class T>
[[nodiscard]] Expected<T, DecodeError> decode(const Bytes& bytes, std::size_t max_size) noexcept {
  return decode<T>(bytes.data(), bytes.size(), max_size);
}

/// The bytes of a message, fingerprint first.
/// @pre every count field equals the size of its arrays: the generated encoder trusts it
template <class T>
[[nodiscard]] Bytes encode(const T& message) {
  Bytes bytes(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  return bytes;
}

}  // namespace cairn::wire
