#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "layout/shared_layouts.hpp"
#include "lpm/local_mapper.hpp"
#include "lpm/localisation_watch.hpp"
#include "place/place_detector.hpp"
#include "sensing/scan_joiner.hpp"
#include "service/best_map.hpp"
#include "service/between_scans.hpp"
#include "service/mapping_service.hpp"
#include "service/visit_matcher.hpp"

namespace cairn {

/// The stages of a MappingService and what flows between them. Its functions are those of the
/// service.
class MappingService::Pipeline {
 public:
  Pipeline(const ServiceOptions& options, StageObserver observer);
  Pipeline(const Pipeline&) = delete;  // The tree's evidence points here.
  Pipeline& operator=(const Pipeline&) = delete;

  void join(const OdometrySample& sample);
  void join(LaserScan scan);
  void flush() { joiner_.flush(); }
  /// The data's way: scan and odometry → pose in the local map → place → experience → hypotheses →
  /// layout and trajectory.
  Updates perceive_joined();
  void close_open_visits(Updates* updates);

  void recall(PerceivedScan scan);
  Status recall(Visit visit);
  Updates resume();

  void name_place_of(VisitId visit, const std::string& name);
  Result<AssertionReport> assert_places(VisitId a, VisitId b, bool is_same, const Operator& by);
  Result<AssertionReport> retract(int assertion, const Operator& by);
  [[nodiscard]] std::optional<VisitId> first_visit(int place) const;

  [[nodiscard]] std::shared_ptr<const MapState> state() const;
  [[nodiscard]] Result<std::shared_ptr<const MapState>> state_of(std::int64_t hypothesis) const;
  [[nodiscard]] std::int64_t revision() const { return revision_; }
  [[nodiscard]] const Experience& experience() const { return experience_; }
  [[nodiscard]] const HypothesisTree& tree() const { return tree_; }
  [[nodiscard]] const OccupancyGrid& local_map() const { return local_mapper_.grid(); }
  [[nodiscard]] const LocalisationHealth& health() const { return watch_.health(); }
  [[nodiscard]] std::int64_t local_map_restarts() const { return local_mapper_.restarts(); }
  [[nodiscard]] const JoinerCounters& joiner_counters() const { return joiner_.counters(); }
  [[nodiscard]] double distinctiveness() const { return place_detector_.island().distinctiveness; }
  [[nodiscard]] const PlaceDetectorReport& place_report() const { return place_detector_.report(); }
  [[nodiscard]] GaussianPose T_global_robot() const {
    return compounded(T_global_anchor_, since_anchor_);
  }

 private:
  /// A hypothesis, as of its layout.
  struct LaidOut {
    HypothesisId id;
    TopologicalMap map;
  };

  void enter(Stage stage) const;

  // Perception: pipeline.cpp.

  /// Pose and map; the map takes up the scan only while the robot knows where it is.
  LocalFix localise(const JoinedScan& joined, Updates* updates);
  /// The local map is another one: what was seen of places so far is of the old one.
  void take_leave_of_map(LocalFix* fix, Updates* updates);
  /// Looks in the best map for a robot that has lost its local map.
  void relocalise(const PerceivedScan& scan, Updates* updates);
  void detect_places(const LocalFix& fix, Updates* updates);
  /// One step of experience: the tree grows, the best hypothesis is laid out.
  void take_up(Visit visit, Updates* updates);
  /// @pre the experience has the visit
  void grow(const View& view, Updates* updates);
  /// Whether this is the last visit, told once more: after a restart the detector sees its place
  /// again, and so it does where the input paused while the robot was there.
  [[nodiscard]] bool is_known(const PlaceVisit& visit) const;
  /// Two readings of the last visit's place lie less apart. @pre there is one
  [[nodiscard]] double spot_of_last_visit_m() const;
  /// Whether the robot turned around on its way and is back at the last visit's place: that visit
  /// is continued then.
  bool turns_around(const Visit& visit);

  // The map: pipeline_map.cpp.

  [[nodiscard]] Evidence evidence() const;
  /// Only where maps are compared, and a star may be misread.
  [[nodiscard]] bool recalls_stars() const;
  /// The tree has been grown anew.
  void take_in(const AssertionReport& report);
  void lay_out();
  /// Every scan so far in the global frame.
  [[nodiscard]] std::vector<PosedScan> trajectory(const MetricalMap& metrical) const;
  [[nodiscard]] int nearest_place(const Vector2d& p_global, double* distance_m) const;
  /// From here on the robot's pose is this place's, and the motions since.
  void anchor_robot();
  /// What there is without a map, and where it lies.
  [[nodiscard]] std::shared_ptr<MapState> picture_of(const MetricalMap& metrical) const;
  void tell_map(const LaidOut& laid_out, const MetricalMap& metrical, MapState* state) const;
  void tell_hypotheses(MapState* state) const;

  ServiceOptions options_;
  StageObserver observer_;
  ScanJoiner joiner_;
  BetweenScans between_scans_;
  LocalMapper local_mapper_;
  LocalisationWatch watch_;
  LocalisationHealth told_health_;
  Relocaliser relocaliser_;
  std::int64_t relocalisations_ = 0;
  PlaceDetector place_detector_;
  Experience experience_;
  VisitMatcher matcher_;
  mutable SharedLayouts layouts_;  ///< Of the hypotheses; a memo.
  HypothesisTree tree_;
  std::optional<LaidOut> laid_out_;       ///< The best one, as of the last layout.
  MetricalMap metrical_;                  ///< Of that hypothesis.
  std::map<VisitId, std::string> names_;  ///< Given by people, to the place of a visit.
  OperatorLog operator_log_;
  std::string blamed_;            ///< By the last repair.
  GaussianPose T_global_anchor_;  ///< The robot at the last visit's anchor.
  GaussianPose since_anchor_;     ///< Its motion since.
  std::int64_t revision_ = 0;
  std::int64_t refuted_ = 0;
  std::int64_t refused_visits_ = 0;
  bool resumed_ = false;  ///< And no visit to elsewhere has come since.
};

}  // namespace cairn
