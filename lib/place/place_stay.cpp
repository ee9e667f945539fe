#include "place/place_stay.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cairn {
namespace {

constexpr double kPoseSpacing_m = 0.05;
/// Walls have no exact place: a line is crossed also a little beside its ends.
constexpr double kCrossingSlack_m = 0.3;

/// Equal but for the gateway that numbering starts from.
bool same_star(const Star& a, const Star& b) {
  const std::size_t n = a.slots.size();
  if (b.slots.size() != n) {
    return false;
  }
  for (std::size_t shift = 0; shift < std::max<std::size_t>(n, 1); ++shift) {
    bool equal = true;
    for (std::size_t i = 0; i < n && equal; ++i) {
      const StarSlot& p = a.slots[i];
      const StarSlot& q = b.slots[(i + shift) % n];
      equal = (p.gateway < 0) == (q.gateway < 0) && (p.partner + shift) % n == q.partner;
    }
    if (equal) {
      return true;
    }
  }
  return false;
}

struct Crossing {
  int gateway = -1;
  int sign = 0;              ///< +1 outward, -1 inward.
  std::size_t position = 0;  ///< Of the first pose behind it.
};

/// The last passage of a way through any gateway; only inward ones, or outward ones, if asked.
Crossing last_passage(const std::vector<Gateway>& gateways,
                      const std::vector<StampedPose>& way,
                      int wanted_sign) {
  for (std::size_t i = way.size(); i-- > 1;) {
    for (std::size_t g = 0; g < gateways.size(); ++g) {
      const int sign = crossing(gateways[g], way[i - 1].T_lpm_robot.translation(),
                                way[i].T_lpm_robot.translation(), kCrossingSlack_m);
      if (sign != 0 && (wanted_sign == 0 || sign == wanted_sign)) {
        return {static_cast<int>(g), sign, i};
      }
    }
  }
  return {};
}

/// A rectangle of a map, moved into another frame by a translation of whole cells.
OccupancyGrid cropped(const OccupancyGrid& grid,
                      const Vector2d& low,
                      const Vector2d& high,
                      const Vector2d& new_origin) {
  const GridGeometry& from = grid.geometry();
  const Cell a = from.cell_at(low);
  const Cell b = from.cell_at(high);
  const Cell lower{std::clamp(a.x, 0, from.width), std::clamp(a.y, 0, from.height)};
  GridGeometry to = from;
  to.width = std::max(0, std::min(b.x + 1, from.width) - lower.x);
  to.height = std::max(0, std::min(b.y + 1, from.height) - lower.y);
  to.origin_m = from.origin_m + from.cell_m * Vector2d(lower.x, lower.y) - new_origin;
  OccupancyGrid crop(to);
  for (int y = 0; y < to.height; ++y) {
    for (int x = 0; x < to.width; ++x) {
      crop.log_odds({x, y}) = grid.log_odds({lower.x + x, lower.y + y});
    }
  }
  return crop;
}

}  // namespace

bool agree(const PlaceNeighbourhood& a, const PlaceNeighbourhood& b) {
  return a.gateways.size() == b.gateways.size() && same_star(a.star, b.star) &&
         std::all_of(a.gateways.begin(), a.gateways.end(), [&](const Gateway& gateway) {
           return std::any_of(b.gateways.begin(), b.gateways.end(), [&](const Gateway& other) {
             return is_same_gateway(gateway, other);
           });
         });
}

PlaceStay::PlaceStay(const StampedPose& entry,
                     std::vector<StampedPose> way_before,
                     bool has_come_from_outside)
    : entry_(entry), has_come_from_outside_(has_come_from_outside), way_(std::move(way_before)) {
  way_.push_back(entry);
}

std::optional<PlaceStay> PlaceStay::gone_through(const PlaceNeighbourhood& place,
                                                 const std::vector<StampedPose>& way,
                                                 TimePoint since,
                                                 const PlaceOptions& options) {
  const Crossing out = last_passage(place.gateways, way, 0);
  if (out.sign <= 0 || way[out.position].time <= since) {
    return std::nullopt;
  }
  const Gateway& exit = place.gateways[static_cast<std::size_t>(out.gateway)];
  const double beyond_m = distance_beyond_m(exit, way.back().T_lpm_robot.translation());
  if (exit.width_m >= options.doorway_below_m || beyond_m < options.left_beyond_m) {
    return std::nullopt;
  }
  const auto end = way.begin() + static_cast<std::ptrdiff_t>(out.position);
  const Crossing in = last_passage(place.gateways, {way.begin(), end}, 0);
  if (in.sign >= 0) {
    return std::nullopt;
  }
  const auto entry = way.begin() + static_cast<std::ptrdiff_t>(in.position);
  PlaceStay stay(*entry, {way.begin(), entry}, true);
  for (auto pose = entry + 1; pose != way.end(); ++pose) {
    stay.add_pose(*pose);
  }
  stay.conclude(place);
  return stay;
}

void PlaceStay::add_reading(const PlaceNeighbourhood& reading) {
  last_reading_ = reading;
  if (!reading.is_complete) {
    return;
  }
  if (last_complete_ && agree(*last_complete_, reading)) {
    settled_ = reading;
  }
  last_complete_ = reading;
}

bool PlaceStay::is_crossed(const std::vector<Gateway>& gateways) const {
  return has_come_from_outside_ && last_passage(gateways, way_, -1).gateway >= 0 &&
         last_passage(gateways, way_, +1).gateway >= 0;
}

