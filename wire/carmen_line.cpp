#include "wire/carmen_line.hpp"

#include <charconv>
#include <cmath>
#include <numbers>

namespace cairn::wire {

namespace {

using Words = std::vector<std::string_view>;

constexpr double kRadPerDeg = std::numbers::pi / 180.0;

/// Every line ends in ipc_timestamp, ipc_hostname and logger_timestamp.
constexpr std::size_t kNumStamps = 3;

Words words_of(std::string_view line) {
  constexpr std::string_view kBlanks = " \t\r\n";
  Words words;
  for (std::size_t at = line.find_first_not_of(kBlanks); at != std::string_view::npos;) {
    const std::size_t end = std::min(line.find_first_of(kBlanks, at), line.size());
    words.push_back(line.substr(at, end - at));
    at = line.find_first_not_of(kBlanks, end);
  }
  return words;
}

/// from_chars: independent of the locale.
std::optional<double> number(std::string_view word) {
  double value = 0.0;
  const char* const end = word.data() + word.size();
  const auto [stop, error] = std::from_chars(word.data(), end, value);
  return error == std::errc() && stop == end ? std::optional(value) : std::nullopt;
}

std::optional<std::size_t> count(std::string_view word) {
  std::size_t value = 0;
  const char* const end = word.data() + word.size();
  const auto [stop, error] = std::from_chars(word.data(), end, value);
  return error == std::errc() && stop == end ? std::optional(value) : std::nullopt;
}

std::optional<std::int64_t> utime_of(const Words& words) {
  const std::optional<double> seconds = number(words[words.size() - kNumStamps]);
  constexpr double kMostSeconds = 9e12;
  if (!seconds || !(std::abs(*seconds) < kMostSeconds)) {
    return std::nullopt;
  }
  return std::llround(*seconds * 1e6);
}

std::optional<CarmenPose> pose_at(const Words& words, std::size_t first) {
  const auto x_m = number(words[first]);
  const auto y_m = number(words[first + 1]);
  const auto theta_rad = number(words[first + 2]);
  if (!x_m || !y_m || !theta_rad) {
    return std::nullopt;
  }
  return CarmenPose{*x_m, *y_m, *theta_rad};
}

bool read_ranges(const Words& words,
                 std::size_t first,
                 std::size_t size,
                 std::vector<float>* ranges_m) {
  ranges_m->reserve(size);
  for (std::size_t i = first; i < first + size; ++i) {
    const std::optional<double> range_m = number(words[i]);
    if (!range_m) {
      return false;
    }
    ranges_m->push_back(static_cast<float>(*range_m));
  }
  return true;
}

/// FLASER lines do not say where their beams point: the number of beams tells the sensor.
void set_usual_bearings(CarmenScan* scan) {
  const std::size_t beams = scan->ranges_m.size();
  double first_deg = -90.0;
  double step_deg = beams > 1 ? 180.0 / static_cast<double>(beams - 1) : 0.0;
  if (beams == 180) {
    step_deg = 1.0;
  } else if (beams == 360) {
    step_deg = 0.5;
  } else if (beams == 401) {  // SICK at a quarter of a degree sees 100 degrees.
    first_deg = -50.0;
    step_deg = 0.25;
  } else if (beams == 682) {  // URG-04LX: 1024 steps a turn.
    step_deg = 0.3516;
    first_deg = -0.5 * step_deg * 681.0;
  }
  scan->first_bearing_rad = first_deg * kRadPerDeg;
  scan->bearing_step_rad = step_deg * kRadPerDeg;
}

// ODOM x y theta tv rv accel, stamps
CarmenLine parse_odometry(const Words& words) {
  if (words.size() != 7 + kNumStamps) {
    return CarmenMalformed{"ODOM has " + std::to_string(words.size()) + " words, not 10"};
  }
  const auto utime = utime_of(words);
  const auto pose = pose_at(words, 1);
  if (!utime || !pose) {
    return CarmenMalformed{"ODOM with a word that is no number"};
  }
  return CarmenOdometry{*utime, *pose};
}

// FLASER n ranges, x y theta (of the laser), odom_x odom_y odom_theta, stamps. Old logs have only
// one triple, which is the odometry.
CarmenLine parse_front_laser(const Words& words) {
  const auto beams = words.size() > 1 ? count(words[1]) : std::nullopt;
  const std::size_t rest = 2 + kNumStamps;
  const bool is_new = beams && words.size() == *beams + 6 + rest;
  const bool is_old =
      beams && words.size() == *beams + 3 + rest && !number(words[words.size() - 2]);
  if (!is_new && !is_old) {
    return CarmenMalformed{"FLASER whose number of words does not fit its number of readings"};
  }
  CarmenScan scan;
  const auto utime = utime_of(words);
  scan.T_odom_robot = pose_at(words, words.size() - kNumStamps - 3);
  if (!utime || !scan.T_odom_robot || !read_ranges(words, 2, *beams, &scan.ranges_m)) {
    return CarmenMalformed{"FLASER with a word that is no number"};
  }
  scan.utime = *utime;
  set_usual_bearings(&scan);
  return scan;
}

// laser_type start_angle field_of_view angular_resolution maximum_range accuracy remission_mode
// n ranges, m remissions; ROBOTLASER goes on with laser x y theta, robot x y theta, tv rv
// forward_safety side_safety turn_axis; stamps
CarmenLine parse_described_laser(const Words& words, bool has_robot_pose) {
  const std::string name(words[0]);
  const std::size_t tail = (has_robot_pose ? 11 : 0) + kNumStamps;
  const auto beams = words.size() > 8 ? count(words[8]) : std::nullopt;
  const bool has_ranges = beams && *beams < words.size() && words.size() > *beams + 9;
  const auto remissions = has_ranges ? count(words[9 + *beams]) : std::nullopt;
  if (!remissions || *remissions >= words.size() ||
      words.size() != 10 + *beams + *remissions + tail) {
    return CarmenMalformed{name + " whose number of words does not fit its number of readings"};
  }
  CarmenScan scan;
  const auto utime = utime_of(words);
  const auto start_rad = number(words[2]);
  const auto span_rad = number(words[3]);
  const auto step_rad = number(words[4]);
  const auto max_range_m = number(words[5]);
  if (has_robot_pose) {
    scan.T_odom_robot = pose_at(words, 10 + *beams + *remissions + 3);
  }
  if (!utime || !start_rad || !span_rad || !step_rad || !max_range_m ||
      scan.T_odom_robot.has_value() != has_robot_pose ||
      !read_ranges(words, 9, *beams, &scan.ranges_m)) {
    return CarmenMalformed{name + " with a word that is no number"};
  }
  scan.utime = *utime;
  scan.first_bearing_rad = *start_rad;
  scan.bearing_step_rad =
      *step_rad > 0.0 || *beams < 2 ? *step_rad : *span_rad / static_cast<double>(*beams - 1);
  scan.stated_max_range_m = *max_range_m;
  return scan;
}

}  // namespace

CarmenLine parse_carmen_line(std::string_view line) {
  constexpr std::string_view kRobotLaser = "ROBOTLASER";
  constexpr std::string_view kRawLaser = "RAWLASER";
  const Words words = words_of(line);
  if (words.empty() || words[0].front() == '#') {
    return CarmenOther{};
  }
  const std::string_view name = words[0];
  if (name == "ODOM") {
    return parse_odometry(words);
  }
  if (name == "FLASER") {
    return parse_front_laser(words);
  }
  for (const std::string_view prefix : {kRobotLaser, kRawLaser}) {
    const auto laser = name.starts_with(prefix) ? count(name.substr(prefix.size())) : std::nullopt;
    if (laser && *laser >= 1 && *laser <= 9) {
      CarmenLine parsed = parse_described_laser(words, prefix == kRobotLaser);
      if (auto* const scan = std::get_if<CarmenScan>(&parsed)) {
        scan->laser = static_cast<int>(*laser);
      }
      return parsed;
    }
  }
  constexpr std::size_t kLongestName = 32;
  return CarmenOther{std::string(name.substr(0, kLongestName))};
}

void NoReturnFinder::add(float range_m) {
  constexpr float kShareOfLargest = 0.97F;
  constexpr float kLongestReading_m = 10'000.0F;  // no laser on a robot reaches farther
  if (!(range_m > 0.0F && range_m <= kLongestReading_m)) {
    return;
  }
  ++num_readings_;
  if (range_m > largest_m_) {
    largest_m_ = range_m;
    counts_.erase(counts_.begin(), counts_.lower_bound(kShareOfLargest * largest_m_));
  }
  if (range_m >= kShareOfLargest * largest_m_) {
    ++counts_[range_m];
  }
}

double NoReturnFinder::max_range_m() const {
  constexpr std::int64_t kOften = 20;
  constexpr double kOftenShare = 0.005;
  for (const auto& [range_m, occurrences] : counts_) {
    if (occurrences >= kOften ||
        static_cast<double>(occurrences) >= kOftenShare * static_cast<double>(num_readings_)) {
      return static_cast<double>(std::nextafter(range_m, 0.0F));
    }
  }
  return static_cast<double>(largest_m_) * 1.001;
}

}  // namespace cairn::wire
