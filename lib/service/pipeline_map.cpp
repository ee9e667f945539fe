// The best map: evidence for the tree, the layout of its best hypothesis, and what is told of it.

#include <algorithm>
#include <limits>
#include <utility>

#include "base/check.hpp"
#include "layout/exclusion.hpp"
#include "service/live_hypothesis.hpp"
#include "service/pipeline.hpp"

namespace cairn {
namespace {

/// Hypotheses that are told to clients; all live ones are counted.
constexpr std::size_t kToldHypotheses = 50;

}  // namespace

bool MappingService::Pipeline::recalls_stars() const {
  const std::vector<EvidenceName> names = *evidence_named(options_.evidence);
  return options_.topology.noisy_stars &&
         std::find(names.begin(), names.end(), EvidenceName::kPlaceMatch) != names.end();
}

Evidence MappingService::Pipeline::evidence() const {
  Evidence evidence;
  const Result<std::vector<EvidenceName>> names = evidence_named(options_.evidence);
  for (const EvidenceName name : *names) {
    if (name == EvidenceName::kPlaceMatch) {
      evidence.same_place = [this](SeenGateway known, SeenGateway now) {
        return matcher_.log_likelihood_ratio(known.visit, now.visit, {known.gateway, now.gateway});
      };
      evidence.log_prior_same = [this](VisitId known, VisitId now) {
        return matcher_.log_prior_same(known, now);
      };
      evidence.is_within_reach = [this](VisitId known, VisitId now) {
        return matcher_.is_within_reach(known, now);
      };
    } else {
      // The densities' normalisation is left out: it is the same for all maps of one experience.
      evidence.layout = [this](const TopologicalMap& map) {
        const std::vector<TravelConstraint> travels = matcher_.constraints_by_visit(map);
        const Result<LaidPlaces> layout = layouts_.lay_out(map.place_count(), travels);
        return layout ? -0.5 * (layout->chi2 + matcher_.chi2_of_unmatched(map)) +
                            log_exclusion(layout->T_global_place, travels,
                                          {options_.place.same_spot_m})
                      : -std::numeric_limits<double>::infinity();
      };
    }
  }
  return evidence;
}

void MappingService::Pipeline::name_place_of(VisitId visit, const std::string& name) {
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

Result<AssertionReport> MappingService::Pipeline::assert_places(VisitId a,
                                                                VisitId b,
                                                                bool is_same,
                                                                const Operator& by) {
  Result<AssertionReport> report = tree_.assert_places(a, b, is_same, by.who);
  if (report) {
    operator_log_.made(*report, by.when);
    take_in(*report);
  }
  return report;
}

Result<AssertionReport> MappingService::Pipeline::retract(int assertion, const Operator& by) {
  Result<AssertionReport> report = tree_.retract(assertion, by.who);
  if (report) {
    operator_log_.retracted(*report, by.when);
    take_in(*report);
  }
  return report;
}

std::optional<VisitId> MappingService::Pipeline::first_visit(int place) const {
  if (!laid_out_ || place < 0 || place >= laid_out_->map.place_count()) {
    return std::nullopt;
  }
  return laid_out_->map.first_visit(PlaceId{place});
}

void MappingService::Pipeline::take_in(const AssertionReport& report) {
  blamed_ = report.repair ? to_text(report.repair->blamed) : "";
  ++revision_;
  enter(Stage::kLayout);
  lay_out();
  enter(Stage::kIdle);
}

void MappingService::Pipeline::lay_out() {
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

void MappingService::Pipeline::anchor_robot() {
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

std::vector<PosedScan> MappingService::Pipeline::trajectory(const MetricalMap& metrical) const {
  const std::vector<PerceivedScan>& scans = experience_.scans();
  std::vector<PosedScan> posed;
  posed.reserve(scans.size());
  for (std::size_t i = 0; i < scans.size(); ++i) {
    posed.push_back({scans[i].scan,
                     i < metrical.trajectory.size()
                         ? metrical.trajectory[i]
                         : metrical.T_global_lpm * scans[i].fix.T_lpm_robot,
                     scans[i].is_trusted});
  }
  return posed;
}

int MappingService::Pipeline::nearest_place(const Vector2d& p_global, double* distance_m) const {
  int nearest = -1;
  const std::vector<Pose2>& places = metrical_.layout.T_global_place;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double away_m = (places[i].translation() - p_global).norm();
    if (nearest < 0 || away_m < *distance_m) {
      nearest = static_cast<int>(i);
      *distance_m = away_m;
    }
  }
  return nearest;
}

std::shared_ptr<MapState> MappingService::Pipeline::picture_of(const MetricalMap& metrical) const {
  auto state = std::make_shared<MapState>();
  const std::vector<PerceivedScan>& scans = experience_.scans();
  state->topology_revision = revision_;
  state->visit_count = static_cast<std::int64_t>(experience_.visits().size());
  state->T_global_lpm = metrical.T_global_lpm;
  state->key_scans = experience_.key_scans();
  state->trajectory = trajectory(metrical);
  state->poses = with_poses_between(scans, state->trajectory);
  if (!scans.empty()) {
    state->time = scans.back().fix.time;
  }
  return state;
}

std::shared_ptr<const MapState> MappingService::Pipeline::state() const {
  std::shared_ptr<MapState> state = picture_of(metrical_);
  if (laid_out_) {
    tell_map(*laid_out_, metrical_, state.get());
    tell_hypotheses(state.get());
  }
  return state;
}

Result<std::shared_ptr<const MapState>> MappingService::Pipeline::state_of(
    std::int64_t hypothesis) const {
  const Result<LiveHypothesis> live = live_hypothesis(tree_, hypothesis);
  if (!live) {
    return live.error();
  }
  const LaidOut laid_out{live->id, tree_.map(live->id)};
  const Result<MetricalMap> metrical =
      metrical_map(laid_out.map, experience_, matcher_, options_.layout);
  if (!metrical) {
    return Error{metrical.error().code, "the layout of hypothesis " + std::to_string(hypothesis) +
                                            ": " + metrical.error().message};
  }
  std::shared_ptr<MapState> state = picture_of(*metrical);
  tell_map(laid_out, *metrical, state.get());
  tell_hypotheses(state.get());
  state->probability = live->probability;
  return std::shared_ptr<const MapState>(std::move(state));
}

void MappingService::Pipeline::tell_map(const LaidOut& laid_out,
                                        const MetricalMap& metrical,
                                        MapState* state) const {
  const TopologicalMap& map = laid_out.map;
  state->hypothesis = laid_out.id.value;
  state->at_place = map.position().place.value;
  state->path_count = map.path_count();
  state->closure_count = map.closure_count();
  for (int v = 0; v < map.visit_count(); ++v) {
    state->place_of_visit.push_back(map.at_visit(VisitId{v}).place.value);
  }
  state->places = mapped_places(map, experience_, metrical);
  state->same_places = same_places(map, experience_, matcher_);
  for (const auto& [visit, name] : names_) {
    if (visit.index() < state->place_of_visit.size()) {
      state->places[static_cast<std::size_t>(state->place_of_visit[visit.index()])].name = name;
    }
  }
  state->travels = matcher_.constraints(map);
  state->segments = mapped_segments(map, experience_, metrical.layout, state->travels);
}

void MappingService::Pipeline::tell_hypotheses(MapState* state) const {
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
}

}  // namespace cairn
