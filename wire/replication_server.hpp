#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <set>

#include <cairn_lcm/delta_request_t.hpp>
#include <cairn_lcm/map_delta_t.hpp>
#include <cairn_lcm/snapshot_chunk_t.hpp>
#include <cairn_lcm/snapshot_request_t.hpp>

#include "wire/replicated_grid.hpp"
#include "wire/wire_check.hpp"

namespace cairn::wire {

struct ReplicationServerOptions {
  std::int32_t chunk_bytes = 16'000;           ///< 1300 where clients sit behind a radio link.
  std::int64_t bytes_per_s = 8'000'000;        ///< Of deltas and chunks together.
  std::size_t kept_deltas = 256;               ///< For each grid, to be sent again on request.
  std::size_t most_deltas_at_once = 128;       ///< A larger change travels by snapshot.
  std::int64_t kept_snapshot_us = 10'000'000;  ///< After it was last asked for.
  std::int64_t join_window_us = 500'000;       ///< Who asks within it gets the same snapshot.
  std::int64_t kept_drawing_us = 5'000'000;    ///< The same for maps that are drawn on request.
  std::int64_t reminder_us = 1'000'000;        ///< Of silence, then the newest delta is repeated.
};

/// A document as snapshots carry it (document.hpp).
struct Document {
  std::int64_t map_id = 0;
  std::int64_t revision = 0;
  Bytes bytes;
};

/// Tiles that changed together.
struct GridChange {
  std::int64_t map_id = 0;
  double cell_m = 0.0;
  std::int32_t tile_cells = 0;
  std::map<TileIndex, TileCells> tiles;
};

/// The daemon's side of map replication over a bus that loses messages.
///
/// A grid travels as deltas, one changed tile each, chained by revision; the last ones are kept and
/// sent again on request. Who is further behind, or new, gets a snapshot: the grid of one fixed
/// revision, in chunks that are asked for until they are all there. Documents that are no grids
/// travel by snapshot alone. A token bucket paces everything, since a burst that overruns the
/// receive buffer of a client arrives at none.
///
/// No bus and no clock in here: the caller passes times in microseconds, by any clock that never
/// steps, and functions that send. `what` is that of snapshot_request_t.
class ReplicationServer {
 public:
  using SendChunk = std::function<void(const cairn_lcm::snapshot_chunk_t&)>;
  using SendDelta = std::function<void(const cairn_lcm::map_delta_t&)>;
  /// Makes the document at this moment; nothing where there is none yet.
  using Source = std::function<std::optional<Document>()>;

  /// @param boot_id of this run of the daemon, never 0
  ReplicationServer(std::int64_t boot_id,
                    SendChunk send_chunk,
                    SendDelta send_delta,
                    ReplicationServerOptions options = {});

  /// Where the documents of a kind come from that is no replicated grid.
  void serve(std::int32_t what, Source source);
  /// These documents have changed: who asks from now on gets new ones, and shares none made before.
  void documents_changed();
  /// The map of one hypothesis (HYPOTHESIS_MAP), drawn on request: sends it to all who listen, and
  /// to who asks for it from now on, as long as it is young and documents_changed() is not called.
  void offer_hypothesis_map(std::int64_t now_us, std::int64_t hypothesis_id, Document document);
  /// Takes changed tiles over and queues their deltas. Another map_id, cell size or tile size than
  /// before starts the grid afresh; the revision goes on. Tiles that are as before cost nothing.
  /// @pre every tile has tile_cells^2 cells; others are left out
  void change(std::int64_t now_us, std::int64_t utime, std::int32_t what, const GridChange& change);

  /// @return false where there is nothing of this kind to send
  bool on_request(std::int64_t now_us, const cairn_lcm::snapshot_request_t& request);
  bool on_request(std::int64_t now_us, const cairn_lcm::delta_request_t& request);
  /// Sends what the pace allows. To be called every few milliseconds while `has_work`, otherwise
  /// a few times a second.
  void pump(std::int64_t now_us, std::int64_t utime);
  [[nodiscard]] bool has_work() const { return !deltas_due_.empty() || !chunks_due_.empty(); }

  /// 0 where nothing has changed yet.
  [[nodiscard]] std::int64_t revision(std::int32_t what) const;
  [[nodiscard]] const ReplicatedGrid* grid(std::int32_t what) const;

 private:
  struct GridState {
    ReplicatedGrid grid;
    std::deque<cairn_lcm::map_delta_t> deltas;  ///< The newest, in the order of revisions.
    std::int64_t last_sent_us = 0;
  };
  /// What a snapshot is of.
  struct Subject {
    std::int32_t what = 0;
    std::int64_t hypothesis_id = 0;  ///< Of HYPOTHESIS_MAP; else 0.
    friend bool operator==(const Subject&, const Subject&) = default;
  };
  struct Snapshot {
    Subject subject;
    Document document;
    std::int32_t crc32 = 0;
    std::int32_t num_chunks = 0;
    std::int64_t made_us = 0;
    std::int64_t asked_us = 0;
    bool is_outdated = false;  ///< It has changed since.
  };
  /// Ordered, so that a thing asked for twice is sent once, the older snapshot first.
  struct DueDelta {
    std::int32_t what = 0;
    std::int64_t revision = 0;
    friend auto operator<=>(const DueDelta&, const DueDelta&) = default;
  };
  struct DueChunk {
    std::int64_t snapshot_id = 0;
    std::int32_t chunk = 0;
    friend auto operator<=>(const DueChunk&, const DueChunk&) = default;
  };

  [[nodiscard]] std::optional<Document> make_document(std::int32_t what) const;
  [[nodiscard]] static Subject subject_of(const cairn_lcm::snapshot_request_t& request);
  bool offer_snapshot(std::int64_t now_us, Subject subject, std::int64_t newer_than);
  void add_snapshot(std::int64_t now_us, Subject subject, Document document);
  void queue_all_chunks(std::int64_t snapshot_id, const Snapshot& snapshot);
  void add_delta(std::int64_t utime, std::int32_t what, TileIndex index, GridState* state);
  void earn_tokens(std::int64_t now_us);
  void queue_reminders(std::int64_t now_us);
  [[nodiscard]] std::int64_t send_next_delta(std::int64_t now_us);
  [[nodiscard]] std::int64_t send_next_chunk(std::int64_t utime);
  void forget_old_snapshots(std::int64_t now_us);

  std::int64_t boot_id_;
  SendChunk send_chunk_;
  SendDelta send_delta_;
  ReplicationServerOptions options_;
  std::map<std::int32_t, Source> sources_;
  std::map<std::int32_t, GridState> grids_;
  std::map<std::int64_t, Snapshot> snapshots_;  ///< By id, so that the newest is last.
  std::set<DueDelta> deltas_due_;
  std::set<DueChunk> chunks_due_;
  std::int64_t last_snapshot_id_ = 0;
  std::int64_t tokens_ = 0;  ///< Bytes that may be sent now; below 0 after a send.
  std::optional<std::int64_t> last_pump_us_;
  bool is_turn_of_chunks_ = false;
};

}  // namespace cairn::wire
