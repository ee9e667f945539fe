#include "wire/snapshot_assembler.hpp"

#include "wire/document.hpp"

namespace cairn::wire {

namespace {

/// Smaller chunks than this nobody makes; it bounds what a forged chunk can make us allocate.
constexpr std::int64_t kSmallestChunk = 256;
constexpr std::int64_t kMaxSnapshotBytes = std::int64_t{256} << 20U;

bool is_sound(const cairn_lcm::snapshot_chunk_t& chunk) {
  return chunk.snapshot_id > 0 && chunk.revision >= 0 && chunk.total_bytes > 0 &&
         chunk.total_bytes <= kMaxSnapshotBytes && chunk.num_chunks > 0 &&
         (chunk.num_chunks - 1) * kSmallestChunk < chunk.total_bytes && chunk.chunk >= 0 &&
         chunk.chunk < chunk.num_chunks && chunk.num_bytes > 0 && chunk.offset_bytes >= 0 &&
         std::int64_t{chunk.offset_bytes} + chunk.num_bytes <= chunk.total_bytes;
}

}  // namespace

std::optional<Bytes> SnapshotAssembler::add(std::int64_t now_us,
                                            const cairn_lcm::snapshot_chunk_t& chunk) {
  if (!is_sound(chunk)) {
    return std::nullopt;
  }
  const bool has_stalled = now_us - progress_us_ > kStalledUs;
  if (!is_collecting() || (chunk.snapshot_id > snapshot_id_ && has_stalled)) {
    begin(chunk);
  }
  if (!belongs(chunk)) {
    return std::nullopt;
  }
  Bytes& slot = chunks_[static_cast<std::size_t>(chunk.chunk)];
  if (!slot.empty() || received_bytes_ + chunk.num_bytes > total_bytes_) {
    return std::nullopt;
  }
  received_bytes_ += chunk.num_bytes;
  slot = chunk.data;
  --num_missing_;
  progress_us_ = now_us;
  return num_missing_ == 0 ? finish() : std::nullopt;
}

void SnapshotAssembler::begin(const cairn_lcm::snapshot_chunk_t& chunk) {
  snapshot_id_ = chunk.snapshot_id;
  map_id_ = chunk.map_id;
  revision_ = chunk.revision;
  total_bytes_ = chunk.total_bytes;
  total_crc32_ = chunk.total_crc32;
  num_missing_ = static_cast<std::size_t>(chunk.num_chunks);
  received_bytes_ = 0;
  chunks_.assign(num_missing_, {});
}

bool SnapshotAssembler::belongs(const cairn_lcm::snapshot_chunk_t& chunk) const {
  return chunk.snapshot_id == snapshot_id_ && chunk.map_id == map_id_ &&
         chunk.revision == revision_ && chunk.total_bytes == total_bytes_ &&
         chunk.total_crc32 == total_crc32_ &&
         static_cast<std::size_t>(chunk.num_chunks) == chunks_.size();
}

// Chunks follow each other without gaps, so joining them gives the document; the checksum sees to
// the rest.
std::optional<Bytes> SnapshotAssembler::finish() {
  Bytes document;
  document.reserve(static_cast<std::size_t>(received_bytes_));
  for (const Bytes& chunk : chunks_) {
    document.insert(document.end(), chunk.begin(), chunk.end());
  }
  const bool is_whole = document.size() == static_cast<std::size_t>(total_bytes_) &&
                        crc32_of(document) == total_crc32_;
  clear();
  return is_whole ? std::optional(std::move(document)) : std::nullopt;
}

void SnapshotAssembler::clear() {
  snapshot_id_ = 0;
  num_missing_ = 0;
  received_bytes_ = 0;
  chunks_ = {};
}

double SnapshotAssembler::progress() const {
  return chunks_.empty()
             ? 0.0
             : 1.0 - static_cast<double>(num_missing_) / static_cast<double>(chunks_.size());
}

std::vector<std::int32_t> SnapshotAssembler::missing(std::size_t most) const {
  std::vector<std::int32_t> missing;
  for (std::size_t i = 0; i < chunks_.size() && missing.size() < most; ++i) {
    if (chunks_[i].empty()) {
      missing.push_back(static_cast<std::int32_t>(i));
    }
  }
  return missing;
}

}  // namespace cairn::wire
