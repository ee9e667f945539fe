#include "wire/wire_check.hpp"

#include <array>
#include <cstdio>
#include <cstdlib>
#include <limits>

namespace cairn::wire {

namespace {

constexpr std::size_t kMaxFields = 64;

/// Length word and the final NUL.
constexpr std::uint64_t kMinStringSize = 5;

std::uint64_t size_of(char kind) {
  switch (kind) {
    case 'b':
      return 1;
    case 'h':
      return 2;
    case 'i':
    case 'f':
      return 4;
    case 'q':
    case 'd':
      return 8;
    default:
      return 0;
  }
}

bool is_integer(char kind) {
  return kind == 'b' || kind == 'h' || kind == 'i' || kind == 'q';
}

void expect(bool holds, std::string_view text) {
  if (!holds) {
    std::fprintf(stderr, "bad message signature before '%.*s'\n", static_cast<int>(text.size()),
                 text.data());
    std::abort();
  }
}

void skip_blanks(std::string_view* text) {
  while (!text->empty() && text->front() == ' ') {
    text->remove_prefix(1);
  }
}

std::uint64_t big_endian(const std::uint8_t* bytes, std::size_t size) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < size; ++i) {
    value = value << 8U | bytes[i];
  }
  return value;
}

}  // namespace

std::string_view to_string(DecodeError error) {
  switch (error) {
    case DecodeError::kTooShort:
      return "too short";
    case DecodeError::kTooBig:
      return "too big";
    case DecodeError::kWrongType:
      return "of another type";
    case DecodeError::kMalformed:
      return "malformed";
    case DecodeError::kTrailingBytes:
      return "followed by stray bytes";
  }
  return "unsound";
}

struct Signature::Cursor {
  const std::uint8_t* bytes = nullptr;
  std::size_t left = 0;

  bool skip(std::uint64_t size) {
    if (size > left) {
      return false;
    }
    bytes += size;
    left -= static_cast<std::size_t>(size);
    return true;
  }

  /// A length that counts the final NUL, then as many bytes.
  bool skip_string() {
    if (left < kMinStringSize) {
      return false;
    }
    const std::uint64_t length = big_endian(bytes, 4);
    skip(4);
    return length >= 1 && length <= left && bytes[length - 1] == 0 && skip(length);
  }
};

/// Values of the integer fields of one message, by number of the field.
struct Signature::Counts {
  std::array<std::int64_t, kMaxFields> values;

  [[nodiscard]] std::int64_t of(const Dimension& dimension) const {
    return dimension.is_fixed ? dimension.value : values[static_cast<std::size_t>(dimension.value)];
  }
};

Signature::Signature(std::string_view text) {
  root_ = parse(text, '\0');
  expect(text.empty(), text);
}

std::size_t Signature::parse(std::string_view& text, char end) {
  Message message;
  for (skip_blanks(&text); !text.empty() && text.front() != end; skip_blanks(&text)) {
    Field field{text.front(), 0, {}};
    text.remove_prefix(1);
    if (field.kind == '{') {
      field.nested = parse(text, '}');
      expect(!text.empty(), text);
      text.remove_prefix(1);
    }
    expect(field.kind == '{' || field.kind == 's' || size_of(field.kind) > 0, text);
    while (!text.empty() && text.front() == '[') {
      const Dimension dimension = parse_dimension(text, message.fields.size());
      const auto counter = static_cast<std::size_t>(dimension.value);
      expect(dimension.is_fixed || (is_integer(message.fields[counter].kind) &&
                                    message.fields[counter].dimensions.empty()),
             text);
      field.dimensions.push_back(dimension);
    }
    message.min_size += min_size_of(field);
    message.fields.push_back(std::move(field));
  }
  expect(!message.fields.empty() && message.fields.size() <= kMaxFields, text);
  messages_.push_back(std::move(message));
  return messages_.size() - 1;
}

