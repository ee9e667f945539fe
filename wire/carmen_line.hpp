#pragma once
// The text format of CARMEN logs, one line at a time. Of log_reader.cpp; nobody else's business.

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace cairn::wire {

struct CarmenPose {
  double x_m = 0.0;
  double y_m = 0.0;
  double theta_rad = 0.0;
};

struct CarmenOdometry {
  std::int64_t utime = 0;
  CarmenPose T_odom_robot;
};

struct CarmenScan {
  std::int64_t utime = 0;
  int laser = 1;  ///< 1: the front one.
  double first_bearing_rad = 0.0;
  double bearing_step_rad = 0.0;
  std::vector<float> ranges_m;
  double stated_max_range_m = 0.0;         ///< 0: the line does not say.
  std::optional<CarmenPose> T_odom_robot;  ///< Where the line carries it.
};

/// A line of another kind; empty name: blank or a comment.
struct CarmenOther {
  std::string name;
};

/// A line that should be one of ours but is not.
struct CarmenMalformed {
  std::string reason;
};

using CarmenLine = std::variant<CarmenOdometry, CarmenScan, CarmenOther, CarmenMalformed>;

[[nodiscard]] CarmenLine parse_carmen_line(std::string_view line);

/// Finds the reading by which a sensor says "no return". Sensors have one value for it, or a few
/// close to each other, larger than all real readings, and they occur often.
class NoReturnFinder {
 public:
  void add(float range_m);
  /// Readings beyond this mean "no return": just below the lowest frequent reading among the
  /// largest 3 %, where there is one; else just above the largest reading. 0 without any reading.
  [[nodiscard]] double max_range_m() const;

 private:
  std::map<float, std::int64_t> counts_;  ///< Of the largest readings only.
  std::int64_t num_readings_ = 0;
  float largest_m_ = 0.0F;
};

}  // namespace cairn::wire
