#include "clients/common/map_file.hpp"

#include <algorithm>
#include <array>
#include <fstream>

#include <cairn_lcm/snapshot_request_t.hpp>
#include <sqlite3.h>

#include "clients/common/failure.hpp"
#include "clients/common/text.hpp"
#include "wire/document.hpp"
#include "wire/signatures.hpp"

namespace cairn::clients {
namespace {

constexpr char kFormatVersion[] = "3";

struct Finalize {
  void operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
};
using Statement = std::unique_ptr<sqlite3_stmt, Finalize>;

Failure unreadable(const std::filesystem::path& path, const std::string& reason) {
  return {ExitCode::kBadData, path.string() + ": " + reason};
}

std::string column_text(sqlite3_stmt* row, int column) {
  const unsigned char* text = sqlite3_column_text(row, column);
  const auto size = static_cast<std::size_t>(sqlite3_column_bytes(row, column));
  return text == nullptr ? std::string() : std::string(text, text + size);
}

// SQLite's header: the bytes 18 and 19 are 2 for a database with a write-ahead log.
bool has_write_ahead_log(const std::filesystem::path& path) {
  std::array<char, 20> header{};
  std::ifstream(path, std::ios::binary).read(header.data(), header.size());
  return header[18] == 2;
}

// Percent-encodes what has a meaning in a URI of SQLite.
std::string uri_of(const std::filesystem::path& path, const std::string& query) {
  std::string uri = "file:";
  for (const char c : std::filesystem::absolute(path).string()) {
    uri += c == '%' ? "%25" : c == '?' ? "%3f" : c == '#' ? "%23" : std::string(1, c);
  }
  return uri + "?" + query;
}

const char* name_of(std::int32_t what) {
  using Request = cairn_lcm::snapshot_request_t;
  return what == Request::GLOBAL_MAP   ? "global map"
         : what == Request::TOPOLOGY   ? "topological map"
         : what == Request::HYPOTHESES ? "list of hypotheses"
         : what == Request::TRAJECTORY ? "trajectory"
         : what == Request::VISITS     ? "list of visits"
                                       : "document of this kind";
}

std::string listed(const std::vector<std::int64_t>& numbers) {
  constexpr std::size_t kMost = 10;
  std::string text;
  for (std::size_t i = 0; i < std::min(numbers.size(), kMost); ++i) {
    text += (i == 0 ? "" : ", ") + std::to_string(numbers[i]);
  }
  return numbers.size() <= kMost
             ? text
             : text + " and " + std::to_string(numbers.size() - kMost) + " more";
}

Statement prepare(sqlite3* database, const std::filesystem::path& path, const std::string& sql) {
  sqlite3_stmt* statement = nullptr;
  const int result = sqlite3_prepare_v2(database, sql.c_str(), -1, &statement, nullptr);
  if (result == SQLITE_NOTADB || result == SQLITE_ERROR) {
    throw unreadable(path, std::string("is no cairn map (") + sqlite3_errmsg(database) + ")");
  }
  if (result == SQLITE_CANTOPEN) {
    // A log left behind by a crash, or by another user: reading it takes a file beside it.
    throw unreadable(path, "cannot be read here: copy it, and " + path.filename().string() +
                               "-wal with it, to a folder that you may write to");
  }
  if (result != SQLITE_OK) {
    throw unreadable(path, std::string("cannot be read: ") + sqlite3_errmsg(database));
  }
  return Statement(statement);
}

std::vector<std::uint8_t> blob(sqlite3_stmt* row, int column) {
  const auto* bytes = static_cast<const std::uint8_t*>(sqlite3_column_blob(row, column));
  const int size = sqlite3_column_bytes(row, column);
  return bytes == nullptr ? std::vector<std::uint8_t>()
                          : std::vector<std::uint8_t>(bytes, bytes + size);
}

bool next_row(sqlite3* database, const std::filesystem::path& path, sqlite3_stmt* statement) {
  const int result = sqlite3_step(statement);
  if (result != SQLITE_ROW && result != SQLITE_DONE) {
    throw unreadable(path, std::string("cannot be read: ") + sqlite3_errmsg(database));
  }
  return result == SQLITE_ROW;
}

}  // namespace

void MapFile::Close::operator()(sqlite3* database) const {
  sqlite3_close(database);
}

MapFile::MapFile(const std::filesystem::path& path) : path_(path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) {
    if (std::filesystem::is_directory(path, error)) {
      throw unreadable(path, "expected a file, got a folder");
    }
    throw unreadable(path, std::filesystem::exists(path, error) ? "is no regular file"
                                                                : "there is no such file");
  }
  if (!std::ifstream(path, std::ios::binary)) {
    throw unreadable(path, "cannot be opened for reading");
  }
  // Without a log beside it nobody has the file open. Immutable then, or SQLite would create files
  // of its own beside the map, and refuse on a medium that does not let it.
  const bool is_at_rest =
      has_write_ahead_log(path) && !std::filesystem::exists(path.string() + "-wal", error);
  open(uri_of(path, is_at_rest ? "immutable=1" : "mode=ro"));
  read_meta();
}

