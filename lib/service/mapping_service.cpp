#include "service/mapping_service.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>
#include <string>
#include <utility>

#include "base/check.hpp"
#include "lpm/local_mapper.hpp"
#include "place/place_detector.hpp"
#include "service/best_map.hpp"
#include "service/between_scans.hpp"
#include "service/visit_matcher.hpp"

namespace cairn {
namespace {

/// Hypotheses that are told to clients; all live ones are counted.
constexpr std::size_t kToldHypotheses = 50;

Action action_between(const PlaceVisit& from, const PlaceVisit& to) {
  const int gateways = static_cast<int>(from.neighbourhood.gateways.size());
  const int arrival = std::max(from.arrival_gateway, 0);
  return {(departure_gateway(from, to) - arrival + gateways) % gateways};
}

/// Ways to extend a hypothesis that this arrival has ruled out.
std::int64_t refuted_by(const ExtendReport& report) {
  return std::accumulate(report.refuted.begin(), report.refuted.end(), std::int64_t{0}) -
         report.count(Refutation::kTooManyPlaces);
}

}  // namespace

/// The stages and what flows between them.
class MappingService::Pipeline {
 public:
  Pipeline(const ServiceOptions& options, StageObserver observer)
      : options_(options),
        observer_(std::move(observer)),
        joiner_(options.joiner),
        local_mapper_(options.lpm),
        place_detector_(options.place),
        matcher_(experience_, options.recognition),
        tree_(options.topology, evidence()) {}

  void join(const OdometrySample& sample) {
    joiner_.add(sample);
    between_scans_.add(sample);
  }
  void join(LaserScan scan) { joiner_.add(std::move(scan)); }
  void flush() { joiner_.flush(); }

  /// The data's way: scan and odometry → pose in the local map → place → experience → hypotheses →
  /// layout and trajectory.
  Updates perceive_joined() {
    Updates updates;
    enter(Stage::kJoining);
    while (std::optional<JoinedScan> joined = joiner_.next()) {
      enter(Stage::kLocalMapping);
      const LocalFix fix = local_mapper_.absorb(*joined);
      std::vector<OdometrySample> between =
          between_scans_.take(joined->scan.time, joined->T_odom_robot);
      PerceivedScan perceived{std::make_shared<const LaserScan>(std::move(joined->scan)), fix,
                              joined->T_odom_robot, std::move(between)};
      since_anchor_ = compounded(since_anchor_, fix.motion);
      experience_.add(perceived);
      updates.scans.push_back(std::move(perceived));
      detect_places(fix, &updates);
      enter(Stage::kJoining);
    }
    enter(Stage::kIdle);
    return updates;
  }

  void close_open_visits(Updates* updates) {
    if (experience_.scans().empty()) {
      return;
    }
    for (PlaceVisit& visit : place_detector_.finish()) {
      take_up(experience_.anchored(std::move(visit)), updates);
    }
    enter(Stage::kIdle);
  }

  void recall(PerceivedScan scan) {
    since_anchor_ = compounded(since_anchor_, scan.fix.motion);
    experience_.add(std::move(scan));
  }

  Status recall(Visit visit) {
    const std::size_t earliest =
        experience_.visits().empty() ? 0 : experience_.visits().back().anchor_scan;
    if (visit.anchor_scan < earliest || visit.anchor_scan >= experience_.scans().size()) {
      return Error{ErrorCode::kInvalidValue,
                   "visit " + std::to_string(experience_.visits().size()) +
                       " is anchored at scan " + std::to_string(visit.anchor_scan) +
                       ", expected one in [" + std::to_string(earliest) + ", " +
                       std::to_string(experience_.scans().size()) + ")"};
    }
    Updates unused;
    take_up(std::move(visit), &unused);
    return {};
  }

  Updates resume();

  void name_place_of(VisitId visit, const std::string& name) {
    CAIRN_CHECK(visit.index() < experience_.visits().size());
    const auto known = names_.find(visit);
    if (known == names_.end() ? name.empty() : known->second == name) {
      return;  // Asked again: nothing changes, so no new revision.
    }
    if (name.empty()) {
      names_.erase(visit);
    } else {
      names_[visit] = name;
    }
    ++revision_;
  }

