#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include <unistd.h>

#include "clients/sim/arguments.hpp"
#include "clients/sim/exit_code.hpp"
#include "clients/sim/recorders.hpp"
#include "clients/sim/simulation.hpp"
#include "clients/sim/world.hpp"

namespace cairn::sim {
namespace {

/// Start of a log by default: fixed, so that the same seed gives the same bytes.
constexpr std::int64_t kLogStartUtime = 1'000'000'000'000'000;

std::atomic<bool> stop_requested{false};
static_assert(std::atomic<bool>::is_always_lock_free, "set by a signal handler");

extern "C" void request_stop(int /*signal*/) {
  stop_requested = true;
}

World world_of(const Arguments& arguments) {
  return is_picture(arguments)
             ? read_floor_plan(arguments.world_file, arguments.m_per_pixel, arguments.tour_file)
             : read_world(arguments.world_file);
}

double seconds(std::int64_t duration_us) {
  return static_cast<double>(duration_us) * 1e-6;
}

double length_m(const World& world, const Tour& tour) {
  const std::vector<Point> path = path_of(world, tour);
  double sum_m = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    sum_m += distance_m(path[i - 1], path[i]);
  }
  return sum_m;
}

void list_tours(const World& world, const Arguments& arguments) {
  const char* before = "[";
  for (const Tour& tour : world.tours) {
    const double drive_s = seconds(duration_of(world, tour, arguments.simulation));
    if (arguments.json) {
      std::printf(R"(%s{"tour":"%s","length_m":%.1f,"duration_s":%.1f})", before, tour.name.c_str(),
                  length_m(world, tour), drive_s);
      before = ",";
    } else {
      std::printf("%-16s %7.1f m %7.1f s  %zu waypoints\n", tour.name.c_str(),
                  length_m(world, tour), drive_s, tour.waypoints.size());
    }
  }
  if (arguments.json) {
    std::puts(world.tours.empty() ? "[]" : "]");
  }
}

void print_summary(const DriveReport& report, double wall_s, bool json) {
  const double error_deg = report.odometry_error_rad * 180.0 / std::numbers::pi;
  const double duration_s = seconds(report.duration_us);
  if (json) {
    std::printf(
        "{\"arrived\":%s,\"travelled_m\":%.3f,\"duration_s\":%.3f,\"odometry_error_m\":%.3f,"
        "\"odometry_error_deg\":%.2f,\"times_real_time\":%.1f}\n",
        report.has_arrived ? "true" : "false", report.travelled_m, duration_s,
        report.odometry_error_m, error_deg, duration_s / wall_s);
    return;
  }
  std::printf("%s after %.1f m and %.1f s (%.0f times real time)\n",
              report.has_arrived ? "arrived" : "stopped", report.travelled_m, duration_s,
              duration_s / wall_s);
  std::printf("odometry alone ends %.2f m and %.1f degrees off\n", report.odometry_error_m,
              error_deg);
}

/// Such that no stamp lies in the future: a drive faster than real time ends now, by its stamps.
std::int64_t live_start_utime(std::int64_t duration_us, double speed) {
  const auto now = std::chrono::duration_cast<std::chrono::microseconds>(
                       std::chrono::system_clock::now().time_since_epoch())
                       .count();
  const double ahead_us = static_cast<double>(duration_us) * std::max(0.0, 1.0 - 1.0 / speed);
  return now - std::llround(ahead_us);
}

/// FILE.log -> FILE
std::string stem_of(const std::string& log_file) {
  const std::filesystem::path path(log_file);
  return path.extension() == ".log" ? std::filesystem::path(path).replace_extension().string()
                                    : log_file;
}

/// Everything that listens to one drive; opened before it begins, so that nothing is driven in
/// vain.
class Outputs {
 public:
  Outputs(const Arguments& arguments, std::int64_t duration_us) : progress_(duration_us) {
    const bool is_live = arguments.log_file.empty();
    const std::int64_t default_start =
        is_live ? live_start_utime(duration_us, arguments.speed) : kLogStartUtime;
    const MessageOptions messages = {arguments.laser_channel, arguments.odometry_channel,
                                     arguments.start_utime.value_or(default_start)};
    if (is_live) {
      group_.add(live_.emplace(arguments.lcm_url, messages, arguments.speed, stop_requested));
    } else {
      group_.add(log_.emplace(arguments.log_file, messages));
    }
    const std::string prefix =
        arguments.truth_prefix.empty() ? stem_of(arguments.log_file) : arguments.truth_prefix;
    if (!prefix.empty()) {
      group_.add(truth_.emplace(prefix, messages.start_utime));
    }
    if (shows_progress_) {
      group_.add(progress_);
    }
  }

  Recorder& recorder() { return group_; }

  void close() {
    if (shows_progress_) {
      progress_.close();
    }
    if (log_) {
      log_->close();
    }
    if (truth_) {
      truth_->close();
    }
  }

 private:
  std::optional<LogRecorder> log_;
  std::optional<LiveRecorder> live_;
  std::optional<TruthRecorder> truth_;
  ProgressRecorder progress_;
  bool shows_progress_ = isatty(STDERR_FILENO) == 1;
  RecorderGroup group_;
};

void drive(const World& world, const Tour& tour, const Arguments& arguments) {
  Outputs outputs(arguments, duration_of(world, tour, arguments.simulation));
  const auto begin = std::chrono::steady_clock::now();
  const DriveReport report =
      simulate(world, tour, arguments.simulation, stop_requested, outputs.recorder());
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - begin;
  outputs.close();
  print_summary(report, wall.count(), arguments.json);
}

int complain(const std::exception& error, int exit_code) {
  static_cast<void>(std::fprintf(stderr, "cairn-sim: %s\n", error.what()));
  return exit_code;
}

int run(const Arguments& arguments) {
  try {
    const World world = world_of(arguments);
    if (arguments.list_tours) {
      list_tours(world, arguments);
    } else {
      drive(world, tour_named(world, arguments.tour), arguments);
    }
    return kExitDone;
  } catch (const BadWorld& error) {
    return complain(error, kExitBadData);
  } catch (const NoBus& error) {
    return complain(error, kExitNoService);
  } catch (const CannotWrite& error) {
    return complain(error, kExitCannotWrite);
  }
}

}  // namespace
}  // namespace cairn::sim

int main(int argc, char** argv) {
  int exit_code = cairn::sim::kExitDone;
  const auto arguments = cairn::sim::parse_arguments(argc, argv, exit_code);
  if (!arguments) {
    return exit_code;
  }
  static_cast<void>(std::signal(SIGTERM, cairn::sim::request_stop));
  static_cast<void>(std::signal(SIGINT, cairn::sim::request_stop));
  return cairn::sim::run(*arguments);
}
