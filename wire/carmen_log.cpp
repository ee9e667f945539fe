#include <algorithm>
#include <array>
#include <deque>
#include <string_view>

#include <cairn_lcm/laser_scan_t.hpp>
#include <cairn_lcm/odometry_t.hpp>

#include "wire/carmen_line.hpp"
#include "wire/log_source.hpp"

namespace cairn::wire {

namespace {

/// A line of 10,000 readings has about 80 kB.
constexpr std::size_t kLongestLine = std::size_t{1} << 20U;
constexpr std::size_t kMostNames = 100;

/// Lines of a file, with their numbers.
class Lines {
 public:
  explicit Lines(FileHandle file) : file_(std::move(file)) {}

  /// Nothing at the end of the file, and after a line too long to be one. Valid until the next.
  std::optional<std::string_view> next() {
    std::size_t end = buffer_.find('\n', start_);
    while (end == std::string::npos && buffer_.size() - start_ <= kLongestLine && fill()) {
      end = buffer_.find('\n', start_);
    }
    const std::size_t left = buffer_.size() - start_;
    is_complete_ = end != std::string::npos;
    is_too_long_ = !is_complete_ && left > kLongestLine;
    if (is_too_long_ || left == 0) {
      return std::nullopt;
    }
    ++number_;
    const std::size_t length = is_complete_ ? end - start_ : left;
    const std::string_view line = std::string_view(buffer_).substr(start_, length);
    start_ += is_complete_ ? length + 1 : length;
    return line;
  }

  void rewind() {
    FileHandle file = std::move(file_);
    std::rewind(file.get());
    *this = Lines(std::move(file));
  }

  [[nodiscard]] std::int64_t number() const { return number_; }
  [[nodiscard]] std::int64_t bytes() const { return dropped_ + static_cast<std::int64_t>(start_); }
  /// Whether the last line had its end.
  [[nodiscard]] bool is_complete() const { return is_complete_; }
  [[nodiscard]] bool is_too_long() const { return is_too_long_; }

 private:
  bool fill() {
    dropped_ += static_cast<std::int64_t>(start_);
    buffer_.erase(0, start_);
    start_ = 0;
    std::array<char, 65'536> block;  // NOLINT: filled below
    const std::size_t length = std::fread(block.data(), 1, block.size(), file_.get());
    buffer_.append(block.data(), length);
    return length > 0;
  }

  FileHandle file_;
  std::string buffer_;
  std::size_t start_ = 0;     ///< Of the next line, in the buffer.
  std::int64_t dropped_ = 0;  ///< Bytes of the file that have left the buffer.
  std::int64_t number_ = 0;
  bool is_complete_ = true;
  bool is_too_long_ = false;
};

std::string channel_of(int laser) {
  return laser == 1 ? "LASER" : "LASER" + std::to_string(laser);
}

LogMessage to_log_message(std::int64_t utime, const CarmenPose& T_odom_robot) {
  cairn_lcm::odometry_t message{};
  message.utime = utime;
  message.x_m = T_odom_robot.x_m;
  message.y_m = T_odom_robot.y_m;
  message.theta_rad = T_odom_robot.theta_rad;
  return {utime, "ODOMETRY", encode(message)};
}

LogMessage to_log_message(const CarmenScan& scan, double max_range_m) {
  cairn_lcm::laser_scan_t message{};
  message.utime = scan.utime;
  message.first_bearing_rad = scan.first_bearing_rad;
  message.bearing_step_rad = scan.bearing_step_rad;
  message.max_range_m = max_range_m;
  message.num_ranges = static_cast<std::int32_t>(scan.ranges_m.size());
  message.ranges_m = scan.ranges_m;
  return {scan.utime, channel_of(scan.laser), encode(message)};
}

class CarmenLog : public LogReader::Source {
 public:
  CarmenLog(FileHandle file, std::int64_t total) : lines_(std::move(file)) {
    bytes_total = total;
    find_max_ranges();
  }

  std::optional<LogMessage> next() override {
    while (ready_.empty()) {
      const std::optional<std::string_view> line = lines_.next();
      if (!line) {
        if (lines_.is_too_long()) {
          note_damage("longer than any line of a log");
        }
        return std::nullopt;
      }
      bytes_read = lines_.bytes();
      take(parse_carmen_line(*line));
    }
    LogMessage message = std::move(ready_.front());
    ready_.pop_front();
    return message;
  }

 private:
  void find_max_ranges() {
    std::map<int, NoReturnFinder> finders;
    while (const std::optional<std::string_view> line = lines_.next()) {
      const CarmenLine parsed = parse_carmen_line(*line);
      const auto* const scan = std::get_if<CarmenScan>(&parsed);
      if (scan == nullptr) {
        continue;
      }
      for (const float range_m : scan->ranges_m) {
        finders[scan->laser].add(range_m);
      }
    }
    for (const auto& [laser, finder] : finders) {
      max_range_m_[laser] = finder.max_range_m();
    }
    lines_.rewind();
  }

  void take(const CarmenLine& line) {
    if (const auto* const odometry = std::get_if<CarmenOdometry>(&line)) {
      ready_.push_back(to_log_message(odometry->utime, odometry->T_odom_robot));
    } else if (const auto* const scan = std::get_if<CarmenScan>(&line)) {
      take(*scan);
    } else if (const auto* const other = std::get_if<CarmenOther>(&line)) {
      skip(other->name);
    } else {
      // The next line is a new start, so the reading goes on.
      note_damage(lines_.is_complete() ? std::get<CarmenMalformed>(line).reason
                                       : "the file ends within the line");
    }
  }

  // The odometry goes first: a scan is placed by the odometry up to its time.
  void take(const CarmenScan& scan) {
    if (scan.T_odom_robot) {
      ready_.push_back(to_log_message(scan.utime, *scan.T_odom_robot));
    }
    const double found_m = max_range_m_[scan.laser];
    const double stated_m = scan.stated_max_range_m;
    const bool is_stated_less = stated_m > 0.0 && (stated_m < found_m || found_m == 0.0);
    ready_.push_back(to_log_message(scan, is_stated_less ? stated_m : found_m));
  }

  void skip(const std::string& name) {
    if (!name.empty() && (skipped_lines.size() < kMostNames || skipped_lines.contains(name))) {
      ++skipped_lines[name];
    }
  }

  void note_damage(const std::string& what) {
    if (!damage) {
      damage = "line " + std::to_string(lines_.number()) + ": " + what;
    }
  }

  Lines lines_;
  std::map<int, double> max_range_m_;  ///< By number of the laser.
  std::deque<LogMessage> ready_;
};

}  // namespace

std::unique_ptr<LogReader::Source> open_carmen_log(FileHandle file, std::int64_t bytes_total) {
  return std::make_unique<CarmenLog>(std::move(file), bytes_total);
}

}  // namespace cairn::wire