void MapFile::open(const std::string& uri) {
  sqlite3* database = nullptr;
  const int result =
      sqlite3_open_v2(uri.c_str(), &database, SQLITE_OPEN_READONLY | SQLITE_OPEN_URI, nullptr);
  database_.reset(database);
  if (result != SQLITE_OK) {
    throw unreadable(path_, std::string("cannot be opened: ") + sqlite3_errstr(result));
  }
  sqlite3_busy_timeout(database, 2'000);
  // The file may come from anywhere: its schema must not run anything.
  sqlite3_db_config(database, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
  sqlite3_db_config(database, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
}

void MapFile::read_meta() {
  const Statement rows = prepare(database_.get(), path_, "SELECT key, value FROM meta");
  while (next_row(database_.get(), path_, rows.get())) {
    meta_[column_text(rows.get(), 0)] = column_text(rows.get(), 1);
  }
  if (meta_["application"] != "cairn") {
    throw unreadable(path_, "is no cairn map");
  }
  if (meta_["format_version"] != kFormatVersion) {
    throw unreadable(path_, "is a cairn map of format " + printable(meta_["format_version"]) +
                                "; this program reads format " + kFormatVersion);
  }
}

std::map<std::int32_t, MapFile::Document> MapFile::documents() const {
  const Statement rows =
      prepare(database_.get(), path_, "SELECT what, revision, length(bytes) FROM document");
  std::map<std::int32_t, Document> documents;
  while (next_row(database_.get(), path_, rows.get())) {
    documents[sqlite3_column_int(rows.get(), 0)] = {sqlite3_column_int64(rows.get(), 1),
                                                    sqlite3_column_int64(rows.get(), 2)};
  }
  return documents;
}

std::int64_t MapFile::row_count(const std::string& table) const {
  const Statement found = prepare(database_.get(), path_,
                                  "SELECT 1 FROM sqlite_schema WHERE type = 'table' AND name = ?");
  sqlite3_bind_text(found.get(), 1, table.c_str(), -1, SQLITE_TRANSIENT);
  if (!next_row(database_.get(), path_, found.get())) {
    return -1;
  }
  std::string quoted = "\"";
  for (const char c : table) {
    quoted += c == '"' ? "\"\"" : std::string(1, c);
  }
  const Statement count = prepare(database_.get(), path_, "SELECT count(*) FROM " + quoted + "\"");
  return next_row(database_.get(), path_, count.get()) ? sqlite3_column_int64(count.get(), 0) : 0;
}

cairn_lcm::assertions_t MapFile::assertions() {
  cairn_lcm::assertions_t all{};
  if (row_count("assertion") < 0) {
    return all;  // A map from before there were assertions.
  }
  const Statement rows =
      prepare(database_.get(), path_,
              "SELECT kind, who, utime, after_visit, visit_a, visit_b, assertion "
              "FROM assertion ORDER BY step");
  const auto integer = [&](int column) { return sqlite3_column_int64(rows.get(), column); };
  while (next_row(database_.get(), path_, rows.get())) {
    const std::string kind = column_text(rows.get(), 0);
    if (kind == "retract") {
      const std::int64_t number = integer(6);
      if (number < 1 || number > static_cast<std::int64_t>(all.assertions.size())) {
        throw unreadable(
            path_, "takes back assertion " + std::to_string(number) + ", which was never made");
      }
      cairn_lcm::assertion_t& assertion = all.assertions[static_cast<std::size_t>(number) - 1];
      assertion.is_in_force = 0;
      assertion.retracted_by = column_text(rows.get(), 1);
      assertion.retracted_utime = integer(2);
      assertion.retracted_after_visits = integer(3);
      continue;
    }
    cairn_lcm::assertion_t assertion{};
    assertion.number = static_cast<std::int64_t>(all.assertions.size()) + 1;
    assertion.is_same = kind == "same" ? 1 : 0;
    assertion.visit_a = integer(4);
    assertion.visit_b = integer(5);
    assertion.place_a = assertion.place_b = -1;
    assertion.is_in_force = 1;
    assertion.who = column_text(rows.get(), 1);
    assertion.made_utime = integer(2);
    assertion.made_after_visits = integer(3);
    assertion.retracted_after_visits = -1;
    all.assertions.push_back(std::move(assertion));
  }
  all.num_assertions = static_cast<std::int32_t>(all.assertions.size());
  return all;
}

std::vector<std::uint8_t> MapFile::document_bytes(std::int32_t what) const {
  const Statement row =
      prepare(database_.get(), path_, "SELECT bytes FROM document WHERE what = ?");
  sqlite3_bind_int(row.get(), 1, what);
  if (!next_row(database_.get(), path_, row.get())) {
    throw unreadable(path_, std::string("holds no ") + name_of(what));
  }
  return blob(row.get(), 0);
}

template <typename Message>
Message MapFile::document(std::int32_t what) const {
  wire::Expected<Message> message = wire::from_document<Message>(document_bytes(what));
  if (!message) {
    throw unreadable(path_, std::string(name_of(what)) + ": " + message.error());
  }
  return *std::move(message);
}

cairn_lcm::topology_t MapFile::topology() {
  return document<cairn_lcm::topology_t>(cairn_lcm::snapshot_request_t::TOPOLOGY);
}

cairn_lcm::hypotheses_t MapFile::hypotheses() {
  return document<cairn_lcm::hypotheses_t>(cairn_lcm::snapshot_request_t::HYPOTHESES);
}

cairn_lcm::grid_map_t MapFile::global_map() {
  return document<cairn_lcm::grid_map_t>(cairn_lcm::snapshot_request_t::GLOBAL_MAP);
}

cairn_lcm::trajectory_t MapFile::trajectory() {
  return document<cairn_lcm::trajectory_t>(cairn_lcm::snapshot_request_t::TRAJECTORY);
}

cairn_lcm::visit_places_t MapFile::visit_places() {
  return document<cairn_lcm::visit_places_t>(cairn_lcm::snapshot_request_t::VISITS);
}

cairn_lcm::hypothesis_map_t MapFile::hypothesis_map(std::int64_t hypothesis_id) {
  cairn_lcm::hypothesis_map_t map{};
  map.topology = topology();
  const std::int64_t best = map.topology.hypothesis_id;
  if (best != hypothesis_id) {
    const std::vector<std::int64_t> live = hypotheses().id;
    const bool is_live = std::find(live.begin(), live.end(), hypothesis_id) != live.end();
    const std::string number = std::to_string(hypothesis_id);
    throw unreadable(
        path_, is_live
                   ? "holds the map of its best hypothesis only, which is " + std::to_string(best) +
                         ", not that of " + number + ": run cairnd --map with this file, and ask it"
                   : "has no live hypothesis " + number + "; expected one of " + listed(live));
  }
  map.hypothesis_id = best;
  map.utime = map.topology.utime;
  map.boot_id = map.topology.boot_id;
  map.map_id = map.topology.map_id;
  map.revision = map.topology.revision;
  map.global_map = global_map();
  map.trajectory = trajectory();
  map.visits = visit_places();
  return map;
}

cairn_lcm::perceived_place_t MapFile::perceived_place(std::int64_t visit) {
  const std::string of_visit = "what was seen at visit " + std::to_string(visit);
  if (row_count("perception") < 0) {
    throw unreadable(path_, "does not hold " + of_visit + ": it was made by an earlier cairnd");
  }
  const Statement row =
      prepare(database_.get(), path_, "SELECT bytes FROM perception WHERE visit = ?");
  sqlite3_bind_int64(row.get(), 1, visit);
  if (!next_row(database_.get(), path_, row.get())) {
    throw unreadable(path_, "does not hold " + of_visit);
  }
  wire::Expected<cairn_lcm::perceived_place_t> perceived =
      wire::from_document<cairn_lcm::perceived_place_t>(blob(row.get(), 0));
  if (!perceived) {
    throw unreadable(path_, of_visit + ": " + perceived.error());
  }
  return *std::move(perceived);
}

}  // namespace cairn::clients