Signature::Dimension Signature::parse_dimension(std::string_view& text, std::size_t num_fields) {
  Dimension dimension;
  text.remove_prefix(1);
  if (!text.empty() && text.front() == '=') {
    dimension.is_fixed = true;
    text.remove_prefix(1);
  }
  while (!text.empty() && text.front() >= '0' && text.front() <= '9') {
    dimension.value = dimension.value * 10 + (text.front() - '0');
    text.remove_prefix(1);
  }
  expect(!text.empty() && text.front() == ']', text);
  expect(dimension.is_fixed ? dimension.value > 0
                            : dimension.value < static_cast<std::int64_t>(num_fields),
         text);
  text.remove_prefix(1);
  return dimension;
}

std::uint64_t Signature::min_size_of(const Field& field) const {
  std::uint64_t size = field.kind == 's'   ? kMinStringSize
                       : field.kind == '{' ? messages_[field.nested].min_size
                                           : size_of(field.kind);
  for (const Dimension& dimension : field.dimensions) {
    size *= dimension.is_fixed ? static_cast<std::uint64_t>(dimension.value) : 0;
  }
  return size;
}

std::optional<DecodeError> Signature::check(const std::uint8_t* body, std::size_t size) const {
  Cursor cursor{body, size};
  if (!walk(cursor, messages_[root_])) {
    return DecodeError::kMalformed;
  }
  return cursor.left == 0 ? std::nullopt : std::optional(DecodeError::kTrailingBytes);
}

bool Signature::walk(Cursor& cursor, const Message& message) const {
  Counts counts;  // NOLINT: filled field by field; a count always lies before its array
  for (std::size_t i = 0; i < message.fields.size(); ++i) {
    const Field& field = message.fields[i];
    if (!field.dimensions.empty() || !is_integer(field.kind)) {
      if (!walk_array(cursor, field, counts)) {
        return false;
      }
      continue;
    }
    const auto size = static_cast<std::size_t>(size_of(field.kind));
    if (cursor.left < size) {
      return false;
    }
    // Shifted up and down again, which repeats the sign.
    const std::size_t unused_bits = 64 - 8 * size;
    counts.values[i] =
        static_cast<std::int64_t>(big_endian(cursor.bytes, size) << unused_bits) >> unused_bits;
    cursor.skip(size);
  }
  return true;
}

bool Signature::walk_array(Cursor& cursor, const Field& field, const Counts& counts) const {
  std::uint64_t count = 1;
  for (const Dimension& dimension : field.dimensions) {
    const std::int64_t length = counts.of(dimension);
    if (length < 0 || length > std::numeric_limits<std::int32_t>::max()) {
      return false;
    }
    // Every outer row is allocated by the decoder even where the inner ones are empty and cost no
    // bytes: so the bytes must pay for the rows, too.
    count *= static_cast<std::uint64_t>(length);
    if (count > cursor.left) {
      return false;
    }
  }
  if (field.kind == 's') {
    for (std::uint64_t i = 0; i < count; ++i) {
      if (count - i > cursor.left / kMinStringSize || !cursor.skip_string()) {
        return false;
      }
    }
    return true;
  }
  if (field.kind == '{') {
    const Message& nested = messages_[field.nested];
    if (nested.min_size > 0 && count > cursor.left / nested.min_size) {
      return false;
    }
    for (std::uint64_t i = 0; i < count; ++i) {
      if (!walk(cursor, nested)) {
        return false;
      }
    }
    return true;
  }
  return cursor.skip(count * size_of(field.kind));
}

std::uint64_t fingerprint_of(const std::uint8_t* bytes, std::size_t size) {
  return size < 8 ? 0 : big_endian(bytes, 8);
}

std::optional<DecodeError> check_message(const std::uint8_t* bytes,
                                         std::size_t size,
                                         std::size_t max_size,
                                         std::uint64_t fingerprint,
                                         const Signature& signature) {
  if (size < 8) {
    return DecodeError::kTooShort;
  }
  if (size > max_size || size > static_cast<std::size_t>(std::numeric_limits<int>::max())) {
    return DecodeError::kTooBig;
  }
  if (fingerprint_of(bytes, size) != fingerprint) {
    return DecodeError::kWrongType;
  }
  return signature.check(bytes + 8, size - 8);
}

}  // namespace cairn::wire
