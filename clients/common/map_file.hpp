#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "clients/common/map_source.hpp"

struct sqlite3;

namespace cairn::clients {

/// A map file (SQLite), read without a daemon and never written to. Works on a file that a daemon
/// has open, on a read-only medium, and after a crash; every document is then the last one saved.
class MapFile final : public MapSource {
 public:
  /// A row of the table of documents.
  struct Document {
    std::int64_t revision = 0;
    std::int64_t size_bytes = 0;
  };

  /// Throws Failure(kBadData) for a file that is no cairn map, or of a format not known.
  explicit MapFile(const std::filesystem::path& path);

  [[nodiscard]] cairn_lcm::topology_t topology() override;
  [[nodiscard]] cairn_lcm::hypotheses_t hypotheses() override;
  [[nodiscard]] cairn_lcm::grid_map_t global_map() override;
  [[nodiscard]] cairn_lcm::trajectory_t trajectory() override;
  /// From the journal, so none is missing that was acknowledged. What each did is not in the file.
  [[nodiscard]] cairn_lcm::assertions_t assertions() override;

  [[nodiscard]] cairn_lcm::visit_places_t visit_places() override;
  [[nodiscard]] cairn_lcm::perceived_place_t perceived_place(std::int64_t visit) override;

  /// Of the best hypothesis alone: a map file holds the drawing of no other.
  [[nodiscard]] cairn_lcm::hypothesis_map_t hypothesis_map(std::int64_t hypothesis_id) override;

  /// The table `meta`.
  [[nodiscard]] const std::map<std::string, std::string>& meta() const { return meta_; }
  /// Which documents there are, by `what` of snapshot_request_t.
  [[nodiscard]] std::map<std::int32_t, Document> documents() const;
  /// Number of rows of a table of the journal; -1 where there is no such table.
  [[nodiscard]] std::int64_t row_count(const std::string& table) const;

 private:
  struct Close {
    void operator()(sqlite3* database) const;
  };

  void open(const std::string& uri);
  void read_meta();
  [[nodiscard]] std::vector<std::uint8_t> document_bytes(std::int32_t what) const;
  template <typename Message>
  [[nodiscard]] Message document(std::int32_t what) const;

  std::filesystem::path path_;
  std::unique_ptr<sqlite3, Close> database_;
  std::map<std::string, std::string> meta_;
};

}  // namespace cairn::clients
