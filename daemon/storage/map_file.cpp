#include "storage/map_file.hpp"

#include <filesystem>

#include "storage/journal_codec.hpp"

namespace cairn {
namespace {

constexpr const char* kSchema = R"(
  CREATE TABLE IF NOT EXISTS meta(key TEXT PRIMARY KEY, value TEXT NOT NULL) WITHOUT ROWID;
  CREATE TABLE IF NOT EXISTS scan(number INTEGER PRIMARY KEY, utime INTEGER NOT NULL,
                                  bytes BLOB NOT NULL);
  CREATE TABLE IF NOT EXISTS visit(number INTEGER PRIMARY KEY, after_scan INTEGER NOT NULL,
                                   bytes BLOB NOT NULL);
  CREATE TABLE IF NOT EXISTS perception(visit INTEGER PRIMARY KEY, bytes BLOB NOT NULL);
  CREATE TABLE IF NOT EXISTS name(place_visit INTEGER PRIMARY KEY, name TEXT NOT NULL);
  CREATE TABLE IF NOT EXISTS assertion(step INTEGER PRIMARY KEY, after_scan INTEGER NOT NULL,
                                       after_visit INTEGER NOT NULL, utime INTEGER NOT NULL,
                                       who TEXT NOT NULL, kind TEXT NOT NULL,
                                       visit_a INTEGER NOT NULL, visit_b INTEGER NOT NULL,
                                       assertion INTEGER NOT NULL, client_id INTEGER NOT NULL,
                                       request_id INTEGER NOT NULL);
  CREATE TABLE IF NOT EXISTS document(what INTEGER PRIMARY KEY, revision INTEGER NOT NULL,
                                      bytes BLOB NOT NULL);
)";

}  // namespace

Result<MapFile> MapFile::open(const std::string& file) {
  const std::filesystem::path folder = std::filesystem::path(file).parent_path();
  std::error_code ignored;
  if (!folder.empty() && !std::filesystem::is_directory(folder, ignored)) {
    return Error{ErrorCode::kUnavailable, file + ": there is no folder " + folder.string()};
  }
  Result<FileLock> lock = FileLock::hold(file);
  if (!lock) {
    return Error{lock.error().code, file + ": " + lock.error().message};
  }
  Result<Database> database = Database::open(file);
  if (!database) {
    return database.error();
  }
  MapFile map_file(*std::move(lock), *std::move(database));
  if (const Status status = map_file.prepare(); !status) {
    return Error{status.error().code, file + ": " + status.error().message};
  }
  return map_file;
}

Status MapFile::prepare() {
  // The write-ahead log with full synchronisation: a commit is on the disk when it returns.
  if (Status status = database_.execute("PRAGMA journal_mode=WAL; PRAGMA synchronous=FULL;");
      !status) {
    return status;
  }
  if (Status status = check_format(); !status) {
    return status;
  }
  if (Status status = database_.execute(kSchema); !status) {
    return status;
  }
  if (Status status = database_.execute(
          "INSERT OR IGNORE INTO meta VALUES('application', 'cairn'), ('format_version', '" +
          std::to_string(kFormatVersion) + "'), ('map_id', '0')");
      !status) {
    return status;
  }
  Result<Statement> scan = database_.prepare("INSERT INTO scan VALUES(?, ?, ?)");
  Result<Statement> visit = database_.prepare("INSERT INTO visit VALUES(?, ?, ?)");
  Result<Statement> document = database_.prepare("INSERT OR REPLACE INTO document VALUES(?, ?, ?)");
  for (const Result<Statement>* statement : {&scan, &visit, &document}) {
    if (!*statement) {
      return statement->error();
    }
  }
  insert_scan_ = *std::move(scan);
  insert_visit_ = *std::move(visit);
  replace_document_ = *std::move(document);
  return read_meta();
}

Status MapFile::check_format() {
  Result<Statement> tables = database_.prepare("SELECT count(*) FROM sqlite_master");
  if (!tables) {
    return tables.error();
  }
  const Result<bool> row = tables->step();
  if (!row) {
    return row.error();
  }
  if (tables->integer(0) == 0) {
    return {};  // A new file.
  }
  const Error foreign{ErrorCode::kMalformed, "this SQLite file is no cairn map"};
  Result<Statement> version = database_.prepare(
      "SELECT value FROM meta WHERE key='format_version' AND EXISTS"
      "(SELECT 1 FROM meta WHERE key='application' AND value='cairn')");
  if (!version) {
    return foreign;
  }
  const Result<bool> found = version->step();
  if (!found || !*found) {
    return foreign;
  }
  if (version->text(0) != std::to_string(kFormatVersion)) {
    return Error{ErrorCode::kMalformed,
                 "map format " + version->text(0) +
                     " is not the one this cairnd knows: " + std::to_string(kFormatVersion)};
  }
  return {};
}