bool PlaceStay::conclude(const PlaceNeighbourhood& reading) {
  const bool counts = reading.is_complete || is_crossed(reading.gateways);
  if (counts) {
    settled_ = reading;
    last_complete_ = reading;
  }
  return counts || is_complete();
}

void PlaceStay::add_pose(const StampedPose& pose) {
  const Vector2d step = pose.T_lpm_robot.translation() - way_.back().T_lpm_robot.translation();
  if (step.norm() >= kPoseSpacing_m) {
    way_.push_back(pose);
  }
}

const PlaceNeighbourhood& PlaceStay::best() const {
  return settled_ ? *settled_ : last_complete_ ? *last_complete_ : last_reading_;
}

int PlaceStay::gateway_left_through(double beyond_m) const {
  const std::vector<Gateway>& gateways = best().gateways;
  const Crossing last = last_passage(gateways, way_, 0);
  if (last.sign <= 0) {
    return -1;
  }
  const Gateway& gateway = gateways[static_cast<std::size_t>(last.gateway)];
  const double beyond = distance_beyond_m(gateway, way_.back().T_lpm_robot.translation());
  return beyond >= beyond_m ? last.gateway : -1;
}

bool PlaceStay::is_far_outside(double beyond_m) const {
  const Vector2d from_center = way_.back().T_lpm_robot.translation() - best().center;
  return from_center.norm() > best().radius_m + beyond_m;
}

int PlaceStay::gateway_entered_by(const std::vector<StampedPose>& way) const {
  const Crossing last = last_passage(best().gateways, way, 0);
  return last.sign < 0 ? last.gateway : -1;
}

int PlaceStay::nearest_gateway(const Vector2d& p_lpm) const {
  const std::vector<Gateway>& gateways = best().gateways;
  int nearest = -1;
  double least_m = std::numeric_limits<double>::infinity();
  for (std::size_t g = 0; g < gateways.size(); ++g) {
    const double distance_m = (gateways[g].middle - p_lpm).norm();
    if (distance_m < least_m) {
      least_m = distance_m;
      nearest = static_cast<int>(g);
    }
  }
  return nearest;
}

int PlaceStay::arrival() const {
  if (!has_come_from_outside_) {
    return -1;
  }
  const std::vector<Gateway>& gateways = best().gateways;
  for (std::size_t i = 1; i < way_.size(); ++i) {
    for (std::size_t g = 0; g < gateways.size(); ++g) {
      if (crossing(gateways[g], way_[i - 1].T_lpm_robot.translation(),
                   way_[i].T_lpm_robot.translation(), kCrossingSlack_m) < 0) {
        return static_cast<int>(g);
      }
    }
  }
  return nearest_gateway(way_.front().T_lpm_robot.translation());
}

void PlaceStay::leave() {
  const Crossing last = last_passage(best().gateways, way_, +1);
  departure_ =
      last.gateway >= 0 ? last.gateway : nearest_gateway(way_.back().T_lpm_robot.translation());
}

std::vector<StampedPose> PlaceStay::last_of_way(double keep_m) const {
  std::size_t first = way_.size();
  double travelled_m = 0.0;
  while (first > 0 && travelled_m <= keep_m) {
    --first;
    if (first > 0) {
      travelled_m +=
          (way_[first].T_lpm_robot.translation() - way_[first - 1].T_lpm_robot.translation())
              .norm();
    }
  }
  return {way_.begin() + static_cast<std::ptrdiff_t>(first), way_.end()};
}

void PlaceStay::keep_map(const OccupancyGrid& grid, double crop_margin_m) {
  const PlaceNeighbourhood& place = best();
  const GridGeometry& geometry = grid.geometry();
  const Vector2d cells = (place.center - geometry.origin_m) / geometry.cell_m;
  const Vector2d origin =
      geometry.origin_m + geometry.cell_m * Vector2d(std::round(cells.x()), std::round(cells.y()));
  T_lpm_place_ = Pose2(origin, 0.0);
  Vector2d low = origin;
  Vector2d high = origin;
  for (const Gateway& gateway : place.gateways) {
    for (const Vector2d& p : gateway.basis_points) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
  }
  const Vector2d margin(crop_margin_m, crop_margin_m);
  crop_ = cropped(grid, low - margin, high + margin, origin);
}

void PlaceStay::continue_with(const PlaceStay& later) {
  departure_ = -1;
  way_.insert(way_.end(), later.way_.begin(), later.way_.end());
  if (later.last_complete_) {
    last_complete_ = later.last_complete_;
  }
  if (later.settled_) {
    settled_ = later.settled_;
  }
  last_reading_ = later.last_reading_;
}

PlaceVisit PlaceStay::visit() const {
  const Pose2 T_place_lpm = T_lpm_place_.inverse();
  PlaceVisit visit;
  visit.entered = entry_.time;
  visit.left = way_.back().time;
  visit.T_lpm_place = T_lpm_place_;
  visit.neighbourhood = transformed(T_place_lpm, best());
  visit.arrival_gateway = arrival();
  visit.departure_gateway = departure_;
  visit.T_place_robot_at_entry = T_place_lpm * entry_.T_lpm_robot;
  visit.T_place_robot_at_exit = T_place_lpm * way_.back().T_lpm_robot;
  visit.lpm = crop_;
  return visit;
}

}  // namespace cairn
