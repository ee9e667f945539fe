#pragma once

#include <string>
#include <vector>

#include "codec/option_object.hpp"
#include "service/options.hpp"
#include "transport/inlets.hpp"

namespace cairn {

/// A laser as the configuration file says it.
struct LaserOptions {
  std::string channel;
  double x_m = 0.0;
  double y_m = 0.0;
  double theta_rad = 0.0;
  double theta_sign = -1.0;
  double min_range_m = 0.0;
  double max_range_m = 0.0;
};

/// Everything that can be configured, with its defaults. The configuration file is this as JSON.
struct DaemonOptions {
  std::string lcm_url;  ///< Empty: LCM_DEFAULT_URL, or else the loopback's multicast group.
  std::vector<LaserOptions> lasers;
  std::vector<std::string> odometry_channels;
  std::string map_file = "map.cairn";
  double commit_every_s = 1.0;
  double documents_every_s = 30.0;
  int queued_readings = 2000;
  ServiceOptions service;

  DaemonOptions();
};

/// The whole configuration, bound to `options`, which must outlive it.
[[nodiscard]] OptionObject describe(DaemonOptions* options);

[[nodiscard]] Status validate(const DaemonOptions& options);
[[nodiscard]] InletOptions to_inlet_options(const DaemonOptions& options);

/// Defaults, overridden by what the JSON text says. All violations are told in one round.
[[nodiscard]] Result<DaemonOptions> read_options(const std::string& json_text);

}  // namespace cairn
