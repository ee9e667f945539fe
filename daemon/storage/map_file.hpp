#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/result.hpp"
#include "service/experience.hpp"
#include "storage/database.hpp"
#include "storage/file_lock.hpp"
#include "storage/operator_order.hpp"

namespace cairn {

/// The map file: one SQLite file with the journal of experience (every perceived scan, every visit
/// with its local perceptual map, every assertion of an operator), what was last published of it
/// (documents), pictures of what was seen of places, names and the format version. Scans and visits
/// are cairn_journal messages, compressed with zstd; assertions are plain columns, for whoever
/// audits them with other tools.
///
/// What has been committed survives kill -9, a full disk and a power cut (write-ahead log with full
/// synchronisation). The same experience gives the same bytes.
class MapFile {
 public:
  static constexpr int kFormatVersion = 3;

  /// Opens or creates. kUnavailable where the path cannot be written, kMalformed where the file is
  /// no map file or of a newer format.
  [[nodiscard]] static Result<MapFile> open(const std::string& file);

  /// Takes a scan into the journal, with the next commit.
  Status append(const PerceivedScan& scan);
  /// Takes a visit into the journal, with the next commit.
  Status append(const Visit& visit);
  /// Takes what was seen of the place of a visit, as clients draw it, with the next commit. Beside
  /// the journal: nothing is taken up from it.
  Status append_perception(std::int64_t visit, const std::vector<std::uint8_t>& bytes);
  /// The same back; empty where none was kept.
  [[nodiscard]] Result<std::vector<std::uint8_t>> read_perception(std::int64_t visit);
  /// From here on, all that was appended is on the disk.
  Status commit();
  /// Forgets what was appended since the last commit, for instance after a full disk.
  void roll_back();

  /// Takes a name for the place of a visit; empty takes it away. On the disk when this returns.
  Status write_name(std::int64_t visit, const std::string& name);
  /// Every name, by visit.
  [[nodiscard]] Result<std::map<std::int64_t, std::string>> read_names();

  /// Takes an operator's order into the journal, behind the scans and visits appended so far. On
  /// the disk, with these, when this returns.
  Status write_order(const OperatorOrder& order);

  /// What was last published. @param what as in snapshot_request_t
  Status write_document(int what, std::int64_t revision, const std::vector<std::uint8_t>& bytes);

  /// Who takes the journal up.
  struct JournalReader {
    std::function<void(PerceivedScan)> take_scan;
    std::function<Status(Visit)> take_visit;
    std::function<Status(const OperatorOrder&)> take_order;
  };
  /// Gives the journal in the order in which it was written. A damaged row ends it, with an error
  /// that names the row; what was read until then stands. A visit or an order that is not accepted
  /// ends it too.
  Status read_journal(const JournalReader& reader);

  /// Names this map for clients: the time of the first scan; 0 before it.
  [[nodiscard]] std::int64_t map_id() const { return map_id_; }
  [[nodiscard]] std::int64_t scan_count() const { return scan_count_; }
  [[nodiscard]] std::int64_t visit_count() const { return visit_count_; }

  /// Commits, and leaves one file without a write-ahead log beside it.
  Status close();

 private:
  MapFile(FileLock lock, Database database)
      : lock_(std::move(lock)), database_(std::move(database)) {}
  Status prepare();
  Status check_format();
  Status begin();
  Status read_meta();

  FileLock lock_;  ///< Outlives the database: closing any descriptor of it would end its locks.
  Database database_;
  Statement insert_scan_;
  Statement insert_visit_;
  Statement replace_document_;
  std::int64_t map_id_ = 0;
  std::int64_t scan_count_ = 0;
  std::int64_t visit_count_ = 0;
};

}  // namespace cairn
