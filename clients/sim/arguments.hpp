#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "clients/sim/simulation.hpp"

namespace cairn::sim {

/// What the command line asks for.
struct Arguments {
  std::string world_file;
  std::string tour_file;  ///< Of a PNG world.
  double m_per_pixel = 0.05;
  std::string tour;
  bool list_tours = false;
  bool json = false;

  std::string log_file;  ///< Empty: live.
  std::string truth_prefix;
  std::string lcm_url;
  std::string laser_channel = "LASER";
  std::string odometry_channel = "ODOMETRY";
  double speed = 1.0;  ///< Simulated seconds per second, live.
  std::optional<std::int64_t> start_utime;

  SimulationOptions simulation;
};

/// Whether the world is a floor plan in PNG, by its name.
[[nodiscard]] bool is_picture(const Arguments& arguments);

/// Parses the command line; prints help, version or what is wrong with it.
/// @return nothing where the program is to end with `exit_code`
[[nodiscard]] std::optional<Arguments> parse_arguments(int argc,
                                                       const char* const* argv,
                                                       int& exit_code);

}  // namespace cairn::sim
