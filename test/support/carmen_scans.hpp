#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <sstream>
#include <string>
#include <variant>
#include <vector>

#include "geometry/angle.hpp"
#include "sensing/laser_scan.hpp"
#include "sensing/odometry.hpp"

namespace cairn::test {

/// One message of a log, in the order in which it was recorded.
using CarmenMessage = std::variant<OdometrySample, LaserScan>;

/// Bearing of the first beam and step, by the convention of CARMEN's logs for so many beams; else
/// those of the URG-04LX.
struct CarmenBeams {
  explicit CarmenBeams(std::size_t beams) {
    const bool is_half_turn = beams <= 361;
    span_rad = (is_half_turn ? 180.0 : 239.8) * kPi / 180.0;
    // 180 and 360 beams leave the last one out.
    const double steps = static_cast<double>(is_half_turn && beams % 2 == 0 ? beams : beams - 1);
    step_rad = span_rad / steps;
  }
  [[nodiscard]] float bearing_rad(std::size_t beam) const {
    return static_cast<float>(-0.5 * span_rad + static_cast<double>(beam) * step_rad);
  }
  double span_rad = 0.0;
  double step_rad = 0.0;
};

/// The reading from which on a robot says "nothing there": 50 m and more always does; else the
/// reading near the upper end that fills more than 2 % of all beams, as no distance would.
inline double no_return_reading(const std::map<double, std::size_t>& counts) {
  constexpr double kAlwaysNone_m = 50.0;
  constexpr double kSuspiciousShare = 0.02;
  std::size_t all = 0;
  for (const auto& [reading, count] : counts) {
    all += count;
  }
  const double largest = counts.empty() ? 0.0 : counts.rbegin()->first;
  for (const auto& [reading, count] : counts) {
    if (reading >= 0.9 * largest &&
        static_cast<double>(count) > kSuspiciousShare * static_cast<double>(all)) {
      return std::min(reading, kAlwaysNone_m);
    }
  }
  return kAlwaysNone_m;
}

/// Reads the FLASER and ODOM lines of a CARMEN log. Each FLASER line gives an odometry sample of
/// the same stamp, and then the scan. Readings without return become +infinity; the max range is
/// the longest distance that was ever measured.
inline std::vector<CarmenMessage> read_carmen(const std::filesystem::path& file) {
  std::vector<CarmenMessage> messages;
  std::map<double, std::size_t> counts;
  std::ifstream log(file);
  std::string line;
  const auto time_of = [](double stamp_s) {
    return time_of_utime(static_cast<std::int64_t>(std::llround(stamp_s * 1e6)));
  };
  while (std::getline(log, line)) {
    std::istringstream words(line);
    std::string name;
    words >> name;
    if (name == "ODOM") {
      double x = 0.0, y = 0.0, theta = 0.0, skipped = 0.0, stamp_s = 0.0;
      words >> x >> y >> theta >> skipped >> skipped >> skipped >> stamp_s;
      messages.emplace_back(OdometrySample{time_of(stamp_s), Pose2(x, y, theta)});
    } else if (name == "FLASER") {
      std::size_t beams = 0;
      words >> beams;
      LaserScan scan;
      const CarmenBeams carmen(beams);
      for (std::size_t i = 0; i < beams; ++i) {
        double range_m = 0.0;
        words >> range_m;
        ++counts[range_m];
        scan.ranges_m.push_back(static_cast<float>(range_m));
        scan.bearings_rad.push_back(carmen.bearing_rad(i));
      }
      double lx = 0.0, ly = 0.0, ltheta = 0.0, x = 0.0, y = 0.0, theta = 0.0, stamp_s = 0.0;
      words >> lx >> ly >> ltheta >> x >> y >> theta >> stamp_s;
      scan.time = time_of(stamp_s);
      scan.T_robot_laser = Pose2(x, y, theta).inverse() * Pose2(lx, ly, ltheta);
      messages.emplace_back(OdometrySample{scan.time, Pose2(x, y, theta)});
      messages.emplace_back(std::move(scan));
    }
  }
  const double none_m = no_return_reading(counts);
  const auto first_none = counts.lower_bound(none_m);
  const double max_range_m = first_none == counts.begin() ? none_m : std::prev(first_none)->first;
  for (CarmenMessage& message : messages) {
    if (auto* scan = std::get_if<LaserScan>(&message)) {
      scan->max_range_m = max_range_m;
      for (float& range_m : scan->ranges_m) {
        if (range_m <= 0.0F) {
          range_m = std::numeric_limits<float>::quiet_NaN();
        } else if (range_m >= static_cast<float>(none_m) - 1e-4F) {
          range_m = std::numeric_limits<float>::infinity();
        }
      }
    }
  }
  return messages;
}

}  // namespace cairn::test
