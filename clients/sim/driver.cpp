#include "clients/sim/driver.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace cairn::sim {
namespace {

constexpr double kSharpCorner_rad = 1.75;  ///< A little more than a right angle.
/// Heading error to the target at which a turn on the spot begins, and at which it is done.
constexpr double kTurnOnSpotAbove_rad = 0.9;
constexpr double kTurnOnSpotUntil_rad = 0.05;
constexpr double kStopReachedWithin_m = 0.05;
constexpr double kSlowest_m_per_s = 0.05;  ///< Creeps into a stop instead of never arriving.
constexpr double kProgressWindow_m = 1.0;
constexpr double kProgressStep_m = 0.02;

}  // namespace

Driver::Driver(std::vector<Point> path, const Pose& start, const DriverOptions& options)
    : path_(std::move(path)), along_m_(path_.size(), 0.0), pose_(start), options_(options) {
  for (std::size_t i = 1; i < path_.size(); ++i) {
    along_m_[i] = along_m_[i - 1] + distance_m(path_[i - 1], path_[i]);
    if (i + 1 < path_.size()) {
      const double corner_rad =
          wrap_angle(bearing_rad(path_[i], path_[i + 1]) - bearing_rad(path_[i - 1], path_[i]));
      if (std::abs(corner_rad) > kSharpCorner_rad) {
        stops_m_.push_back(along_m_[i]);
      }
    }
  }
  stops_m_.push_back(along_m_.back());
}

Point Driver::point_at(double along_m) const {
  const auto after = std::upper_bound(along_m_.begin(), along_m_.end(), along_m);
  if (after == along_m_.end()) {
    return path_.back();
  }
  const auto leg = static_cast<std::size_t>(after - along_m_.begin());
  const double share = (along_m - along_m_[leg - 1]) / (along_m_[leg] - along_m_[leg - 1]);
  const Point& from = path_[leg - 1];
  const Point& to = path_[leg];
  return {from.x_m + share * (to.x_m - from.x_m), from.y_m + share * (to.y_m - from.y_m)};
}

Point Driver::target() const {
  return point_at(std::min(progress_m_ + options_.lookahead_m, stops_m_[next_stop_]));
}

void Driver::update_progress() {
  const double stop_m = stops_m_[next_stop_];
  const double window_end_m = std::min(progress_m_ + kProgressWindow_m, stop_m);
  double nearest_m = distance_m(pose_.at, point_at(progress_m_));
  double best_along_m = progress_m_;
  const int steps = static_cast<int>((window_end_m - progress_m_) / kProgressStep_m);
  for (int step = 1; step <= steps; ++step) {
    const double along_m = progress_m_ + step * kProgressStep_m;
    const double here_m = distance_m(pose_.at, point_at(along_m));
    if (here_m < nearest_m) {
      nearest_m = here_m;
      best_along_m = along_m;
    }
  }
  progress_m_ = best_along_m;
  if (distance_m(pose_.at, point_at(stop_m)) < kStopReachedWithin_m &&
      stop_m - progress_m_ < kProgressWindow_m) {
    progress_m_ = stop_m;
    speed_m_per_s_ = 0.0;
    has_arrived_ = next_stop_ + 1 == stops_m_.size();
    next_stop_ += has_arrived_ ? 0 : 1;
  }
}

/// Speed and turn rate, as the motion of one second.
Motion Driver::command() {
  const Point goal = target();
  const double error_rad = wrap_angle(bearing_rad(pose_.at, goal) - pose_.theta_rad);
  turns_on_spot_ =
      std::abs(error_rad) > (turns_on_spot_ ? kTurnOnSpotUntil_rad : kTurnOnSpotAbove_rad);
  if (turns_on_spot_) {
    return {0.0, std::copysign(options_.turn_speed_rad_per_s, error_rad)};
  }
  // The circle through the robot, tangent to its heading, and the target.
  const double curvature_per_m =
      2.0 * std::sin(error_rad) / std::max(distance_m(pose_.at, goal), kStopReachedWithin_m);
  const double to_stop_m = std::max(0.0, stops_m_[next_stop_] - progress_m_);
  const double brake_m_per_s = std::sqrt(2.0 * options_.acceleration_m_per_s2 * to_stop_m);
  const double turn_limit_m_per_s =
      0.6 * options_.turn_speed_rad_per_s / std::max(std::abs(curvature_per_m), 1e-9);
  const double speed_m_per_s = std::max(
      kSlowest_m_per_s, std::min({options_.speed_m_per_s, brake_m_per_s, turn_limit_m_per_s}));
  return {speed_m_per_s, curvature_per_m};
}

Motion Driver::advance(double duration_s) {
  update_progress();
  if (has_arrived_) {
    return {};
  }
  const Motion wanted = command();
  const double change_m_per_s = options_.acceleration_m_per_s2 * duration_s;
  speed_m_per_s_ = turns_on_spot_ ? std::max(0.0, speed_m_per_s_ - change_m_per_s)
                                  : std::clamp(wanted.distance_m, speed_m_per_s_ - change_m_per_s,
                                               speed_m_per_s_ + change_m_per_s);
  Motion motion;
  motion.distance_m = speed_m_per_s_ * duration_s;
  const double turn_rad_per_s = turns_on_spot_ ? wanted.turn_rad : wanted.turn_rad * speed_m_per_s_;
  motion.turn_rad = duration_s * std::clamp(turn_rad_per_s, -options_.turn_speed_rad_per_s,
                                            options_.turn_speed_rad_per_s);
  pose_ = moved(pose_, motion);
  return motion;
}

}  // namespace cairn::sim
