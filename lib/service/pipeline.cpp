// The data's way, from scans and odometry to visits.

#include "service/pipeline.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "base/check.hpp"
#include "service/recalled_readings.hpp"
#include "service/turn_around.hpp"

namespace cairn {
namespace {

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

MappingService::Pipeline::Pipeline(const ServiceOptions& options, StageObserver observer)
    : options_(options),
      observer_(std::move(observer)),
      joiner_(options.joiner),
      local_mapper_(options.lpm),
      watch_(options.localisation),
      relocaliser_(options.relocalisation),
      place_detector_(options.place),
      matcher_(experience_, options.recognition),
      layouts_(options.layout),
      tree_(options.topology, evidence()) {}

void MappingService::Pipeline::join(const OdometrySample& sample) {
  watch_.heard_odometry(sample.time);
  joiner_.add(sample);
  between_scans_.add(sample);
}

void MappingService::Pipeline::join(LaserScan scan) {
  watch_.heard_scan(scan.time);
  joiner_.add(std::move(scan));
}

Updates MappingService::Pipeline::perceive_joined() {
  Updates updates;
  enter(Stage::kJoining);
  while (std::optional<JoinedScan> joined = joiner_.next()) {
    enter(Stage::kLocalMapping);
    const LocalFix fix = localise(*joined, &updates);
    std::vector<OdometrySample> between =
        between_scans_.take(joined->scan.time, joined->T_odom_robot);
    PerceivedScan perceived{std::make_shared<const LaserScan>(std::move(joined->scan)), fix,
                            joined->T_odom_robot, std::move(between),
                            watch_.may_map() && fix.note != FixNote::kBlockedSensor};
    since_anchor_ = compounded(since_anchor_, fix.motion);
    relocalise(perceived, &updates);
    experience_.add(perceived);
    updates.scans.push_back(std::move(perceived));
    if (watch_.may_see_places()) {
      detect_places(fix, &updates);
    }
    enter(Stage::kJoining);
  }
  updates.is_health_changed = !is_alike(told_health_, watch_.health());
  told_health_ = watch_.health();
  enter(Stage::kIdle);
  return updates;
}

LocalFix MappingService::Pipeline::localise(const JoinedScan& joined, Updates* updates) {
  const std::int64_t restarts = local_mapper_.restarts();
  LocalFix fix = local_mapper_.locate(joined);
  watch_.observe(fix, joined.T_odom_robot.has_value());
  if (watch_.needs_new_map()) {
    local_mapper_.start_anew();
  } else if (watch_.may_map()) {
    local_mapper_.take_up(fix);
  }
  if (local_mapper_.restarts() != restarts) {
    watch_.started_new_map();
    take_leave_of_map(&fix, updates);
  }
  return fix;
}

void MappingService::Pipeline::relocalise(const PerceivedScan& scan, Updates* updates) {
  std::optional<Relocalisation> found = relocaliser_.absorb(*scan.scan, scan.fix.motion);
  if (found) {
    found->number = ++relocalisations_;
    found->place = nearest_place(found->T_global_robot.mean.translation(), &found->distance_m);
    updates->relocalised = *found;
  }
}

void MappingService::Pipeline::take_leave_of_map(LocalFix* fix, Updates* updates) {
  close_open_visits(updates);
  enter(Stage::kLocalMapping);
  relocaliser_.start(trajectory(metrical_));
  const double way_m = options_.localisation.unknown_way_m;
  const double turn_rad = options_.localisation.unknown_turn_rad;
  fix->motion.covariance.diagonal() += Eigen::Vector3d(way_m, way_m, turn_rad).cwiseAbs2();
}

void MappingService::Pipeline::close_open_visits(Updates* updates) {
  if (experience_.scans().empty()) {
    return;
  }
  for (PlaceVisit& visit : place_detector_.finish()) {
    take_up(experience_.anchored(std::move(visit)), updates);
  }
  enter(Stage::kIdle);
}

void MappingService::Pipeline::recall(PerceivedScan scan) {
  since_anchor_ = compounded(since_anchor_, scan.fix.motion);
  experience_.add(std::move(scan));
}

Status MappingService::Pipeline::recall(Visit visit) {
  const std::size_t earliest =
      experience_.visits().empty() ? 0 : experience_.visits().back().anchor_scan;
  if (visit.anchor_scan < earliest || visit.anchor_scan >= experience_.scans().size()) {
    return Error{ErrorCode::kInvalidValue,
                 "visit " + std::to_string(experience_.visits().size()) + " is anchored at scan " +
                     std::to_string(visit.anchor_scan) + ", expected one in [" +
                     std::to_string(earliest) + ", " + std::to_string(experience_.scans().size()) +
                     ")"};
  }
  Updates unused;
  take_up(std::move(visit), &unused);
  return {};
}

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
  for (std::size_t i = scans.size() - 1; i > first; --i) {
    first = is_way_unknown(scans[i].fix.motion) ? i : first;
  }
  for (std::size_t i = first; i < scans.size(); ++i) {
    watch_.observe(scans[i].fix, scans[i].T_odom_robot.has_value());
    if (i > 0 && is_way_unknown(scans[i].fix.motion)) {
      watch_.started_new_map();
    }
    local_mapper_.restore(*scans[i].scan, scans[i].fix.T_lpm_robot, scans[i].T_odom_robot,
                          watch_.may_map());
    if (i >= looks_from && watch_.may_see_places()) {
      detect_places(scans[i].fix, &updates);
    }
  }
  return updates;
}

void MappingService::Pipeline::detect_places(const LocalFix& fix, Updates* updates) {
  enter(Stage::kPlaces);
  for (PlaceEvent& event :
       place_detector_.observe(fix.time, fix.T_lpm_robot, local_mapper_.grid())) {
    if (event.visit) {
      take_up(experience_.anchored(*event.visit), updates);
    }
    updates->events.push_back(std::move(event));
  }
}

void MappingService::Pipeline::take_up(Visit visit, Updates* updates) {
  if (visit.perceived.neighbourhood.gateways.empty() || is_known(visit.perceived)) {
    return;
  }
  const VisitId id{static_cast<int>(experience_.visits().size())};
  if (turns_around(visit)) {
    updates->visits.push_back(std::move(visit));
    return;
  }
  View view{visit.perceived.neighbourhood.star, std::max(visit.perceived.arrival_gateway, 0), id};
  for (const StarReading& reading : visit.perceived.neighbourhood.others) {
    if (validate(Reading{reading.star, reading.gateways, reading.log_likelihood},
                 gateway_count(view.star), view.arrival_gateway)) {
      view.others.push_back({reading.star, reading.gateways, reading.log_likelihood});
    }
  }
  if (!validate(view)) {
    ++refused_visits_;  // A star beyond what the tree takes up; a later visit may see it better.
    return;
  }
  resumed_ = false;
  enter(Stage::kTopology);
  experience_.add(visit);
  if (recalls_stars()) {
    for (Reading& reading : recalled_readings(experience_, matcher_, view, options_.recall)) {
      view.others.push_back(std::move(reading));
    }
  }
  grow(view, updates);
  ++revision_;
  enter(Stage::kLayout);
  lay_out();
  enter(Stage::kPlaces);
  updates->visits.push_back(std::move(visit));
  updates->is_map_changed = true;
}

void MappingService::Pipeline::grow(const View& view, Updates* updates) {
  const std::vector<Visit>& visits = experience_.visits();
  if (!tree_.is_started()) {
    CAIRN_CHECK(tree_.start(view).ok());
  } else {
    const Action action = action_between(visits[view.visit.index() - 1].perceived,
                                         visits[view.visit.index()].perceived);
    Result<ExtendReport> report = tree_.extend(action, view);
    CAIRN_CHECK(report.ok());
    refuted_ += refuted_by(*report);
    if (report->repair) {
      blamed_ = to_text(report->repair->blamed);
    }
    updates->extensions.push_back(*std::move(report));
  }
}

bool MappingService::Pipeline::is_known(const PlaceVisit& visit) const {
  if (experience_.visits().empty()) {
    return false;
  }
  const PlaceVisit& last = experience_.visits().back().perceived;
  const bool is_at_its_spot =
      (visit.T_lpm_place.translation() - last.T_lpm_place.translation()).norm() <
      spot_of_last_visit_m();
  return is_at_its_spot && !experience_.is_way_unknown_since_last_visit() &&
         (resumed_ || last.departure_gateway < 0);
}

double MappingService::Pipeline::spot_of_last_visit_m() const {
  return std::max(options_.place.same_spot_m,
                  0.5 * experience_.visits().back().perceived.neighbourhood.radius_m);
}

bool MappingService::Pipeline::turns_around(const Visit& visit) {
  if (experience_.visits().empty() || experience_.is_way_unknown_since_last_visit()) {
    return false;
  }
  // Within this travel the local map still has the place where it was, so that its frame has not
  // drifted.
  const std::vector<PerceivedScan>& scans = experience_.scans();
  double way_m = 0.0;
  for (std::size_t i = experience_.visits().back().anchor_scan + 1; i <= visit.anchor_scan; ++i) {
    way_m += scans[i].fix.motion.mean.translation().norm();
  }
  if (way_m > options_.lpm.map.memory_travel_m) {
    return false;
  }
  const std::optional<int> departure = departure_after_turning_around(
      experience_.visits().back().perceived, visit.perceived, spot_of_last_visit_m());
  if (departure) {
    experience_.continue_last_visit(visit.perceived.left, *departure);
  }
  return departure.has_value();
}

void MappingService::Pipeline::enter(Stage stage) const {
  if (observer_) {
    observer_(stage);
  }
}

}  // namespace cairn