  Result<AssertionReport> assert_places(VisitId a, VisitId b, bool is_same, const Operator& by) {
    Result<AssertionReport> report = tree_.assert_places(a, b, is_same, by.who);
    if (report) {
      operator_log_.made(*report, by.when);
      take_in(*report);
    }
    return report;
  }

  Result<AssertionReport> retract(int assertion, const Operator& by) {
    Result<AssertionReport> report = tree_.retract(assertion, by.who);
    if (report) {
      operator_log_.retracted(*report, by.when);
      take_in(*report);
    }
    return report;
  }

  [[nodiscard]] std::optional<VisitId> first_visit(int place) const {
    if (!laid_out_ || place < 0 || place >= laid_out_->map.place_count()) {
      return std::nullopt;
    }
    return laid_out_->map.first_visit(PlaceId{place});
  }

  [[nodiscard]] std::shared_ptr<const MapState> state() const;

  [[nodiscard]] std::int64_t revision() const { return revision_; }
  [[nodiscard]] const Experience& experience() const { return experience_; }
  [[nodiscard]] const HypothesisTree& tree() const { return tree_; }
  [[nodiscard]] const OccupancyGrid& local_map() const { return local_mapper_.grid(); }
  [[nodiscard]] const JoinerCounters& joiner_counters() const { return joiner_.counters(); }
  [[nodiscard]] const PlaceDetectorReport& place_report() const { return place_detector_.report(); }
  [[nodiscard]] GaussianPose T_global_robot() const {
    return compounded(T_global_anchor_, since_anchor_);
  }

 private:
  [[nodiscard]] Evidence evidence() const {
    Evidence evidence;
    const Result<std::vector<EvidenceName>> names = evidence_named(options_.evidence);
    for (const EvidenceName name : *names) {
      if (name == EvidenceName::kPlaceMatch) {
        evidence.same_place = [this](SeenGateway known, SeenGateway now) {
          return matcher_.log_likelihood_ratio(known.visit, now.visit,
                                               {known.gateway, now.gateway});
        };
      } else {
        // The densities' normalisation is left out: it is the same for all maps of one experience.
        evidence.layout = [this](const TopologicalMap& map) {
          const Result<PlaceLayout> layout =
              solve_layout(map.place_count(), matcher_.constraints(map), options_.layout);
          return layout ? -0.5 * layout->chi2 : -std::numeric_limits<double>::infinity();
        };
      }
    }
    return evidence;
  }

  void detect_places(const LocalFix& fix, Updates* updates) {
    enter(Stage::kPlaces);
    for (PlaceEvent& event :
         place_detector_.observe(fix.time, fix.T_lpm_robot, local_mapper_.grid())) {
      if (event.visit) {
        take_up(experience_.anchored(*event.visit), updates);
      }
      updates->events.push_back(std::move(event));
    }
  }

  /// One step of experience: the tree grows, the best hypothesis is laid out.
  void take_up(Visit visit, Updates* updates) {
    if (visit.perceived.neighbourhood.gateways.empty() || is_known(visit.perceived)) {
      return;
    }
    const std::vector<Visit>& visits = experience_.visits();
    const VisitId id{static_cast<int>(visits.size())};
    const View view{visit.perceived.neighbourhood.star,
                    std::max(visit.perceived.arrival_gateway, 0), id};
    if (!validate(view)) {
      ++refused_visits_;  // A star beyond what the tree takes up; a later visit may see it better.
      return;
    }
    resumed_ = false;
    enter(Stage::kTopology);
    experience_.add(visit);
    if (!tree_.is_started()) {
      CAIRN_CHECK(tree_.start(view).ok());
    } else {
      const Action action = action_between(visits[id.index() - 1].perceived, visit.perceived);
      Result<ExtendReport> report = tree_.extend(action, view);
      CAIRN_CHECK(report.ok());
      refuted_ += refuted_by(*report);
      if (report->repair) {
        blamed_ = to_text(report->repair->blamed);
      }
      updates->extensions.push_back(*std::move(report));
    }
    ++revision_;
    enter(Stage::kLayout);
    lay_out();
    enter(Stage::kPlaces);
    updates->visits.push_back(std::move(visit));
    updates->is_map_changed = true;
  }