Status MapFile::read_meta() {
  Result<Statement> meta = database_.prepare(
      "SELECT (SELECT value FROM meta WHERE key='map_id'), (SELECT count(*) FROM scan), "
      "(SELECT count(*) FROM visit)");
  if (!meta) {
    return meta.error();
  }
  const Result<bool> row = meta->step();
  if (!row) {
    return row.error();
  }
  map_id_ = meta->integer(0);
  scan_count_ = meta->integer(1);
  visit_count_ = meta->integer(2);
  return {};
}

Status MapFile::begin() {
  return database_.is_in_transaction() ? Status() : database_.execute("BEGIN");
}

Status MapFile::append(const PerceivedScan& scan) {
  if (Status status = begin(); !status) {
    return status;
  }
  const std::int64_t utime = utime_of(scan.scan->time);
  if (scan_count_ == 0) {
    map_id_ = utime;
    if (Status status = database_.execute("UPDATE meta SET value='" + std::to_string(map_id_) +
                                          "' WHERE key='map_id'");
        !status) {
      return status;
    }
  }
  const std::vector<std::uint8_t> row = to_row(scan);
  Status status = insert_scan_.bind(0, scan_count_).bind(1, utime).bind(2, row).run();
  if (status) {
    ++scan_count_;
  }
  return status;
}

Status MapFile::append(const Visit& visit) {
  if (Status status = begin(); !status) {
    return status;
  }
  const std::vector<std::uint8_t> row = to_row(visit);
  Status status = insert_visit_.bind(0, visit_count_).bind(1, scan_count_).bind(2, row).run();
  if (status) {
    ++visit_count_;
  }
  return status;
}

Status MapFile::append_perception(std::int64_t visit, const std::vector<std::uint8_t>& bytes) {
  if (Status status = begin(); !status) {
    return status;
  }
  Result<Statement> insert = database_.prepare("INSERT OR REPLACE INTO perception VALUES(?, ?)");
  return insert ? insert->bind(0, visit).bind(1, bytes).run() : insert.error();
}

Result<std::vector<std::uint8_t>> MapFile::read_perception(std::int64_t visit) {
  Result<Statement> row = database_.prepare("SELECT bytes FROM perception WHERE visit = ?");
  if (!row) {
    return row.error();
  }
  const Result<bool> found = row->bind(0, visit).step();
  if (!found) {
    return found.error();
  }
  return *found ? row->bytes(0) : std::vector<std::uint8_t>();
}

Status MapFile::commit() {
  return database_.is_in_transaction() ? database_.execute("COMMIT") : Status();
}

void MapFile::roll_back() {
  // SQLite may have rolled back by itself; a failure here leaves nothing to undo either way.
  if (database_.is_in_transaction()) {
    static_cast<void>(database_.execute("ROLLBACK").ok());
  }
  static_cast<void>(read_meta().ok());
}

Status MapFile::write_name(std::int64_t visit, const std::string& name) {
  Result<Statement> statement =
      database_.prepare(name.empty() ? "DELETE FROM name WHERE place_visit = ?"
                                     : "INSERT OR REPLACE INTO name VALUES(?, ?)");
  if (!statement) {
    return statement.error();
  }
  statement->bind(0, visit);
  if (!name.empty()) {
    statement->bind(1, name);
  }
  if (Status status = begin(); !status) {
    return status;
  }
  if (Status status = statement->run(); !status) {
    return status;
  }
  return commit();
}

Result<std::map<std::int64_t, std::string>> MapFile::read_names() {
  Result<Statement> statement = database_.prepare("SELECT place_visit, name FROM name");
  if (!statement) {
    return statement.error();
  }
  std::map<std::int64_t, std::string> names;
  while (true) {
    const Result<bool> row = statement->step();
    if (!row) {
      return row.error();
    }
    if (!*row) {
      return names;
    }
    names[statement->integer(0)] = statement->text(1);
  }
}

Status MapFile::write_document(int what,
                               std::int64_t revision,
                               const std::vector<std::uint8_t>& bytes) {
  if (Status status = begin(); !status) {
    return status;
  }
  return replace_document_.bind(0, std::int64_t{what}).bind(1, revision).bind(2, bytes).run();
}

Status MapFile::close() {
  if (Status status = commit(); !status) {
    return status;
  }
  return database_.execute("PRAGMA wal_checkpoint(TRUNCATE); PRAGMA journal_mode=DELETE;");
}

}  // namespace cairn
