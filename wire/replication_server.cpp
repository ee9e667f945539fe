#include "wire/replication_server.hpp"

#include <algorithm>
#include <utility>

#include <cairn_lcm/grid_map_t.hpp>

#include "wire/document.hpp"

namespace cairn::wire {

namespace {

/// Bytes of a delta or chunk beside its data, on the wire.
constexpr std::int64_t kOverheadBytes = 150;
constexpr std::size_t kSnapshotsPerKind = 4;
constexpr std::int32_t kHypothesisMap = cairn_lcm::snapshot_request_t::HYPOTHESIS_MAP;

bool is_same_tiling(const ReplicatedGrid& grid, const GridChange& change) {
  return grid.map_id == change.map_id && grid.cell_m == change.cell_m &&
         grid.tile_cells == change.tile_cells;
}

/// The tiles of a change that are sound and not as before.
std::map<TileIndex, TileCells> news(const ReplicatedGrid& grid, const GridChange& change) {
  const auto size =
      static_cast<std::size_t>(change.tile_cells) * static_cast<std::size_t>(change.tile_cells);
  std::map<TileIndex, TileCells> news;
  for (const auto& [index, cells] : change.tiles) {
    const auto held = grid.tiles.find(index);
    const bool is_new = held == grid.tiles.end() || *held->second != *cells;
    if (cells->size() == size && is_new) {
      news.emplace(index, cells);
    }
  }
  return news;
}

}  // namespace

ReplicationServer::ReplicationServer(std::int64_t boot_id,
                                     SendChunk send_chunk,
                                     SendDelta send_delta,
                                     ReplicationServerOptions options)
    : boot_id_(boot_id),
      send_chunk_(std::move(send_chunk)),
      send_delta_(std::move(send_delta)),
      options_(options) {}

void ReplicationServer::documents_changed() {
  for (auto& [id, snapshot] : snapshots_) {
    const std::int32_t what = snapshot.subject.what;
    snapshot.is_outdated =
        snapshot.is_outdated || what == kHypothesisMap || sources_.count(what) != 0;
  }
}

void ReplicationServer::offer_hypothesis_map(std::int64_t now_us,
                                             std::int64_t hypothesis_id,
                                             Document document) {
  add_snapshot(now_us, {kHypothesisMap, hypothesis_id}, std::move(document));
}

ReplicationServer::Subject ReplicationServer::subject_of(
    const cairn_lcm::snapshot_request_t& request) {
  return {request.what, request.what == kHypothesisMap ? request.hypothesis_id : 0};
}

void ReplicationServer::serve(std::int32_t what, Source source) {
  sources_[what] = std::move(source);
}

void ReplicationServer::change(std::int64_t now_us,
                               std::int64_t utime,
                               std::int32_t what,
                               const GridChange& change) {
  GridState& state = grids_[what];
  ReplicatedGrid& grid = state.grid;
  if (!is_same_tiling(grid, change)) {
    // The skipped revision breaks the chain: no delta of the new grid fits onto the old one.
    const std::int64_t revision = grid.revision == 0 ? 0 : grid.revision + 1;
    grid = {utime, change.map_id, revision, change.cell_m, change.tile_cells, {}};
    state.deltas.clear();
  }
  const std::map<TileIndex, TileCells> changed = news(grid, change);
  if (changed.empty()) {
    return;
  }
  grid.utime = utime;
  if (changed.size() > options_.most_deltas_at_once) {
    // Only the last tile goes out, with a gap before it that tells the clients they are behind.
    state.deltas.clear();
    for (const auto& [index, cells] : changed) {
      grid.tiles[index] = cells;
    }
    grid.revision += static_cast<std::int64_t>(changed.size()) - 1;
    add_delta(utime, what, changed.rbegin()->first, &state);
  } else {
    for (const auto& [index, cells] : changed) {
      grid.tiles[index] = cells;
      add_delta(utime, what, index, &state);
    }
  }
  state.last_sent_us = now_us;
}

void ReplicationServer::add_delta(std::int64_t utime,
                                  std::int32_t what,
                                  TileIndex index,
                                  GridState* state) {
  ReplicatedGrid& grid = state->grid;
  cairn_lcm::map_delta_t delta{};
  delta.utime = utime;
  delta.boot_id = boot_id_;
  delta.map_id = grid.map_id;
  delta.what = what;
  delta.prev_revision = grid.revision;
  delta.revision = ++grid.revision;
  delta.cell_m = grid.cell_m;
  delta.tile_cells = grid.tile_cells;
  delta.tile_x = index.x;
  delta.tile_y = index.y;
  delta.data = compressed(*grid.tiles.at(index));
  delta.num_bytes = static_cast<std::int32_t>(delta.data.size());
  delta.crc32 = crc32_of(delta.data);
  state->deltas.push_back(std::move(delta));
  if (state->deltas.size() > options_.kept_deltas) {
    state->deltas.pop_front();
  }
  deltas_due_.insert({what, grid.revision});
}

bool ReplicationServer::on_request(std::int64_t now_us,
                                   const cairn_lcm::snapshot_request_t& request) {
  const auto known = snapshots_.find(request.snapshot_id);
  if (known == snapshots_.end() || known->second.subject != subject_of(request)) {
    return offer_snapshot(now_us, subject_of(request), -1);
  }
  known->second.asked_us = now_us;
  for (const std::int32_t chunk : request.missing) {
    if (chunk >= 0 && chunk < known->second.num_chunks) {
      chunks_due_.insert({request.snapshot_id, chunk});
    }
  }
  return true;
}

bool ReplicationServer::on_request(std::int64_t now_us, const cairn_lcm::delta_request_t& request) {
  const auto known = grids_.find(request.what);
  if (known == grids_.end()) {
    return false;
  }
  const GridState& state = known->second;
  if (request.have_revision >= state.grid.revision) {
    return true;
  }
  if (state.deltas.empty() || request.have_revision < state.deltas.front().prev_revision) {
    return offer_snapshot(now_us, {request.what}, request.have_revision);
  }
  for (const cairn_lcm::map_delta_t& delta : state.deltas) {
    if (delta.revision > request.have_revision) {
      deltas_due_.insert({request.what, delta.revision});
    }
  }
  return true;
}

// Several who ask at about the same time share one snapshot; who comes late gets its beginning
// once more.
bool ReplicationServer::offer_snapshot(std::int64_t now_us,
                                       Subject subject,
                                       std::int64_t newer_than) {
  const std::int64_t window_us =
      subject.what == kHypothesisMap ? options_.kept_drawing_us : options_.join_window_us;
  for (auto known = snapshots_.rbegin(); known != snapshots_.rend(); ++known) {
    Snapshot& snapshot = known->second;
    if (snapshot.subject == subject && !snapshot.is_outdated &&
        now_us - snapshot.made_us < window_us && snapshot.document.revision > newer_than) {
      snapshot.asked_us = now_us;
      queue_all_chunks(known->first, snapshot);
      return true;
    }
  }
  std::optional<Document> document = make_document(subject.what);
  if (!document || document->bytes.empty()) {
    return false;
  }
  add_snapshot(now_us, subject, *std::move(document));
  return true;
}

std::optional<Document> ReplicationServer::make_document(std::int32_t what) const {
  if (const auto state = grids_.find(what); state != grids_.end()) {
    const ReplicatedGrid& grid = state->second.grid;
    return Document{grid.map_id, grid.revision, to_document(to_message(grid))};
  }
  const auto source = sources_.find(what);
  return source == sources_.end() ? std::nullopt : source->second();
}

void ReplicationServer::add_snapshot(std::int64_t now_us, Subject subject, Document document) {
  Snapshot snapshot{subject, std::move(document), 0, 0, now_us, now_us, false};
  const auto size = static_cast<std::int64_t>(snapshot.document.bytes.size());
  snapshot.crc32 = crc32_of(snapshot.document.bytes);
  snapshot.num_chunks =
      static_cast<std::int32_t>((size + options_.chunk_bytes - 1) / options_.chunk_bytes);
  const std::int64_t id = ++last_snapshot_id_;
  queue_all_chunks(id, snapshot);
  snapshots_.emplace(id, std::move(snapshot));
  const auto is_same_kind = [subject](const auto& entry) {
    return entry.second.subject.what == subject.what;
  };
  if (std::count_if(snapshots_.begin(), snapshots_.end(), is_same_kind) >
      static_cast<std::ptrdiff_t>(kSnapshotsPerKind)) {
    snapshots_.erase(std::find_if(snapshots_.begin(), snapshots_.end(), is_same_kind));
  }
}

void ReplicationServer::queue_all_chunks(std::int64_t snapshot_id, const Snapshot& snapshot) {
  for (std::int32_t chunk = 0; chunk < snapshot.num_chunks; ++chunk) {
    chunks_due_.insert({snapshot_id, chunk});
  }
}

void ReplicationServer::pump(std::int64_t now_us, std::int64_t utime) {
  earn_tokens(now_us);
  queue_reminders(now_us);
  while (tokens_ > 0 && has_work()) {
    // In turn, so that neither a busy map nor a large snapshot keeps the other from moving.
    const bool is_chunk = deltas_due_.empty() || (is_turn_of_chunks_ && !chunks_due_.empty());
    tokens_ -= is_chunk ? send_next_chunk(utime) : send_next_delta(now_us);
    is_turn_of_chunks_ = !is_chunk;
  }
  forget_old_snapshots(now_us);
}

void ReplicationServer::earn_tokens(std::int64_t now_us) {
  const std::int64_t elapsed_us =
      last_pump_us_ ? std::max<std::int64_t>(now_us - *last_pump_us_, 0) : 0;
  last_pump_us_ = now_us;
  const std::int64_t most = std::int64_t{2} * options_.chunk_bytes;
  // Longer than this fills the bucket anyway, and cannot overflow.
  const std::int64_t counted_us = std::min<std::int64_t>(elapsed_us, 1'000'000);
  tokens_ = std::min(tokens_ + counted_us * options_.bytes_per_s / 1'000'000, most);
}

// Who lost the last delta, and hears no status, learns of it all the same.
void ReplicationServer::queue_reminders(std::int64_t now_us) {
  for (auto& [what, state] : grids_) {
    if (!state.deltas.empty() && now_us - state.last_sent_us >= options_.reminder_us) {
      deltas_due_.insert({what, state.deltas.back().revision});
      state.last_sent_us = now_us;
    }
  }
}

/// @return bytes sent
std::int64_t ReplicationServer::send_next_delta(std::int64_t now_us) {
  const DueDelta due = *deltas_due_.begin();
  deltas_due_.erase(deltas_due_.begin());
  GridState& state = grids_.at(due.what);
  const auto delta = std::lower_bound(
      state.deltas.begin(), state.deltas.end(), due.revision,
      [](const cairn_lcm::map_delta_t& kept, std::int64_t r) { return kept.revision < r; });
  if (delta == state.deltas.end() || delta->revision != due.revision) {
    return 0;  // No longer kept: who needs it will be given a snapshot.
  }
  state.last_sent_us = now_us;
  send_delta_(*delta);
  return delta->num_bytes + kOverheadBytes;
}

/// @return bytes sent
std::int64_t ReplicationServer::send_next_chunk(std::int64_t utime) {
  const DueChunk due = *chunks_due_.begin();
  chunks_due_.erase(chunks_due_.begin());
  const auto known = snapshots_.find(due.snapshot_id);
  if (known == snapshots_.end()) {
    return 0;
  }
  const Snapshot& snapshot = known->second;
  const Bytes& bytes = snapshot.document.bytes;
  cairn_lcm::snapshot_chunk_t chunk{};
  chunk.utime = utime;
  chunk.boot_id = boot_id_;
  chunk.what = snapshot.subject.what;
  chunk.hypothesis_id = snapshot.subject.hypothesis_id;
  chunk.map_id = snapshot.document.map_id;
  chunk.snapshot_id = due.snapshot_id;
  chunk.revision = snapshot.document.revision;
  chunk.total_bytes = static_cast<std::int32_t>(bytes.size());
  chunk.total_crc32 = snapshot.crc32;
  chunk.num_chunks = snapshot.num_chunks;
  chunk.chunk = due.chunk;
  chunk.offset_bytes = due.chunk * options_.chunk_bytes;
  chunk.num_bytes = std::min(options_.chunk_bytes, chunk.total_bytes - chunk.offset_bytes);
  const auto begin = bytes.begin() + chunk.offset_bytes;
  chunk.data.assign(begin, begin + chunk.num_bytes);
  send_chunk_(chunk);
  return chunk.num_bytes + kOverheadBytes;
}

void ReplicationServer::forget_old_snapshots(std::int64_t now_us) {
  std::erase_if(snapshots_, [&](const auto& entry) {
    return now_us - entry.second.asked_us > options_.kept_snapshot_us;
  });
}

std::int64_t ReplicationServer::revision(std::int32_t what) const {
  const ReplicatedGrid* const held = grid(what);
  return held == nullptr ? 0 : held->revision;
}

const ReplicatedGrid* ReplicationServer::grid(std::int32_t what) const {
  const auto state = grids_.find(what);
  return state == grids_.end() ? nullptr : &state->second.grid;
}

}  // namespace cairn::wire
