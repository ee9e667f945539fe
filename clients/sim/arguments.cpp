#include "clients/sim/arguments.hpp"

#include <array>
#include <charconv>
#include <cstdio>
#include <filesystem>
#include <string>
#include <system_error>

#include <CLI/CLI.hpp>

#include "clients/sim/exit_code.hpp"

namespace cairn::sim {
namespace {

/// A number in [low, high]; unlike CLI::Range it refuses NaN.
CLI::Validator within(double low, double high) {
  std::array<char, 64> range_text{};
  std::snprintf(range_text.data(), range_text.size(), "in [%.16g, %.16g]", low, high);
  const std::string range = range_text.data();
  return {[low, high, range](std::string& word) {
            double value = 0.0;
            const char* const end = word.data() + word.size();
            const auto [stopped, error] = std::from_chars(word.data(), end, value);
            const bool holds =
                error == std::errc{} && stopped == end && value >= low && value <= high;
            return holds ? std::string() : "must be a number " + range + ", is '" + word + "'";
          },
          range};
}

/// LCM refuses other channel names.
CLI::Validator channel_name() {
  return {[](std::string& word) {
            const bool holds = !word.empty() && word.size() <= 63;
            return holds ? std::string() : "must have 1 to 63 characters, is '" + word + "'";
          },
          "CHANNEL"};
}

void add_world_options(CLI::App& app, Arguments& arguments) {
  app.add_option("world", arguments.world_file, "a drawn world, or a floor plan in PNG")
      ->required();
  app.add_option("--tour", arguments.tour, "name of the tour to drive; needless if there is one");
  app.add_flag("--list-tours", arguments.list_tours, "print the world's tours and end");
  app.add_option("--tour-file", arguments.tour_file,
                 "waypoints 'x_m y_m [name]' for a floor plan in PNG");
  app.add_option("--m-per-pixel", arguments.m_per_pixel, "side of a pixel of a floor plan in PNG")
      ->check(within(0.01, 2.0))
      ->capture_default_str();
}

void add_output_options(CLI::App& app, Arguments& arguments) {
  CLI::Option* const log =
      app.add_option("--log", arguments.log_file,
                     "write an LCM event log as fast as possible instead of publishing; the truth "
                     "goes beside it");
  app.add_option("--truth", arguments.truth_prefix,
                 "write PREFIX.truth.txt and PREFIX.junctions.txt");
  app.add_option("--lcm-url", arguments.lcm_url, "where to publish (else LCM_DEFAULT_URL)")
      ->excludes(log);
  app.add_option("--laser-channel", arguments.laser_channel)
      ->check(channel_name())
      ->capture_default_str();
  app.add_option("--odometry-channel", arguments.odometry_channel)
      ->check(channel_name())
      ->capture_default_str();
  app.add_option("--speed", arguments.speed, "simulated seconds per second")
      ->check(within(0.01, 1000.0))
      ->excludes(log)
      ->capture_default_str();
  app.add_option("--start-utime", arguments.start_utime,
                 "stamp of the start in microseconds since the epoch; live: such that no stamp is "
                 "in the future, in a log: 1000000000000000")
      ->check(within(0.0, 4e15));
  app.add_flag("--json", arguments.json, "print tours and summary as JSON");
}

void add_robot_options(CLI::App& app, Arguments& arguments, double& drift) {
  SimulationOptions& simulation = arguments.simulation;
  const auto number = [&app](const char* name, auto& value, const char* text, double low,
                             double high) {
    app.add_option(name, value, text)->check(within(low, high))->capture_default_str();
  };
  number("--seed", simulation.seed, "of all noise; same seed, same bytes", 0.0, 4294967295.0);
  number("--drive-speed", simulation.driver.speed_m_per_s, "of the robot, in m/s", 0.1, 2.0);
  number("--beams", simulation.laser.beams, "of the laser", 2.0, 10'000.0);
  number("--fov-deg", simulation.laser.fov_deg, "field of view of the laser", 1.0, 360.0);
  number("--max-range-m", simulation.laser.max_range_m, "of the laser", 0.1, 100.0);
  number("--range-noise-m", simulation.laser.noise_sigma_m, "standard deviation", 0.0, 1.0);
  number("--dropout-share", simulation.laser.dropout_share, "beams without a return", 0.0, 1.0);
  number("--laser-hz", simulation.laser_rate_hz, "sweeps per second", 0.1, 100.0);
  number("--odometry-hz", simulation.odometry_rate_hz, "readings per second", 0.1, 100.0);
  number("--odometry-drift", drift, "factor on all errors of odometry; 0: none", 0.0, 100.0);
}

/// A floor plan needs a tour file; a drawn world holds its tours and its scale.
void check_world_options(const CLI::App& app, const Arguments& arguments) {
  const bool has_tour_file = app.count("--tour-file") > 0;
  if (is_picture(arguments) && !has_tour_file) {
    throw CLI::ValidationError("--tour-file", "is needed with a floor plan in PNG");
  }
  if (!is_picture(arguments) && (has_tour_file || app.count("--m-per-pixel") > 0)) {
    throw CLI::ValidationError("--tour-file, --m-per-pixel", "are for a floor plan in PNG");
  }
}

void multiply_drift(OdometerOptions& odometer, double factor) {
  odometer.scale_error *= factor;
  odometer.turn_bias_rad_per_m *= factor;
  odometer.turn_scale_error *= factor;
  odometer.distance_noise_m_per_sqrt_m *= factor;
  odometer.heading_noise_rad_per_sqrt_m *= factor;
  odometer.heading_noise_rad_per_sqrt_rad *= factor;
}

}  // namespace

bool is_picture(const Arguments& arguments) {
  return std::filesystem::path(arguments.world_file).extension() == ".png";
}

std::optional<Arguments> parse_arguments(int argc, const char* const* argv, int& exit_code) {
  CLI::App app("A robot with laser and drifting odometry that drives a tour through a drawn world.",
               "cairn-sim");
  Arguments arguments;
  double drift = 1.0;
  app.set_version_flag("--version", "cairn-sim " CAIRN_VERSION);
  add_world_options(app, arguments);
  add_output_options(app, arguments);
  add_robot_options(app, arguments, drift);
  try {
    app.parse(argc, argv);
    check_world_options(app, arguments);
  } catch (const CLI::ParseError& end) {
    const bool is_asked_for = app.exit(end) == 0;  // --help and --version end here, too.
    exit_code = is_asked_for ? kExitDone : kExitUsage;
    return std::nullopt;
  }
  multiply_drift(arguments.simulation.odometer, drift);
  return arguments;
}

}  // namespace cairn::sim
