#include "layout/incremental_layout.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "base/check.hpp"
#include "layout/displacement.hpp"
#include "layout/layout_attempt.hpp"

namespace cairn {
namespace {

/// Steps that change by less are left as they are, m and rad.
constexpr double kStepTolerance = 1e-6;
/// A travel is expanded anew where the heading of its departure has turned by more since,
constexpr double kStaleTurn_rad = 1e-4;
/// or where the expansion is off by more standard deviations.
constexpr double kStaleSigmas = 1e-4;
/// Beside places that are expanded anew, this share of both is enough: else the border creeps.
constexpr double kBorderShare = 0.5;
/// A solution that turns a place by more may be in the wrong valley.
constexpr double kFarTurn_rad = 0.3;
constexpr int kMaxPasses = 20;

std::size_t at(int index) {
  return static_cast<std::size_t>(index);
}

Eigen::Vector3d coordinates(const Pose2& pose) {
  return {pose.x(), pose.y(), pose.theta()};
}

Pose2 pose(const Eigen::Vector3d& place) {
  return {place.x(), place.y(), place.z()};
}

/// A residual is linear in the places but for the heading of departure: as that turns, it is off by
/// the turn times what the way has changed, and by half its square times the way.
bool is_stale(const TravelResidual& travel,
              const Eigen::Vector3d& step_from,
              const Eigen::Vector3d& step_to,
              double share) {
  const double turn_rad = std::abs(step_from.z());
  if (turn_rad > share * kStaleTurn_rad) {
    return true;
  }
  const double change_m = (step_to - step_from).head<2>().norm();
  const double way_m = travel.measured.head<2>().norm();
  const double per_m = travel.whitening.topLeftCorner<2, 2>().norm();
  return per_m * turn_rad * (change_m + 0.5 * turn_rad * way_m) > share * kStaleSigmas;
}

}  // namespace

IncrementalLayout::IncrementalLayout() {
  graph_.add_place();
  first_travel_.push_back(-1);
  global_places_.push_back(Eigen::Vector3d::Zero());
  linearised_ = steps_ = global_places_;
  is_active_.push_back(1);
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
  double chi2 = 0.0;
  for (int i = 0; i < graph_.travel_count(); ++i) {
    const TravelResidual& travel = graph_.travel(i);
    chi2 += travel.at(global_places_[at(travel.from)], global_places_[at(travel.to)]).squaredNorm();
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
}

Status IncrementalLayout::add_place(const TravelConstraint& travel) {
  const int place = place_count();
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
  const PlaceVector before = global_places_;
  std::vector<int> touched;
  activate_way_to(travel.from, &touched);
  activate_way_to(travel.to, &touched);
  if (relax(touched)) {
    return {};
  }
  const Status solved = start_anew();
  if (!solved) {
    travels_.pop_back();
    graph_.remove_last_travel();
    global_places_ = before;
    CAIRN_CHECK(linearise_all());  // It was positive definite before.
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

/// Solves from where the places are.
/// @return whether it has come to rest near by
bool IncrementalLayout::relax(const std::vector<int>& touched) {
  if (!tree_.take_up(touched, equations(), &maker_)) {
    return false;
  }
  for (int pass = 0; pass < kMaxPasses; ++pass) {
    const std::vector<int> changed = tree_.solve(kStepTolerance, &steps_);
    if (has_moved_too_far(changed)) {
      return false;
    }
    take_steps(changed);
    const std::vector<int> stale = stale_places(changed);
    if (stale.empty()) {
      return true;
    }
    for (const int place : stale) {
      linearised_[at(place)] = global_places_[at(place)];
      steps_[at(place)].setZero();
    }
    if (!tree_.relinearise(stale, equations(), &maker_)) {
      return false;
    }
  }
  return false;
}

bool IncrementalLayout::has_moved_too_far(const std::vector<int>& changed) const {
  return std::any_of(changed.begin(), changed.end(), [&](int place) {
    const Eigen::Vector3d& from = linearised_[at(place)];
    const double turn_rad = from.z() + steps_[at(place)].z() - global_places_[at(place)].z();
    return !(std::abs(turn_rad) < kFarTurn_rad) || !steps_[at(place)].allFinite();
  });
}

/// Places to be linearised anew: both ends of travels whose expansion is off, and what would be off
/// beside them when they are.
std::vector<int> IncrementalLayout::stale_places(const std::vector<int>& changed) const {
  std::vector<int> stale;
  std::vector<char> is_in(steps_.size(), 0);
  const auto add = [&](int place) {
    if (place != 0 && std::exchange(is_in[at(place)], 1) == 0) {
      stale.push_back(place);
    }
  };
  for (const int place : changed) {
    graph_.for_each_travel_of(place, [&](int index) {
      const TravelResidual& travel = graph_.travel(index);
      if (is_active_[at(travel.from)] != 0 && is_active_[at(travel.to)] != 0 &&
          is_stale(travel, steps_[at(travel.from)], steps_[at(travel.to)], 1.0)) {
        add(travel.from);
        add(travel.to);
      }
    });
  }
  for (std::size_t i = 0; i < stale.size(); ++i) {
    graph_.for_each_travel_of(stale[i], [&](int index) {
      const TravelResidual& travel = graph_.travel(index);
      if (travel.to == stale[i] && is_active_[at(travel.from)] != 0 &&
          is_stale(travel, steps_[at(travel.from)], Eigen::Vector3d::Zero(), kBorderShare)) {
        add(travel.from);
      }
    });
  }
  return stale;
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

/// Solves all travels from the linear start.
Status IncrementalLayout::start_anew() {
  ++restart_count_;
  const Result<LayoutAttempt> attempt = attempt_layout(place_count(), travels_);
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
  take_steps(tree_.solve(kStepTolerance, &steps_));
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
