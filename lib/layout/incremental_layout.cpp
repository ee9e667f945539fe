#include "layout/incremental_layout.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "layout/displacement.hpp"
#include "layout/layout_attempt.hpp"
#include "layout/stale_places.hpp"

namespace cairn {
namespace {

/// Steps that change no travel by more standard deviations are left as they are.
constexpr double kStepSigmas = 1e-4;
/// Of a place without travels, m and rad.
constexpr double kGreatestStep = 1e-3;
/// A solution that turns a place by more may be in the wrong valley,
constexpr double kFarTurn_rad = 0.3;
/// unless the new travel adds no more to chi2 than one that is true may: 3 degrees of freedom.
constexpr double kPlausibleChi2 = 30.0;
constexpr int kMaxPasses = 20;
constexpr int kMaxPlaces = 1'000'000;

std::size_t at(int index) {
  return static_cast<std::size_t>(index);
}

Eigen::Vector3d coordinates(const Pose2& pose) {
  return {pose.x(), pose.y(), pose.theta()};
}

Pose2 pose(const Eigen::Vector3d& place) {
  return {place.x(), place.y(), place.z()};
}

}  // namespace

IncrementalLayout::IncrementalLayout() {
  graph_.add_place();
  first_travel_.push_back(-1);
  global_places_.push_back(Eigen::Vector3d::Zero());
  linearised_ = steps_ = global_places_;
  is_active_.push_back(1);
  tolerances_.push_back({kGreatestStep, kGreatestStep});
}

Pose2 IncrementalLayout::T_global_place(int place) const {
  return pose(global_places_[at(place)]);
}

std::vector<Pose2> IncrementalLayout::T_global_place() const {
  std::vector<Pose2> poses;
  poses.reserve(global_places_.size());
  for (const Eigen::Vector3d& place : global_places_) {
    poses.push_back(pose(place));
  }
  return poses;
}

double IncrementalLayout::chi2() const {
  return chi2_of(global_places_, graph_.travel_count());
}

/// Of the first travels.
double IncrementalLayout::chi2_of(const PlaceVector& places, int travel_count) const {
  double chi2 = 0.0;
  for (int i = 0; i < travel_count; ++i) {
    const TravelResidual& travel = graph_.travel(i);
    chi2 += travel.at(places[at(travel.from)], places[at(travel.to)]).squaredNorm();
  }
  return chi2;
}

Status IncrementalLayout::check(const TravelConstraint& travel, int place_count) const {
  if (travel.from < 0 || travel.from >= place_count || travel.to < 0 || travel.to >= place_count) {
    return Error{ErrorCode::kInvalidValue,
                 "layout: travel " + std::to_string(travels_.size()) + " must join places in [0, " +
                     std::to_string(place_count) + "), joins " + std::to_string(travel.from) +
                     " and " + std::to_string(travel.to)};
  }
  if (const Status sound = validate_displacement(travel.T_from_to); !sound) {
    return Error{ErrorCode::kInvalidValue, "layout: travel " + std::to_string(travels_.size()) +
                                               ": " + sound.error().message};
  }
  return {};
}

void IncrementalLayout::append(const TravelConstraint& travel) {
  travels_.push_back(travel);
  graph_.add_travel(residual_of(travel));
  const TravelResidual& residual = graph_.travel(graph_.travel_count() - 1);
  const double per_m = residual.whitening.leftCols<2>().norm();
  const double per_rad =
      residual.whitening.col(2).norm() + per_m * residual.measured.head<2>().norm();
  for (const int place : {travel.from, travel.to}) {
    StepTolerance& tolerance = tolerances_[at(place)];
    tolerance.m = std::min(tolerance.m, kStepSigmas / per_m);
    tolerance.rad = std::min(tolerance.rad, kStepSigmas / per_rad);
  }
}

Status IncrementalLayout::add_place(const TravelConstraint& travel) {
  const int place = place_count();
  if (place >= kMaxPlaces) {
    return Error{ErrorCode::kInvalidValue,
                 "layout: expected at most " + std::to_string(kMaxPlaces) + " places"};
  }
  if (const Status sound = check(travel, place + 1); !sound) {
    return sound;
  }
  if ((travel.from == place) == (travel.to == place)) {
    return Error{ErrorCode::kInvalidValue,
                 "layout: a new place, " + std::to_string(place) +
                     ", must be joined to a known one, the travel joins " +
                     std::to_string(travel.from) + " and " + std::to_string(travel.to)};
  }
  first_travel_.push_back(static_cast<int>(travels_.size()));
  graph_.add_place();
  tolerances_.push_back({kGreatestStep, kGreatestStep});
  append(travel);
  const bool is_arrival = travel.to == place;
  const Pose2& T_from_to = travel.T_from_to.mean;
  global_places_.push_back(coordinates(T_global_place(is_arrival ? travel.from : travel.to) *
                                       (is_arrival ? T_from_to : T_from_to.inverse())));
  linearised_.push_back(global_places_.back());
  steps_.emplace_back(Eigen::Vector3d::Zero());
  is_active_.push_back(0);
  return {};
}

Status IncrementalLayout::add_travel(const TravelConstraint& travel) {
  if (const Status sound = check(travel, place_count()); !sound) {
    return sound;
  }
  append(travel);
  if (travel.from == travel.to) {
    return {};
  }
  State before{tree_, global_places_, linearised_, steps_, is_active_};
  std::vector<int> touched;
  activate_way_to(travel.from, &touched);
  activate_way_to(travel.to, &touched);
  const Rest rest = relax(touched);
  if (rest == Rest::kNearBy ||
      (rest == Rest::kFarOff &&
       chi2() - chi2_of(before.global_places, graph_.travel_count() - 1) <= kPlausibleChi2)) {
    return {};
  }
  const Status solved = start_anew(rest == Rest::kFarOff);
  if (!solved) {
    travels_.pop_back();
    graph_.remove_last_travel();
    tree_ = std::move(before.tree);
    global_places_ = std::move(before.global_places);
    linearised_ = std::move(before.linearised);
    steps_ = std::move(before.steps);
    is_active_ = std::move(before.is_active);
  }
  return solved;
}

/// Takes the place into the equations, and those by which it hangs on what is there.
void IncrementalLayout::activate_way_to(int place, std::vector<int>* touched) {
  while (is_active_[at(place)] == 0) {
    touched->push_back(place);
    is_active_[at(place)] = 1;
    linearised_[at(place)] = global_places_[at(place)];
    const TravelResidual& travel = graph_.travel(first_travel_[at(place)]);
    place = travel.from == place ? travel.to : travel.from;
  }
  if (place != 0 && std::find(touched->begin(), touched->end(), place) == touched->end()) {
    touched->push_back(place);
  }
}

/// Solves from where the places are, until nothing is stale.
IncrementalLayout::Rest IncrementalLayout::relax(const std::vector<int>& touched) {
  if (!tree_.take_up(touched, equations(), &maker_)) {
    return Rest::kNone;
  }
  Rest rest = Rest::kNearBy;
  for (int pass = 0; pass < kMaxPasses; ++pass) {
    const std::vector<int> changed = tree_.solve(tolerances_, &steps_);
    const double turn_rad = greatest_turn_rad(changed);
    if (!(turn_rad < kPi)) {
      return Rest::kNone;
    }
    rest = turn_rad < kFarTurn_rad ? rest : Rest::kFarOff;
    take_steps(changed);
    const std::vector<int> stale = stale_places(equations(), steps_, changed);
    if (stale.empty()) {
      return rest;
    }
    for (const int place : stale) {
      linearised_[at(place)] = global_places_[at(place)];
      steps_[at(place)].setZero();
    }
    if (!tree_.relinearise(stale, equations(), &maker_)) {
      return Rest::kNone;
    }
  }
  return Rest::kNone;
}

/// Of what is about to change; infinite where a step is not finite.
double IncrementalLayout::greatest_turn_rad(const std::vector<int>& changed) const {
  double greatest_rad = 0.0;
  for (const int place : changed) {
    const Eigen::Vector3d& step = steps_[at(place)];
    if (!step.allFinite()) {
      return std::numeric_limits<double>::infinity();
    }
    const double turn_rad = linearised_[at(place)].z() + step.z() - global_places_[at(place)].z();
    greatest_rad = std::max(greatest_rad, std::abs(turn_rad));
  }
  return greatest_rad;
}

void IncrementalLayout::take_steps(const std::vector<int>& changed) {
  for (const int place : changed) {
    global_places_[at(place)] = linearised_[at(place)] + steps_[at(place)];
  }
  carry_along(changed);
}

/// Places that hang on others by their first travel go with them.
void IncrementalLayout::carry_along(const std::vector<int>& changed) {
  std::vector<int> open = changed;
  while (!open.empty()) {
    const int place = open.back();
    open.pop_back();
    graph_.for_each_travel_of(place, [&](int index) {
      const TravelConstraint& travel = travels_[at(index)];
      const int other = travel.from == place ? travel.to : travel.from;
      if (is_active_[at(other)] == 0 && first_travel_[at(other)] == index) {
        const Pose2& T_from_to = travel.T_from_to.mean;
        global_places_[at(other)] = coordinates(
            T_global_place(place) * (travel.to == other ? T_from_to : T_from_to.inverse()));
        open.push_back(other);
      }
    });
  }
}

/// Solves all travels from the linear start; of two rests, the one of lower chi2 is kept.
Status IncrementalLayout::start_anew(bool is_at_rest) {
  ++restart_count_;
  const Result<LayoutAttempt> attempt = attempt_layout(place_count(), travels_);
  if (is_at_rest && (!attempt || !attempt->is_converged || attempt->layout.chi2 >= chi2())) {
    return {};
  }
  if (!attempt) {
    return attempt.error();
  }
  if (!attempt->is_converged) {
    return Error{ErrorCode::kNotConverged, attempt->reason};
  }
  for (int place = 0; place < place_count(); ++place) {
    global_places_[at(place)] = coordinates(attempt->layout.T_global_place[at(place)]);
  }
  if (!linearise_all()) {
    return Error{ErrorCode::kNotConverged, "layout: the curvature is singular"};
  }
  take_steps(tree_.solve(tolerances_, &steps_));
  return {};
}

/// Makes the equations anew about where the places are.
bool IncrementalLayout::linearise_all() {
  std::vector<int> active;
  for (int place = 1; place < place_count(); ++place) {
    if (is_active_[at(place)] != 0) {
      active.push_back(place);
    }
  }
  linearised_ = global_places_;
  std::fill(steps_.begin(), steps_.end(), Eigen::Vector3d::Zero());
  tree_.clear();
  return tree_.take_up(active, equations(), &maker_);
}

}  // namespace cairn
