// The journal of a map file: reading it back in its order, and what operators said.

#include <array>
#include <limits>

#include "storage/journal_codec.hpp"
#include "storage/map_file.hpp"

namespace cairn {
namespace {

constexpr std::array<const char*, 3> kKinds = {"same", "different", "retract"};

Error error_in(const std::string& table, std::int64_t number, const std::string& why) {
  return {ErrorCode::kMalformed,
          "map file: " + table + " " + std::to_string(number) + " is damaged: " + why};
}

/// A number of the file in a narrower type; -1 where it does not fit.
std::int32_t narrowed(std::int64_t value) {
  const bool fits = value >= 0 && value <= std::numeric_limits<std::int32_t>::max();
  return fits ? static_cast<std::int32_t>(value) : -1;
}

/// Columns: utime, who, kind, visit_a, visit_b, assertion, client_id, request_id.
Result<OperatorOrder> order_of_row(const Statement& row, int first_column) {
  const auto integer = [&](int column) { return row.integer(first_column + column); };
  const std::string kind = row.text(first_column + 2);
  OperatorOrder order;
  std::size_t known = 0;
  while (known < kKinds.size() && kind != kKinds[known]) {
    ++known;
  }
  if (known == kKinds.size()) {
    return Error{ErrorCode::kMalformed, "it is of no known kind"};
  }
  order.kind = static_cast<OperatorOrder::Kind>(known);
  order.by = {row.text(first_column + 1), time_of_utime(integer(0))};
  order.a = VisitId{narrowed(integer(3))};
  order.b = VisitId{narrowed(integer(4))};
  order.assertion = narrowed(integer(5));
  order.client_id = integer(6);
  order.request_id = static_cast<std::int32_t>(integer(7));
  return order;
}

/// One reading of the journal, from its beginning.
class JournalReading {
 public:
  JournalReading(const MapFile::JournalReader& reader,
                 Statement scans,
                 Statement visits,
                 Statement orders)
      : reader_(reader),
        scans_(std::move(scans)),
        visits_(std::move(visits)),
        orders_(std::move(orders)) {}

  Status run(std::int64_t scan_count, std::int64_t visit_count) {
    Status status = next_order();
    for (std::int64_t visit = 0; status && visit < visit_count; ++visit) {
      status = take_orders_after(visit);
      if (status) {
        status = read_visit(visit);
      }
    }
    if (status) {
      status = take_orders_after(visit_count);
    }
    return status ? read_scans_until(scan_count) : status;
  }

 private:
  Status read_scans_until(std::int64_t end) {
    for (; scans_read_ < end; ++scans_read_) {
      const Result<bool> row = scans_.step();
      if (!row) {
        return row.error();
      }
      if (!*row || scans_.integer(0) != scans_read_) {
        return error_in("scan", scans_read_, "the row is missing");
      }
      Result<PerceivedScan> scan = scan_of_row(scans_.bytes(1));
      if (!scan) {
        return error_in("scan", scans_read_, scan.error().message);
      }
      reader_.take_scan(*std::move(scan));
    }
    return {};
  }

  Status read_visit(std::int64_t number) {
    const Result<bool> row = visits_.step();
    if (!row || !*row) {
      return error_in("visit", number, "the row is missing");
    }
    if (Status status = read_scans_until(visits_.integer(1)); !status) {
      return status;
    }
    Result<Visit> visit = visit_of_row(visits_.bytes(2));
    if (!visit) {
      return error_in("visit", number, visit.error().message);
    }
    const Status taken = reader_.take_visit(*std::move(visit));
    return taken ? taken : error_in("visit", number, taken.error().message);
  }

  Status next_order() {
    Result<bool> row = orders_.step();
    if (!row) {
      return row.error();
    }
    is_order_waiting_ = *row;
    return {};
  }

  Status take_orders_after(std::int64_t visits) {
    while (is_order_waiting_ && orders_.integer(2) <= visits) {
      const std::int64_t step = orders_.integer(0);
      if (Status status = read_scans_until(orders_.integer(1)); !status) {
        return status;
      }
      const Result<OperatorOrder> order = order_of_row(orders_, 3);
      if (!order) {
        return error_in("assertion row", step, order.error().message);
      }
      if (const Status taken = reader_.take_order(*order); !taken) {
        return error_in("assertion row", step, taken.error().message);
      }
      if (Status status = next_order(); !status) {
        return status;
      }
    }
    return {};
  }

  const MapFile::JournalReader& reader_;
  Statement scans_;
  Statement visits_;
  Statement orders_;
  std::int64_t scans_read_ = 0;
  bool is_order_waiting_ = false;
};

}  // namespace

Status MapFile::write_order(const OperatorOrder& order) {
  Result<Statement> statement = database_.prepare(
      "INSERT INTO assertion(after_scan, after_visit, utime, who, kind, visit_a, visit_b, "
      "assertion, client_id, request_id) VALUES(?, ?, ?, ?, ?, ?, ?, ?, ?, ?)");
  if (!statement) {
    return statement.error();
  }
  statement->bind(0, scan_count_)
      .bind(1, visit_count_)
      .bind(2, utime_of(order.by.when))
      .bind(3, order.by.who)
      .bind(4, std::string(kKinds[static_cast<std::size_t>(order.kind)]))
      .bind(5, std::int64_t{order.a.value})
      .bind(6, std::int64_t{order.b.value})
      .bind(7, std::int64_t{order.assertion})
      .bind(8, order.client_id)
      .bind(9, std::int64_t{order.request_id});
  if (Status status = begin(); !status) {
    return status;
  }
  if (Status status = statement->run(); !status) {
    return status;
  }
  return commit();
}

Status MapFile::read_journal(const JournalReader& reader) {
  Result<Statement> scans = database_.prepare("SELECT number, bytes FROM scan ORDER BY number");
  Result<Statement> visits =
      database_.prepare("SELECT number, after_scan, bytes FROM visit ORDER BY number");
  Result<Statement> orders = database_.prepare(
      "SELECT step, after_scan, after_visit, utime, who, kind, visit_a, visit_b, assertion, "
      "client_id, request_id FROM assertion ORDER BY step");
  for (const Result<Statement>* statement : {&scans, &visits, &orders}) {
    if (!*statement) {
      return statement->error();
    }
  }
  return JournalReading(reader, *std::move(scans), *std::move(visits), *std::move(orders))
      .run(scan_count_, visit_count_);
}

}  // namespace cairn
