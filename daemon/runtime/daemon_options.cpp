#include "runtime/daemon_options.hpp"

#include "codec/service_options.hpp"

namespace cairn {
namespace {

OptionObject describe(LaserOptions* laser) {
  OptionObject object("laser", "A laser: its channel, where it sits, how its readings are meant.");
  object.text("channel", &laser->channel, "LCM channel.")
      .number("x_m", &laser->x_m, {-10, 10}, "Mounting pose on the robot: ahead.")
      .number("y_m", &laser->y_m, {-10, 10}, "To the left.")
      .number("theta_rad", &laser->theta_rad, {-6.3, 6.3}, "Counterclockwise.")
      .number("theta_sign", &laser->theta_sign, {-1, 1},
              "Sense of the angles in mbot's lidar_t: -1 clockwise, 1 counterclockwise.")
      .number("min_range_m", &laser->min_range_m, {0, 100}, "Shorter readings are no statement.")
      .number("max_range_m", &laser->max_range_m, {0, 1000},
              "Longer readings are no return; 0: what the message says.");
  return object;
}

OptionObject describe_inlets(DaemonOptions* options) {
  OptionObject object("inlets",
                      "What the daemon listens to. The type of a message is told by its "
                      "fingerprint, not by its channel.");
  object.list(
      "lasers", [options] { return options->lasers.size(); },
      [options](std::size_t size) { options->lasers.resize(size); },
      [options](std::size_t i) { return describe(&options->lasers[i]); },
      "Laser channels; those without traffic cost nothing.");
  object.texts("odometry_channels", &options->odometry_channels, "Odometry channels.");
  return object;
}

OptionObject describe_storage(DaemonOptions* options) {
  OptionObject object("storage", "The map file.");
  object.text("map_file", &options->map_file, "Path of the map file; --map overrides it.")
      .number("commit_every_s", &options->commit_every_s, {0.05, 60},
              "Scans reach the disk this often; visits at once.")
      .number("documents_every_s", &options->documents_every_s, {1, 3600},
              "What was published is stored this often, and at the end.");
  return object;
}

}  // namespace

DaemonOptions::DaemonOptions() {
  const InletOptions inlets;
  for (const LaserChannelOptions& laser : inlets.lasers) {
    lasers.push_back({laser.channel, laser.T_robot_laser.x(), laser.T_robot_laser.y(),
                      laser.T_robot_laser.theta(), laser.theta_sign, laser.min_range_m,
                      laser.max_range_m});
  }
  odometry_channels = inlets.odometry_channels;
}

OptionObject describe(DaemonOptions* options) {
  OptionObject object("cairnd",
                      "Configuration of cairnd. Every option has a default; an unknown one "
                      "is an error.");
  OptionObject bus("bus", "The LCM bus.");
  bus.text("lcm_url", &options->lcm_url,
           "LCM url; empty: LCM_DEFAULT_URL of the environment, else the loopback's multicast "
           "group. --lcm-url overrides it.");
  bus.integer("queued_readings", &options->queued_readings, {10, 1e6},
              "Readings that may wait for the mapping thread; the oldest make room, counted.");
  object.object(std::move(bus)).object(describe_inlets(options)).object(describe_storage(options));
  for (OptionObject& stage : describe(&options->service)) {
    object.object(std::move(stage));
  }
  return object;
}

InletOptions to_inlet_options(const DaemonOptions& options) {
  InletOptions inlets;
  inlets.lasers.clear();
  for (const LaserOptions& laser : options.lasers) {
    inlets.lasers.push_back({laser.channel, Pose2(laser.x_m, laser.y_m, laser.theta_rad),
                             laser.theta_sign, laser.min_range_m, laser.max_range_m});
  }
  inlets.odometry_channels = options.odometry_channels;
  // The sonar's inverse sensor model comes with a later version; nothing listens to it yet.
  inlets.sonar_channels.clear();
  return inlets;
}

Status validate(const DaemonOptions& options) {
  const Status inlets = validate(to_inlet_options(options));
  const Status service = validate(options.service);
  if (!inlets && !service) {
    return Error{ErrorCode::kInvalidValue, inlets.error().message + "; " + service.error().message};
  }
  return !inlets ? inlets : service;
}

Result<DaemonOptions> read_options(const std::string& json_text) {
  const Result<Json> json = parse_json(json_text);
  if (!json) {
    return json.error();
  }
  DaemonOptions options;
  if (Status status = describe(&options).read(*json); !status) {
    return status.error();
  }
  if (Status status = validate(options); !status) {
    return status.error();
  }
  return options;
}

}  // namespace cairn
