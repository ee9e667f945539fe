#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <cairn_lcm/snapshot_chunk_t.hpp>

#include "wire/wire_check.hpp"

namespace cairn::wire {

/// Collects the chunks of one snapshot, in any order, until all of it is there.
class SnapshotAssembler {
 public:
  /// A snapshot that brings nothing new for this long may be left for a newer one.
  static constexpr std::int64_t kStalledUs = 1'000'000;

  /// Takes a chunk; begins with its snapshot where none is being collected, or where the one in
  /// hand has stalled and this one is newer. Chunks that contradict themselves are ignored.
  /// @return the whole document, once its last chunk is there and the checksum agrees
  std::optional<Bytes> add(std::int64_t now_us, const cairn_lcm::snapshot_chunk_t& chunk);
  /// Forgets what has been collected.
  void clear();

  [[nodiscard]] bool is_collecting() const { return snapshot_id_ != 0; }
  [[nodiscard]] std::int64_t snapshot_id() const { return snapshot_id_; }
  [[nodiscard]] std::int64_t map_id() const { return map_id_; }
  [[nodiscard]] std::int64_t revision() const { return revision_; }
  /// When the last new chunk came.
  [[nodiscard]] std::int64_t progress_us() const { return progress_us_; }
  /// Share of the chunks that are there, in [0, 1].
  [[nodiscard]] double progress() const;
  [[nodiscard]] std::vector<std::int32_t> missing(std::size_t most) const;

 private:
  void begin(const cairn_lcm::snapshot_chunk_t& chunk);
  [[nodiscard]] bool belongs(const cairn_lcm::snapshot_chunk_t& chunk) const;
  std::optional<Bytes> finish();

  std::int64_t snapshot_id_ = 0;
  std::int64_t map_id_ = 0;
  std::int64_t revision_ = 0;
  std::int64_t progress_us_ = 0;
  std::int32_t total_bytes_ = 0;
  std::int32_t total_crc32_ = 0;
  std::vector<Bytes> chunks_;  ///< Empty: not here yet. Memory grows with what arrives only.
  std::size_t num_missing_ = 0;
  std::int64_t received_bytes_ = 0;
};

}  // namespace cairn::wire
