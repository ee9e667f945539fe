#pragma once

#include <cstddef>
#include <vector>

#include "clients/sim/geometry.hpp"

namespace cairn::sim {

struct DriverOptions {
  double speed_m_per_s = 0.6;
  double turn_speed_rad_per_s = 0.9;
  double acceleration_m_per_s2 = 0.8;
  double lookahead_m = 0.7;  ///< Larger cuts corners more.
};

/// A differential drive that follows a polyline by pure pursuit (Coulter, CMU-RI-TR-92-01): it
/// steers on a circle to the point `lookahead_m` ahead on the path, slower the tighter the circle.
/// At a corner sharper than a right angle it stops and turns on the spot.
class Driver {
 public:
  /// @pre path has at least one point
  Driver(std::vector<Point> path, const Pose& start, const DriverOptions& options);

  /// The true pose in the world frame.
  [[nodiscard]] const Pose& pose() const { return pose_; }
  /// Whether the end of the path was reached.
  [[nodiscard]] bool has_arrived() const { return has_arrived_; }

  /// Drives for a short time, a few hundredths of a second.
  Motion advance(double duration_s);

 private:
  void update_progress();
  [[nodiscard]] Point point_at(double along_m) const;
  [[nodiscard]] Point target() const;
  [[nodiscard]] Motion command();

  std::vector<Point> path_;
  std::vector<double> along_m_;  ///< Length of the path up to each of its points.
  std::vector<double> stops_m_;  ///< Where the path turns sharply or ends; ascending.
  std::size_t next_stop_ = 0;
  double progress_m_ = 0.0;
  double speed_m_per_s_ = 0.0;
  bool turns_on_spot_ = false;
  bool has_arrived_ = false;
  Pose pose_;
  DriverOptions options_;
};

}  // namespace cairn::sim
