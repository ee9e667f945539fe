#include "storage/database.hpp"

#include <sqlite3.h>

namespace cairn {
namespace {

Error error_of(sqlite3* database, const std::string& what) {
  const int code = sqlite3_errcode(database);
  const bool is_damaged = code == SQLITE_NOTADB || code == SQLITE_CORRUPT;
  return {is_damaged ? ErrorCode::kMalformed : ErrorCode::kUnavailable,
          what + ": " + sqlite3_errmsg(database)};
}

}  // namespace

void Statement::Finalizer::operator()(sqlite3_stmt* statement) const {
  sqlite3_finalize(statement);
}

// A bind fails only for want of memory or a wrong index; `step` then reports the same error.
Statement& Statement::bind(int parameter, std::int64_t value) {
  sqlite3_bind_int64(statement_.get(), parameter + 1, value);
  return *this;
}

Statement& Statement::bind(int parameter, const std::string& value) {
  sqlite3_bind_text(statement_.get(), parameter + 1, value.c_str(), static_cast<int>(value.size()),
                    SQLITE_TRANSIENT);  // NOLINT: the macro casts
  return *this;
}

Statement& Statement::bind(int parameter, const std::vector<std::uint8_t>& value) {
  sqlite3_bind_blob64(statement_.get(), parameter + 1, value.data(), value.size(), SQLITE_STATIC);
  return *this;
}

Result<bool> Statement::step() {
  const int code = sqlite3_step(statement_.get());
  if (code == SQLITE_ROW) {
    return true;
  }
  if (code == SQLITE_DONE) {
    return false;
  }
  return error_of(sqlite3_db_handle(statement_.get()), "map file");
}

Status Statement::run() {
  const Result<bool> row = step();
  reset();
  if (!row) {
    return row.error();
  }
  return {};
}

void Statement::reset() {
  sqlite3_reset(statement_.get());
  sqlite3_clear_bindings(statement_.get());
}

std::int64_t Statement::integer(int column) const {
  return sqlite3_column_int64(statement_.get(), column);
}

std::string Statement::text(int column) const {
  const unsigned char* const text = sqlite3_column_text(statement_.get(), column);
  return text == nullptr ? std::string()
                         : std::string(text, text + sqlite3_column_bytes(statement_.get(), column));
}

std::vector<std::uint8_t> Statement::bytes(int column) const {
  const auto* const bytes =
      static_cast<const std::uint8_t*>(sqlite3_column_blob(statement_.get(), column));
  if (bytes == nullptr) {
    return {};
  }
  return {bytes, bytes + sqlite3_column_bytes(statement_.get(), column)};
}

void Database::Closer::operator()(sqlite3* database) const {
  sqlite3_close_v2(database);
}

Result<Database> Database::open(const std::string& file) {
  sqlite3* handle = nullptr;
  const int code =
      sqlite3_open_v2(file.c_str(), &handle, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE, nullptr);
  Database database(handle);
  if (code != SQLITE_OK) {
    return error_of(handle, file);
  }
  sqlite3_busy_timeout(handle, 5000);
  return database;
}

Status Database::execute(const std::string& sql) {
  if (sqlite3_exec(database_.get(), sql.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK) {
    return error_of(database_.get(), "map file");
  }
  return {};
}

Result<Statement> Database::prepare(const std::string& sql) {
  sqlite3_stmt* statement = nullptr;
  if (sqlite3_prepare_v2(database_.get(), sql.c_str(), -1, &statement, nullptr) != SQLITE_OK) {
    return error_of(database_.get(), "map file");
  }
  return Statement(statement);
}

bool Database::is_in_transaction() const {
  return sqlite3_get_autocommit(database_.get()) == 0;
}

}  // namespace cairn