  /// The tree has been grown anew.
  void take_in(const AssertionReport& report) {
    blamed_ = report.repair ? to_text(report.repair->blamed) : "";
    ++revision_;
    enter(Stage::kLayout);
    lay_out();
    enter(Stage::kIdle);
  }

  /// Whether this is the last visit, told once more: after a restart the detector sees its place
  /// again, and so it does where the input paused while the robot was there.
  [[nodiscard]] bool is_known(const PlaceVisit& visit) const {
    if (experience_.visits().empty()) {
      return false;
    }
    const PlaceVisit& last = experience_.visits().back().perceived;
    const bool is_at_its_spot =
        (visit.T_lpm_place.translation() - last.T_lpm_place.translation()).norm() <
        std::max(options_.place.same_spot_m, 0.5 * last.neighbourhood.radius_m);
    return is_at_its_spot && (resumed_ || last.departure_gateway < 0);
  }

  void lay_out() {
    const HypothesisId best = tree_.best().id;
    TopologicalMap map = tree_.map(best);
    Result<MetricalMap> metrical = metrical_map(map, experience_, matcher_, options_.layout);
    // A layout that does not converge leaves the last one standing; the next visit tries again.
    if (metrical) {
      metrical_ = *std::move(metrical);
      laid_out_ = LaidOut{best, std::move(map)};
      anchor_robot();
    }
  }

  /// From here on the robot's pose is this place's, and the motions since.
  void anchor_robot() {
    const std::vector<PerceivedScan>& scans = experience_.scans();
    const std::size_t anchor = experience_.visits().back().anchor_scan;
    const std::size_t place = laid_out_->map.position().place.index();
    T_global_anchor_ = {metrical_.T_global_lpm * scans[anchor].fix.T_lpm_robot,
                        metrical_.layout.covariances[place] + scans[anchor].fix.covariance};
    since_anchor_ = {};
    for (std::size_t i = anchor + 1; i < scans.size(); ++i) {
      since_anchor_ = compounded(since_anchor_, scans[i].fix.motion);
    }
  }

  void enter(Stage stage) const {
    if (observer_) {
      observer_(stage);
    }
  }

