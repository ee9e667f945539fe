#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <cairn_lcm/perceived_place_t.hpp>

#include "runtime/map_maker.hpp"
#include "runtime/stage_clock.hpp"
#include "sensing/odometry.hpp"
#include "service/mapping_service.hpp"
#include "storage/map_file.hpp"

namespace cairn {

/// A sound reading, as the inlets hand it on.
using SensorReading = std::variant<OdometrySample, LaserScan>;

/// The mapping service together with its map file: what is made known is in the journal first. Live
/// and in a replay the same; one owner, the mapping thread.
class Engine {
 public:
  /// Opens the map file and takes its journal up again.
  /// Errors as of MapFile::open; kMalformed where the journal is damaged.
  [[nodiscard]] static Result<std::unique_ptr<Engine>> open(const ServiceOptions& options,
                                                            const std::string& map_file);

  /// Takes a reading through the pipeline and what it gave into the journal. Visits are on the disk
  /// when this returns; scans with the next visit, `commit` or `close`.
  Updates take(SensorReading reading);
  /// The input has ended.
  Updates finish();

  /// Gives a place of the best map a name, on the disk first. kInvalidValue for a name that is not
  /// 1 to 64 bytes of text or is taken, kNotFound for a place that is not there.
  Status name_place(std::int64_t place, const std::string& name);

  /// Carries out what an operator asks for, on the disk first; an order that was carried out
  /// before, even by an earlier process, is answered alike and does nothing. Errors as of
  /// MappingService::assert_places and retract; kInvalidValue for a name of nobody. What is said
  /// already is answered with the assertion in force, and nothing is made of it. The map file then
  /// holds the new map for whoever reads it, but for the drawing.
  Result<AssertionReport> take(const OperatorOrder& order);

  /// What was seen of a place at a visit, as it was kept then; of a visit of which nothing was
  /// kept, what its stored map shows now. kNotFound where there is no such visit.
  [[nodiscard]] Result<cairn_lcm::perceived_place_t> perception(std::int64_t visit);

  /// Puts on the disk what is not there yet.
  void commit();
  void store(const Documents& documents);
  /// Everything is on the disk, in one file.
  Status close();

  /// Why the journal cannot be written; empty while all is well. What could not be written waits in
  /// memory, up to a bound, and is written when the disk takes it again.
  [[nodiscard]] const std::string& journal_trouble() const { return journal_trouble_; }

  [[nodiscard]] const MappingService& service() const { return *service_; }
  [[nodiscard]] const StageClock& stage_clock() const { return stage_clock_; }
  [[nodiscard]] double journal_seconds() const { return journal_seconds_; }
  [[nodiscard]] std::int64_t map_id() const { return map_file_.map_id(); }

 private:
  explicit Engine(const ServiceOptions& options, MapFile map_file);
  Status recall();
  [[nodiscard]] Status check(const OperatorOrder& order) const;
  Result<AssertionReport> carry_out(const OperatorOrder& order);
  [[nodiscard]] std::optional<AssertionReport> said_already(const OperatorOrder& order) const;
  void store_map();
  void journal(const Updates& updates);
  Status append(const PerceivedScan& scan);
  Status append(const Visit& visit);
  void write_waiting(bool commit);
  void bound_waiting();

  PlaceOptions place_options_;
  MapFile map_file_;
  StageClock stage_clock_;
  std::unique_ptr<MappingService> service_;
  std::vector<std::variant<PerceivedScan, Visit>> waiting_;  ///< Not committed yet, in order.
  std::size_t appended_ = 0;  ///< Of these, how many the open transaction holds.
  /// By client and request.
  std::map<std::pair<std::int64_t, std::int32_t>, AssertionReport> orders_done_;
  std::string journal_trouble_;
  bool is_journal_closed_ = false;  ///< For this run: the disk stayed full for too long.
  double journal_seconds_ = 0.0;
};

}  // namespace cairn
