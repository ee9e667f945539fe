#include "wire/document.hpp"

#include <memory>

#include <zlib.h>
#include <zstd.h>

namespace cairn::wire {

namespace {

/// Fast: the tiles of a map are mostly runs of the same value.
constexpr int kCompressionLevel = 1;

/// Four bytes of a frame can stand for one block of 128 KiB, and never for more.
constexpr unsigned long long kMaxRatio = 32'768;

}  // namespace

std::int32_t crc32_of(const std::uint8_t* bytes, std::size_t size) {
  return static_cast<std::int32_t>(crc32_z(0, bytes, size));
}

Bytes compressed(const std::uint8_t* bytes, std::size_t size) {
  Bytes frame(ZSTD_compressBound(size));
  const std::unique_ptr<ZSTD_CCtx, decltype(&ZSTD_freeCCtx)> context(ZSTD_createCCtx(),
                                                                     &ZSTD_freeCCtx);
  ZSTD_CCtx_setParameter(context.get(), ZSTD_c_compressionLevel, kCompressionLevel);
  ZSTD_CCtx_setParameter(context.get(), ZSTD_c_checksumFlag, 1);  // Flipped bits are noticed.
  const std::size_t length = ZSTD_compress2(context.get(), frame.data(), frame.size(), bytes, size);
  frame.resize(ZSTD_isError(length) != 0 ? 0 : length);
  return frame;
}

Expected<Bytes> decompressed(const std::uint8_t* bytes, std::size_t size, std::size_t max_size) {
  const unsigned long long claimed = ZSTD_getFrameContentSize(bytes, size);
  if (claimed == ZSTD_CONTENTSIZE_ERROR || claimed == ZSTD_CONTENTSIZE_UNKNOWN) {
    return Expected<Bytes>::failure("document is no zstd frame that names its size");
  }
  if (claimed > max_size || claimed / kMaxRatio > size) {
    return Expected<Bytes>::failure("document claims " + std::to_string(claimed) +
                                    " bytes, allowed are " + std::to_string(max_size) +
                                    " and what its own " + std::to_string(size) + " can hold");
  }
  Bytes content(static_cast<std::size_t>(claimed));
  const std::size_t length = ZSTD_decompress(content.data(), content.size(), bytes, size);
  if (ZSTD_isError(length) != 0) {
    return Expected<Bytes>::failure(std::string("document is damaged: ") +
                                    ZSTD_getErrorName(length));
  }
  if (length != content.size()) {
    return Expected<Bytes>::failure("document is shorter than it claims");
  }
  return content;
}

}  // namespace cairn::wire
