#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lpm/localisation_health.hpp"
#include "sensing/odometry.hpp"
#include "sensing/scan_joiner.hpp"
#include "service/experience.hpp"
#include "service/map_state.hpp"
#include "service/operator_log.hpp"
#include "service/options.hpp"
#include "service/relocaliser.hpp"
#include "topology/hypothesis_tree.hpp"

namespace cairn {

/// What one input made known. In the order in which it must be journalled: scans, then visits.
struct Updates {
  std::vector<PerceivedScan> scans;
  std::vector<PlaceEvent> events;
  std::vector<Visit> visits;             ///< Closed ones, which extended the map.
  std::vector<ExtendReport> extensions;  ///< One for each visit but the very first.
  bool is_map_changed = false;
  std::optional<Relocalisation> relocalised;  ///< A lost robot was found in the map.
  bool is_health_changed = false;             ///< MappingService::health() has news.
};

/// The stages of the pipeline, for whoever measures them.
enum class Stage { kJoining, kLocalMapping, kPlaces, kTopology, kLayout, kIdle };

/// Told when a stage begins; kIdle when the call ends. The library itself reads no clock.
using StageObserver = std::function<void(Stage)>;

/// The whole pipeline from readings to the map; pipeline.cpp is the page on which the data's way
/// reads straight through. The daemon feeds and drains it, live or from a log, by the same calls.
///
/// Pure: no clock, no thread, no file. The same inputs give the same outputs, bit for bit, and the
/// journal of its updates, recalled, gives the same map.
class MappingService {
 public:
  /// @pre validate(options).ok()
  explicit MappingService(const ServiceOptions& options, StageObserver observer = {});
  ~MappingService();
  MappingService(const MappingService&) = delete;
  MappingService& operator=(const MappingService&) = delete;
  MappingService(MappingService&&) = delete;
  MappingService& operator=(MappingService&&) = delete;

  /// @pre the value is valid
  Updates absorb(const OdometrySample& sample);
  Updates absorb(LaserScan scan);
  /// The input has ended or paused: whatever waits is taken up, and the visit that is still open.
  /// More input may come; a robot that has stayed where it was is not at a new visit then.
  Updates finish();

  /// Takes the journal up again, in its order; afterwards `resume` once. Then everything goes on as
  /// if there had been no restart. `resume` may find a visit that the journal does not have yet.
  void recall(PerceivedScan scan);
  /// kInvalidValue for a visit that does not follow from the scans recalled so far.
  Status recall(Visit visit);
  Updates resume();

  /// Calls the place that this visit was to by a name, in whatever map; empty takes it away.
  /// @pre the visit is in the experience
  void name_place_of(VisitId visit, const std::string& name);
  /// The first visit to a place of the best map; nothing where there is no such place.
  [[nodiscard]] std::optional<VisitId> first_visit(int place) const;

  /// An operator says that two visits were, or were not, to the same place: the tree is grown anew
  /// and the best map laid out. An error, and nothing changed, as of HypothesisTree::assert_places.
  /// Part of the experience: it is recalled where it was made, between visits and scans.
  Result<AssertionReport> assert_places(VisitId a, VisitId b, bool is_same, const Operator& by);
  /// Takes an assertion back. An error, and nothing changed, if none by that number is in force.
  Result<AssertionReport> retract(int assertion, const Operator& by);

  /// The best map with everything that is published of it.
  [[nodiscard]] std::shared_ptr<const MapState> state() const;

  /// The same of any live hypothesis, laid out for the asking: as long as a visit takes to be laid
  /// out. Of the best one equal to state(). Nothing here changes by it.
  /// kNotFound where none by that id is live, with those that are; an error as of solve_layout
  /// where its layout does not converge.
  [[nodiscard]] Result<std::shared_ptr<const MapState>> state_of(std::int64_t hypothesis) const;

  /// Of the best map: goes up with every change. state() has it too, at a higher price.
  [[nodiscard]] std::int64_t revision() const;

  [[nodiscard]] const Experience& experience() const;
  [[nodiscard]] const HypothesisTree& tree() const;
  [[nodiscard]] const OccupancyGrid& local_map() const;
  /// How far the robot's pose is to be relied on, as of the last reading.
  [[nodiscard]] const LocalisationHealth& health() const;
  /// How often the local map was started afresh.
  [[nodiscard]] std::int64_t local_map_restarts() const;
  /// How well the walls around tell the robot's pose: see place/island.hpp; [0, 1].
  [[nodiscard]] double distinctiveness() const;
  [[nodiscard]] const JoinerCounters& joiner_counters() const;
  [[nodiscard]] const PlaceDetectorReport& place_report() const;
  /// Where the robot is in the frame of the best map, as of the last scan: the place of the last
  /// visit and the dead reckoning since, compounded.
  [[nodiscard]] GaussianPose T_global_robot() const;

 private:
  class Pipeline;
  std::unique_ptr<Pipeline> pipeline_;
};

}  // namespace cairn
