#include "place/place_detector.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/check.hpp"

namespace cairn {
namespace {

/// So much of the way before a place is remembered, to know by which gateway the robot came.
constexpr double kWayBefore_m = 4.0;
/// A turn on the spot shows something new, too.
constexpr double kLookAfterTurn_rad = 0.5;
constexpr double kPoseSpacing_m = 0.05;
constexpr double kDrivenSpacing_m = 0.2;
/// The centre of a wide place moves more from reading to reading, up to this.
constexpr double kMaxSameSpot_m = 1.5;

double distance_between(const StampedPose& a, const StampedPose& b) {
  return (a.T_lpm_robot.translation() - b.T_lpm_robot.translation()).norm();
}

/// Appends a pose unless it is next to the last one; forgets what lies farther back than `keep_m`.
void extend_way(const StampedPose& pose, double keep_m, std::vector<StampedPose>* way) {
  if (!way->empty() && distance_between(way->back(), pose) < kPoseSpacing_m) {
    return;
  }
  way->push_back(pose);
  double travelled_m = 0.0;
  std::size_t first = way->size() - 1;
  while (first > 0 && travelled_m <= keep_m) {
    travelled_m += distance_between((*way)[first], (*way)[first - 1]);
    --first;
  }
  way->erase(way->begin(), way->begin() + static_cast<std::ptrdiff_t>(first));
}

void extend_driven(const Vector2d& p, double memory_m, std::vector<Vector2d>* driven) {
  if (!driven->empty() && (driven->back() - p).norm() < kDrivenSpacing_m) {
    return;
  }
  driven->push_back(p);
  double travelled_m = 0.0;
  std::size_t first = driven->size() - 1;
  while (first > 0 && travelled_m <= memory_m) {
    travelled_m += ((*driven)[first] - (*driven)[first - 1]).norm();
    --first;
  }
  driven->erase(driven->begin(), driven->begin() + static_cast<std::ptrdiff_t>(first));
}

const PlaceNeighbourhood* place_with_robot(const std::vector<PlaceNeighbourhood>& places) {
  const auto found = std::find_if(places.begin(), places.end(),
                                  [](const PlaceNeighbourhood& p) { return p.contains_robot; });
  return found != places.end() ? &*found : nullptr;
}

const PlaceNeighbourhood* place_near(const std::vector<PlaceNeighbourhood>& places,
                                     const Vector2d& center,
                                     double within_m) {
  const PlaceNeighbourhood* nearest = nullptr;
  for (const PlaceNeighbourhood& place : places) {
    const double distance_m = (place.center - center).norm();
    if (distance_m < within_m) {
      within_m = distance_m;
      nearest = &place;
    }
  }
  return nearest;
}

bool holds(const std::vector<Gateway>& gateways, const Gateway& gateway) {
  return std::any_of(gateways.begin(), gateways.end(),
                     [&](const Gateway& other) { return is_same_gateway(other, gateway); });
}

}  // namespace

PlaceDetector::PlaceDetector(const PlaceOptions& options) : options_(options) {
  CAIRN_CHECK(validate(options).ok());
}

std::vector<PlaceEvent> PlaceDetector::observe(TimePoint time,
                                               const Pose2& T_lpm_robot,
                                               const OccupancyGrid& grid) {
  std::vector<PlaceEvent> events;
  const StampedPose now{time, T_lpm_robot};
  last_pose_ = now;
  extend_driven(T_lpm_robot.translation(), options_.driven_memory_m, &driven_);
  if (stay_) {
    stay_->add_pose(now);
  } else {
    extend_way(now, kWayBefore_m, &way_);
  }
  const bool has_moved =
      !last_look_ || distance_between(*last_look_, now) >= options_.recompute_after_m ||
      std::abs(turn_between(last_look_->T_lpm_robot.theta(), T_lpm_robot.theta())) >=
          kLookAfterTurn_rad;
  if (has_moved) {
    look(now, grid, &events);
  }
  return events;
}

void PlaceDetector::look(const StampedPose& now,
                         const OccupancyGrid& grid,
                         std::vector<PlaceEvent>* events) {
  ++report_.looks;
  last_look_ = now;
  PlaceMemory memory;
  memory.robot_way = driven_;
  memory.robot_way.push_back(now.T_lpm_robot.translation());
  for (const PlaceNeighbourhood& place : around_) {
    const std::vector<Gateway> sure = sure_gateways(place);
    memory.gateways.insert(memory.gateways.end(), sure.begin(), sure.end());
  }
  PlacesAround around =
      find_places(grid, now.T_lpm_robot.translation(), options_, std::move(memory), &viewer_);
  around_ = std::move(around.places);
  island_ = around.at_robot;
  const PlaceNeighbourhood* const here = place_with_robot(around_);
  if (stay_) {
    // As long as nothing complete was seen, the place is whatever is read around the robot.
    const PlaceNeighbourhood* const same =
        stay_->is_complete() || here == nullptr
            ? place_near(around_, stay_->best().center, same_spot_m(stay_->best()))
            : here;
    if (same != nullptr) {
      stay_->add_reading(*same);
    }
    const bool is_elsewhere = here != nullptr && here != same;
    // Where a place merges with another or comes apart, its centre jumps; yet without having passed
    // a gateway the robot is still there.
    const bool has_crossed = stay_->gateway_left_through(0.0) >= 0;
    if (is_elsewhere && same == nullptr && !has_crossed) {
      stay_->add_reading(*here);
    }
    const bool is_left = stay_->gateway_left_through(options_.left_beyond_m) >= 0 ||
                         stay_->is_far_outside(options_.left_beyond_m) ||
                         (is_elsewhere && has_crossed);
    if (is_left) {
      close_stay(now, grid, same, events);
    } else {
      announce(now, false, events);
    }
  }
  if (!stay_) {
    notice_late(now, grid, events);
  }
  if (!stay_ && here != nullptr) {
    open_stay(now, *here);
  }
  if (stay_) {
    stay_->keep_map(grid, options_.crop_margin_m);
    announce(now, false, events);
  }
}

void PlaceDetector::notice_late(const StampedPose& now,
                                const OccupancyGrid& grid,
                                std::vector<PlaceEvent>* events) {
  for (const PlaceNeighbourhood& place : around_) {
    const bool is_last =
        waiting_ && (waiting_->best().center - place.center).norm() < same_spot_m(waiting_->best());
    if (is_last || place.contains_robot) {
      continue;
    }
    stay_ = PlaceStay::gone_through(place, way_, last_left_, options_);
    if (stay_) {
      is_announced_ = false;
      close_stay(now, grid, &place, events);
      return;
    }
  }
}

void PlaceDetector::open_stay(const StampedPose& now, const PlaceNeighbourhood& reading) {
  stay_.emplace(now, way_, report_.looks > 1);
  stay_->add_reading(reading);
  is_announced_ = false;
  way_.clear();
}

bool PlaceDetector::has_come_back() const {
  if (!waiting_ ||
      (waiting_->best().center - stay_->best().center).norm() >= same_spot_m(waiting_->best())) {
    return false;
  }
  const int entrance = waiting_->gateway_entered_by(stay_->way());
  return entrance < 0 || entrance == waiting_->departure();
}

void PlaceDetector::take_up_again() {
  report_.turn_arounds += waiting_->gateway_entered_by(stay_->way()) < 0 ? 0 : 1;
  waiting_->continue_with(*stay_);
  stay_ = std::move(waiting_);
  waiting_.reset();
  is_announced_ = true;
}

double PlaceDetector::same_spot_m(const PlaceNeighbourhood& place) const {
  return std::max(options_.same_spot_m, std::min(0.5 * place.radius_m, kMaxSameSpot_m));
}

void PlaceDetector::close_stay(const StampedPose& now,
                               const OccupancyGrid& grid,
                               const PlaceNeighbourhood* reading,
                               std::vector<PlaceEvent>* events) {
  way_ = stay_->last_of_way(kWayBefore_m);
  last_left_ = now.time;
  if (reading == nullptr) {
    ++report_.retracted;
  } else if (!stay_->conclude(*reading)) {
    ++report_.dropped_incomplete;
  } else {
    announce(now, true, events);
    stay_->keep_map(grid, options_.crop_margin_m);
    stay_->leave();
    waiting_ = std::move(stay_);
  }
  stay_.reset();
}

void PlaceDetector::release_waiting(std::vector<PlaceEvent>* events) {
  PlaceVisit visit = waiting_->visit();
  ++report_.visits;
  events->push_back(
      {PlaceEventKind::kLeft, visit.left, waiting_->best().center, std::nullopt, visit});
  waiting_.reset();
}

void PlaceDetector::announce(const StampedPose& now,
                             bool is_last_chance,
                             std::vector<PlaceEvent>* events) {
  if (!stay_->is_settled() && !(is_last_chance && stay_->is_complete())) {
    return;
  }
  if (!is_announced_ && has_come_back()) {
    take_up_again();
  }
  const PlaceNeighbourhood& place = stay_->best();
  if (!is_announced_) {
    if (waiting_) {
      release_waiting(events);
    }
    is_announced_ = true;
    confirmed_.clear();
    events->push_back(
        {PlaceEventKind::kEntered, stay_->entered(), place.center, std::nullopt, std::nullopt});
  }
  for (const Gateway& gateway : place.gateways) {
    if (!holds(confirmed_, gateway)) {
      events->push_back(
          {PlaceEventKind::kGatewayConfirmed, now.time, place.center, gateway, std::nullopt});
    }
  }
  for (const Gateway& gateway : confirmed_) {
    if (!holds(place.gateways, gateway)) {
      events->push_back(
          {PlaceEventKind::kGatewayRetracted, now.time, place.center, gateway, std::nullopt});
    }
  }
  confirmed_ = place.gateways;
}

std::vector<PlaceVisit> PlaceDetector::finish() {
  std::vector<PlaceVisit> visits;
  for (std::optional<PlaceStay>* stay : {&waiting_, &stay_}) {
    if (*stay && (*stay)->is_complete()) {
      visits.push_back((*stay)->visit());
      ++report_.visits;
    }
    stay->reset();
  }
  return visits;
}

}  // namespace cairn
