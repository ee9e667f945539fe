#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "base/result.hpp"

struct sqlite3;
struct sqlite3_stmt;

namespace cairn {

/// A prepared SQL statement. Parameters and columns count from 0.
class Statement {
 public:
  Statement() = default;
  explicit Statement(sqlite3_stmt* statement) : statement_(statement) {}

  Statement& bind(int parameter, std::int64_t value);
  Statement& bind(int parameter, const std::string& value);
  /// The bytes must stay until the next `step` or `run`.
  Statement& bind(int parameter, const std::vector<std::uint8_t>& value);

  /// To the next row: true where there is one.
  Result<bool> step();
  /// Runs a statement without rows, and makes it ready for the next time.
  Status run();
  /// Makes it ready for the next time.
  void reset();

  [[nodiscard]] std::int64_t integer(int column) const;
  [[nodiscard]] std::string text(int column) const;
  [[nodiscard]] std::vector<std::uint8_t> bytes(int column) const;

 private:
  struct Finalizer {
    void operator()(sqlite3_stmt* statement) const;
  };
  std::unique_ptr<sqlite3_stmt, Finalizer> statement_;
};

/// An SQLite database, with errors as values.
class Database {
 public:
  /// Opens a file for reading and writing, creates it where there is none.
  [[nodiscard]] static Result<Database> open(const std::string& file);

  /// Runs statements without parameters and rows.
  Status execute(const std::string& sql);
  [[nodiscard]] Result<Statement> prepare(const std::string& sql);
  [[nodiscard]] bool is_in_transaction() const;

 private:
  struct Closer {
    void operator()(sqlite3* database) const;
  };
  explicit Database(sqlite3* database) : database_(database) {}

  std::unique_ptr<sqlite3, Closer> database_;
};

}  // namespace cairn