  ServiceOptions options_;
  StageObserver observer_;
  ScanJoiner joiner_;
  BetweenScans between_scans_;
  LocalMapper local_mapper_;
  PlaceDetector place_detector_;
  Experience experience_;
  VisitMatcher matcher_;
  HypothesisTree tree_;
  /// The best hypothesis, as of the last layout.
  struct LaidOut {
    HypothesisId id;
    TopologicalMap map;
  };
  std::optional<LaidOut> laid_out_;
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

Updates MappingService::Pipeline::resume() {
  Updates updates;
  const std::vector<PerceivedScan>& scans = experience_.scans();
  if (scans.empty()) {
    return updates;
  }
  resumed_ = true;
  // The local map is made anew from the scans that it would still hold; the detector looks on from
  // the last visit's anchor, as it emits a visit only after the robot has reached the next place.
  const std::size_t looks_from =
      experience_.visits().empty() ? 0 : experience_.visits().back().anchor_scan;
  std::size_t first = looks_from;
  double travel_m = 0.0;
  while (first > 0 && travel_m < options_.lpm.map.memory_travel_m) {
    travel_m += scans[first].fix.motion.mean.translation().norm();
    --first;
  }
  for (std::size_t i = first; i < scans.size(); ++i) {
    local_mapper_.restore(*scans[i].scan, scans[i].fix.T_lpm_robot, scans[i].T_odom_robot);
    if (i >= looks_from) {
      detect_places(scans[i].fix, &updates);
    }
  }
  return updates;
}

std::shared_ptr<const MapState> MappingService::Pipeline::state() const {
  auto state = std::make_shared<MapState>();
  const std::vector<PerceivedScan>& scans = experience_.scans();
  state->topology_revision = revision_;
  state->visit_count = static_cast<std::int64_t>(experience_.visits().size());
  state->T_global_lpm = metrical_.T_global_lpm;
  for (std::size_t i = 0; i < scans.size(); ++i) {
    state->trajectory.push_back(
        {scans[i].scan, i < metrical_.trajectory.size()
                            ? metrical_.trajectory[i]
                            : metrical_.T_global_lpm * scans[i].fix.T_lpm_robot});
  }
  state->poses = with_poses_between(scans, state->trajectory);
  if (!scans.empty()) {
    state->time = scans.back().fix.time;
  }
  if (!laid_out_) {
    return state;
  }
  const LaidOut& best = *laid_out_;
  state->hypothesis = best.id.value;
  state->at_place = best.map.position().place.value;
  state->path_count = best.map.path_count();
  state->closure_count = best.map.closure_count();
  for (int v = 0; v < best.map.visit_count(); ++v) {
    state->place_of_visit.push_back(best.map.at_visit(VisitId{v}).place.value);
  }
  state->places = mapped_places(best.map, experience_, metrical_);
  for (const auto& [visit, name] : names_) {
    if (visit.index() < state->place_of_visit.size()) {
      state->places[static_cast<std::size_t>(state->place_of_visit[visit.index()])].name = name;
    }
  }
  state->segments =
      mapped_segments(best.map, experience_, metrical_.layout, matcher_.constraints(best.map));
  state->hypotheses = summaries(tree_, kToldHypotheses);
  state->probability = state->hypotheses.front().probability;
  state->live_count = tree_.live_count();
  state->waiting_count = tree_.waiting_count();
  state->refused_visits = refused_visits_;
  state->refuted_count = refuted_;
  state->blamed = blamed_;
  state->assertions = operator_log_.audited(tree_.assertions());
  if (tree_.guarantee_given_up()) {
    state->guarantee_given_up_at = tree_.guarantee_given_up()->visit.value;
    state->guarantee_reason = tree_.guarantee_given_up()->reason;
  }
  return state;
}

MappingService::MappingService(const ServiceOptions& options, StageObserver observer)
    : pipeline_(std::make_unique<Pipeline>(options, std::move(observer))) {
  CAIRN_CHECK(validate(options).ok());
}

MappingService::~MappingService() = default;

Updates MappingService::absorb(const OdometrySample& sample) {
  pipeline_->join(sample);
  return pipeline_->perceive_joined();
}

Updates MappingService::absorb(LaserScan scan) {
  pipeline_->join(std::move(scan));
  return pipeline_->perceive_joined();
}

Updates MappingService::finish() {
  pipeline_->flush();
  Updates updates = pipeline_->perceive_joined();
  pipeline_->close_open_visits(&updates);
  return updates;
}

void MappingService::recall(PerceivedScan scan) {
  pipeline_->recall(std::move(scan));
}
Status MappingService::recall(Visit visit) {
  return pipeline_->recall(std::move(visit));
}
Updates MappingService::resume() {
  return pipeline_->resume();
}
std::shared_ptr<const MapState> MappingService::state() const {
  return pipeline_->state();
}
std::int64_t MappingService::revision() const {
  return pipeline_->revision();
}
const Experience& MappingService::experience() const {
  return pipeline_->experience();
}
const HypothesisTree& MappingService::tree() const {
  return pipeline_->tree();
}
const OccupancyGrid& MappingService::local_map() const {
  return pipeline_->local_map();
}
const JoinerCounters& MappingService::joiner_counters() const {
  return pipeline_->joiner_counters();
}
const PlaceDetectorReport& MappingService::place_report() const {
  return pipeline_->place_report();
}
void MappingService::name_place_of(VisitId visit, const std::string& name) {
  pipeline_->name_place_of(visit, name);
}
Result<AssertionReport> MappingService::assert_places(VisitId a,
                                                      VisitId b,
                                                      bool is_same,
                                                      const Operator& by) {
  return pipeline_->assert_places(a, b, is_same, by);
}
Result<AssertionReport> MappingService::retract(int assertion, const Operator& by) {
  return pipeline_->retract(assertion, by);
}
std::optional<VisitId> MappingService::first_visit(int place) const {
  return pipeline_->first_visit(place);
}
GaussianPose MappingService::T_global_robot() const {
  return pipeline_->T_global_robot();
}

}  // namespace cairn
