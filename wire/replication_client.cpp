#include "wire/replication_client.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include <cairn_lcm/grid_map_t.hpp>

#include "wire/document.hpp"
#include "wire/signatures.hpp"

namespace cairn::wire {

namespace {

constexpr std::int64_t kNever = std::numeric_limits<std::int64_t>::min() / 2;
constexpr std::int64_t kFirstWaitUs = 100'000;
constexpr std::int64_t kLongestWaitUs = 2'000'000;
/// Chunks may still be on their way for this long after the last.
constexpr std::int64_t kSilenceUs = 150'000;
/// A gap in the deltas may be mere disorder for this long.
constexpr std::int64_t kPatienceUs = 100'000;
constexpr std::size_t kMostMissing = 512;
constexpr std::size_t kMostPending = 1024;
constexpr std::size_t kFormerBoots = 8;
constexpr int kFetchTries = 8;

std::int64_t longer(std::int64_t wait_us) {
  return std::min(wait_us * 3 / 2, kLongestWaitUs);
}

cairn_lcm::rpc_header_t header_of(const ReplicationRequests& requests,
                                  std::int64_t utime,
                                  std::int32_t request_id,
                                  std::int64_t boot_id) {
  cairn_lcm::rpc_header_t header{};
  header.utime = utime;
  header.client_id = requests.client_id;
  header.request_id = request_id;
  header.boot_id = boot_id;
  return header;
}

cairn_lcm::snapshot_request_t snapshot_request(const cairn_lcm::rpc_header_t& header,
                                               std::int32_t what,
                                               const SnapshotAssembler& assembler) {
  cairn_lcm::snapshot_request_t request{};
  request.header = header;
  request.what = what;
  request.snapshot_id = assembler.snapshot_id();
  request.missing = assembler.missing(kMostMissing);
  request.num_missing = static_cast<std::int32_t>(request.missing.size());
  return request;
}

bool is_sound(const cairn_lcm::map_delta_t& delta) {
  return delta.revision > delta.prev_revision && delta.prev_revision >= 0 &&
         is_tiling(delta.cell_m, delta.tile_cells) && delta.crc32 == crc32_of(delta.data);
}

}  // namespace

BootFilter::Verdict BootFilter::hear(std::int64_t boot_id) {
  if (boot_id == boot_id_) {
    return boot_id == 0 ? Verdict::kStale : Verdict::kSame;
  }
  if (boot_id == 0 || std::find(former_.begin(), former_.end(), boot_id) != former_.end()) {
    return Verdict::kStale;
  }
  if (boot_id_ != 0) {
    former_.push_back(boot_id_);
    if (former_.size() > kFormerBoots) {
      former_.pop_front();
    }
  }
  boot_id_ = boot_id;
  return Verdict::kRestarted;
}

GridMirror::GridMirror(std::int32_t what, ReplicationRequests requests)
    : what_(what), requests_(std::move(requests)), asked_us_(kNever), wait_us_(kFirstWaitUs) {
  grid_.revision = -1;
}

/// @return false where the message comes from a former run
bool GridMirror::hear(std::int64_t boot_id) {
  const BootFilter::Verdict verdict = boot_.hear(boot_id);
  if (verdict == BootFilter::Verdict::kRestarted) {
    grid_ = {};
    grid_.revision = -1;
    newest_ = 0;
    pending_.clear();
    assembler_.clear();
    changes_ = {true, {}};
    asked_us_ = kNever;
    note_progress();
  }
  return verdict != BootFilter::Verdict::kStale;
}

void GridMirror::note_progress() {
  wait_us_ = kFirstWaitUs;
}

void GridMirror::on_status(std::int64_t boot_id, std::int64_t revision) {
  if (hear(boot_id)) {
    newest_ = std::max(newest_, revision);
  }
}

void GridMirror::on_delta(const cairn_lcm::map_delta_t& delta) {
  if (delta.what != what_ || !is_sound(delta) || !hear(delta.boot_id)) {
    return;
  }
  newest_ = std::max(newest_, delta.revision);
  if (delta.revision <= grid_.revision) {
    return;
  }
  if (pending_.size() < kMostPending) {
    pending_.emplace(delta.revision, delta);
  }
  apply_pending();
}

void GridMirror::on_chunk(std::int64_t now_us, const cairn_lcm::snapshot_chunk_t& chunk) {
  if (chunk.what != what_ || !hear(chunk.boot_id) || chunk.revision <= grid_.revision) {
    return;
  }
  const std::int64_t progress_before_us = assembler_.progress_us();
  const std::optional<Bytes> document = assembler_.add(now_us, chunk);
  if (assembler_.progress_us() != progress_before_us) {
    note_progress();
  }
  if (document) {
    take_document(*document);
  }
}

void GridMirror::take_document(const Bytes& document) {
  const auto message = from_document<cairn_lcm::grid_map_t>(document);
  if (!message) {
    return;
  }
  Expected<ReplicatedGrid> grid = to_grid(*message);
  if (!grid || grid->revision <= grid_.revision) {
    return;
  }
  grid_ = *std::move(grid);
  newest_ = std::max(newest_, grid_.revision);
  changes_ = {true, {}};
  apply_pending();
}

void GridMirror::apply_pending() {
  if (grid_.revision < 0) {
    return;
  }
  pending_.erase(pending_.begin(), pending_.upper_bound(grid_.revision));
  while (!pending_.empty() && pending_.begin()->second.prev_revision == grid_.revision) {
    const cairn_lcm::map_delta_t delta = std::move(pending_.begin()->second);
    pending_.erase(pending_.begin());
    apply(delta);
    if (grid_.revision != delta.revision) {
      break;
    }
  }
  // Deltas have overtaken the snapshot under way: its chunks are ignored from now on, so it must
  // not be asked for any more, or that would never end.
  if (assembler_.is_collecting() && assembler_.revision() <= grid_.revision) {
    assembler_.clear();
  }
}

void GridMirror::apply(const cairn_lcm::map_delta_t& delta) {
  const bool is_first = grid_.tiles.empty() && grid_.tile_cells == 0;
  const bool fits = delta.map_id == grid_.map_id && delta.tile_cells == grid_.tile_cells &&
                    delta.cell_m == grid_.cell_m;
  if (!is_first && !fits) {
    return;
  }
  const auto size =
      static_cast<std::size_t>(delta.tile_cells) * static_cast<std::size_t>(delta.tile_cells);
  Expected<Bytes> cells = decompressed(delta.data.data(), delta.data.size(), size);
  if (!cells || cells->size() != size) {
    return;
  }
  grid_.utime = delta.utime;
  grid_.map_id = delta.map_id;
  grid_.cell_m = delta.cell_m;
  grid_.tile_cells = delta.tile_cells;
  grid_.revision = delta.revision;
  const TileIndex index{delta.tile_x, delta.tile_y};
  grid_.tiles[index] = std::make_shared<const Bytes>(*std::move(cells));
  if (!changes_.is_all) {
    changes_.tiles.insert(index);
  }
  note_progress();
}

void GridMirror::tick(std::int64_t now_us, std::int64_t utime) {
  if (is_current()) {
    note_progress();
    behind_at_ = kNever;
    return;
  }
  if (behind_at_ != grid_.revision) {
    behind_at_ = grid_.revision;
    behind_since_us_ = now_us;
  }
  const bool is_arriving =
      assembler_.is_collecting() && now_us - assembler_.progress_us() < kSilenceUs;
  const bool may_be_disorder =
      grid_.revision >= 0 && !assembler_.is_collecting() && now_us - behind_since_us_ < kPatienceUs;
  if (now_us - asked_us_ < wait_us_ || is_arriving || may_be_disorder) {
    return;
  }
  ask(utime);
  asked_us_ = now_us;
  wait_us_ = longer(wait_us_);
}

void GridMirror::ask(std::int64_t utime) {
  const auto header = header_of(requests_, utime, ++last_request_id_, boot_.boot_id());
  if (assembler_.is_collecting() || grid_.revision < 0) {
    requests_.send_snapshot_request(snapshot_request(header, what_, assembler_));
    return;
  }
  cairn_lcm::delta_request_t request{};
  request.header = header;
  request.what = what_;
  request.map_id = grid_.map_id;
  request.have_revision = grid_.revision;
  requests_.send_delta_request(request);
}

GridMirror::Changes GridMirror::take_changes() {
  return std::exchange(changes_, {});
}

DocumentFetch::DocumentFetch(std::int32_t what,
                             std::int64_t map_id,
                             ReplicationRequests requests,
                             std::int64_t hypothesis_id)
    : what_(what),
      map_id_(map_id),
      hypothesis_id_(hypothesis_id),
      requests_(std::move(requests)),
      asked_us_(kNever),
      wait_us_(kFirstWaitUs) {}

void DocumentFetch::on_chunk(std::int64_t now_us, const cairn_lcm::snapshot_chunk_t& chunk) {
  const bool is_ours = state_ == State::kAsking && chunk.what == what_ &&
                       chunk.hypothesis_id == hypothesis_id_ &&
                       (map_id_ == 0 || chunk.map_id == map_id_);
  if (!is_ours) {
    return;
  }
  const BootFilter::Verdict verdict = boot_.hear(chunk.boot_id);
  if (verdict == BootFilter::Verdict::kStale) {
    return;
  }
  if (verdict == BootFilter::Verdict::kRestarted) {
    assembler_.clear();
  }
  const std::int64_t progress_before_us = assembler_.progress_us();
  std::optional<Bytes> document = assembler_.add(now_us, chunk);
  if (assembler_.progress_us() != progress_before_us) {
    unanswered_ = 0;
    wait_us_ = kFirstWaitUs;
  }
  if (document) {
    document_ = *std::move(document);
    revision_ = chunk.revision;
    state_ = State::kDone;
  }
}

DocumentFetch::State DocumentFetch::tick(std::int64_t now_us, std::int64_t utime) {
  const bool is_arriving =
      assembler_.is_collecting() && now_us - assembler_.progress_us() < kSilenceUs;
  if (state_ != State::kAsking || now_us - asked_us_ < wait_us_ || is_arriving) {
    return state_;
  }
  if (unanswered_ >= kFetchTries) {
    state_ = State::kFailed;
    return state_;
  }
  ++unanswered_;
  const auto header = header_of(requests_, utime, ++last_request_id_, boot_.boot_id());
  cairn_lcm::snapshot_request_t request = snapshot_request(header, what_, assembler_);
  request.map_id = map_id_;
  request.hypothesis_id = hypothesis_id_;
  requests_.send_snapshot_request(request);
  asked_us_ = now_us;
  wait_us_ = longer(wait_us_);
  return state_;
}

}  // namespace cairn::wire
