#pragma once

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
#include "wire/snapshot_assembler.hpp"

namespace cairn::wire {

/// How a client sends its requests; header, id and time are filled in here.
struct ReplicationRequests {
  std::int64_t client_id = 0;  ///< Never 0.
  std::function<void(const cairn_lcm::snapshot_request_t&)> send_snapshot_request;
  std::function<void(const cairn_lcm::delta_request_t&)> send_delta_request;
};

/// Follows which run of the daemon speaks. Messages of the run before the present one come late,
/// and are not listened to.
class BootFilter {
 public:
  enum class Verdict { kSame, kRestarted, kStale };
  Verdict hear(std::int64_t boot_id);
  [[nodiscard]] std::int64_t boot_id() const { return boot_id_; }

 private:
  std::int64_t boot_id_ = 0;         ///< 0: none yet.
  std::deque<std::int64_t> former_;  ///< A few are enough.
};

/// A client's copy of a grid of the daemon (GLOBAL_MAP or LPM), kept equal over a bus that loses,
/// repeats and reorders messages: see ReplicationServer. No bus and no clock in here: times in
/// microseconds, by any clock that never steps.
///
/// Feed it CAIRN_STATUS, CAIRN_MAP_DELTA (or CAIRN_LPM) and CAIRN_SNAPSHOT, and call `tick`.
class GridMirror {
 public:
  GridMirror(std::int32_t what, ReplicationRequests requests);

  /// @param revision newest one of this grid by status_t; 0 where the status does not say
  void on_status(std::int64_t boot_id, std::int64_t revision);
  void on_delta(const cairn_lcm::map_delta_t& delta);
  void on_chunk(std::int64_t now_us, const cairn_lcm::snapshot_chunk_t& chunk);
  /// Asks for what is missing; the only place that does. Call it about 20 times a second.
  /// @param utime wall clock, for the header of requests
  void tick(std::int64_t now_us, std::int64_t utime);

  /// Nothing held yet: revision -1 and no tiles.
  [[nodiscard]] const ReplicatedGrid& grid() const { return grid_; }
  [[nodiscard]] bool is_current() const { return grid_.revision >= 0 && newest_ <= grid_.revision; }
  /// Share of a snapshot under way, in [0, 1]; 0 where there is none.
  [[nodiscard]] double snapshot_progress() const { return assembler_.progress(); }
  /// What changed since the last call. Everything, when `is_all` (a snapshot, another map).
  struct Changes {
    bool is_all = false;
    std::set<TileIndex> tiles;
  };
  [[nodiscard]] Changes take_changes();

 private:
  [[nodiscard]] bool hear(std::int64_t boot_id);
  void apply_pending();
  void apply(const cairn_lcm::map_delta_t& delta);
  void take_document(const Bytes& document);
  void ask(std::int64_t utime);
  void note_progress();

  std::int32_t what_;
  ReplicationRequests requests_;
  BootFilter boot_;
  ReplicatedGrid grid_;
  std::int64_t newest_ = 0;                                 ///< Newest revision heard of.
  std::map<std::int64_t, cairn_lcm::map_delta_t> pending_;  ///< Ahead of us, by revision.
  SnapshotAssembler assembler_;
  Changes changes_;
  std::int32_t last_request_id_ = 0;
  std::int64_t asked_us_;
  std::int64_t wait_us_;
  std::int64_t behind_since_us_ = 0;
  std::int64_t behind_at_ = -2;
};

/// Gets one document of any kind, once.
class DocumentFetch {
 public:
  enum class State { kAsking, kDone, kFailed };

  /// @param map_id 0: of whatever map there is
  /// @param hypothesis_id of HYPOTHESIS_MAP; else 0
  DocumentFetch(std::int32_t what,
                std::int64_t map_id,
                ReplicationRequests requests,
                std::int64_t hypothesis_id = 0);

  void on_chunk(std::int64_t now_us, const cairn_lcm::snapshot_chunk_t& chunk);
  /// The daemon said that it works on it: what was asked so far does not count.
  void accepted() { unanswered_ = 0; }
  /// Asks again where needed; about 20 times a second.
  State tick(std::int64_t now_us, std::int64_t utime);

  [[nodiscard]] State state() const { return state_; }
  /// @pre state() == kDone; see from_document
  [[nodiscard]] const Bytes& document() const { return document_; }
  [[nodiscard]] std::int64_t revision() const { return revision_; }
  [[nodiscard]] double progress() const { return assembler_.progress(); }

 private:
  std::int32_t what_;
  std::int64_t map_id_;
  std::int64_t hypothesis_id_;
  ReplicationRequests requests_;
  BootFilter boot_;
  SnapshotAssembler assembler_;
  State state_ = State::kAsking;
  Bytes document_;
  std::int64_t revision_ = 0;
  std::int32_t last_request_id_ = 0;
  int unanswered_ = 0;  ///< Requests since the last new chunk.
  std::int64_t asked_us_;
  std::int64_t wait_us_;
};

}  // namespace cairn::wire
