#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/result.hpp"
#include "sensing/time.hpp"
#include "transport/adapters.hpp"
#include "transport/laser_shape.hpp"
#include "wire/bus.hpp"

namespace cairn {

/// One front laser at the middle of the robot, on whichever of the usual channels it comes.
[[nodiscard]] std::vector<LaserChannelOptions> usual_lasers();

/// Which channels carry what. In the configuration file: the object "inlets".
struct InletOptions {
  std::vector<LaserChannelOptions> lasers = usual_lasers();
  std::vector<std::string> odometry_channels = {"ODOMETRY", "MBOT_ODOMETRY", "POSE",
                                                "SENSOR_ODOMETRY"};
  std::vector<std::string> sonar_channels = {"SONAR"};
};

/// Every laser sound; no channel twice.
[[nodiscard]] Status validate(const InletOptions& options);

/// What has come of the messages of one channel.
struct ChannelCounters {
  std::int64_t accepted = 0;
  std::int64_t refused = 0;        ///< By their content.
  std::int64_t in_future = 0;      ///< Stamped ahead of our clock.
  std::int64_t malformed = 0;      ///< Bytes that are no message.
  std::int64_t unknown_type = 0;   ///< A fingerprint nobody knows.
  std::int64_t laser_changes = 0;  ///< Of the beams or the view of a laser, in the midst of work.
  std::string last_refusal;        ///< Why the last one was not accepted; empty: none yet.
};

/// Turns the messages of the input channels into scans, odometry and sonar rings, and counts what
/// is wrong with the others. Live traffic and the replay of a log take the same way. One thread.
class Inlets {
 public:
  /// Stamps may be ahead of the clock by this much.
  static constexpr double kMaxAhead_s = 1.0;

  struct Sinks {
    std::function<void(LaserScan)> scan;
    std::function<void(OdometrySample)> odometry;
    std::function<void(SonarRing)> sonar;
  };
  enum class Outcome { kAccepted, kRefused, kMalformed, kUnknownType, kNotOurs };

  /// @param sinks every one of them set
  Inlets(const InletOptions& options, Sinks sinks);

  /// Takes the messages of all input channels from the bus. `this` must live as long as the bus
  /// is handled.
  /// @param clock of this machine, as stamps are compared with it
  [[nodiscard]] Status subscribe(wire::Bus& bus, std::function<TimePoint()> clock);

  /// @param now nothing in a replay, where stamps are older than any clock
  Outcome dispatch(std::string_view channel,
                   const std::uint8_t* bytes,
                   std::size_t size,
                   std::optional<TimePoint> now = std::nullopt);

  /// By channel; every input channel is there from the start.
  [[nodiscard]] const std::map<std::string, ChannelCounters, std::less<>>& counters() const {
    return counters_;
  }
  /// What is new and worth a line in the log: each unknown type once, the first refusal of a
  /// channel, and the first changes of a laser. Empties the list.
  [[nodiscard]] std::vector<std::string> take_remarks() { return std::exchange(remarks_, {}); }

 private:
  using Receive = std::function<Outcome(
      ChannelCounters&, const std::uint8_t*, std::size_t, std::optional<TimePoint>)>;
  struct Channel {
    int queue_capacity = 0;
    Receive receive;
  };

  template <class Adapter, class Sink>
  void add_channel(const std::string& channel, int queue_capacity, Adapter adapter, Sink sink);
  void watch_shape(const LaserScan& scan, const std::string& channel);
  Outcome refuse(std::string_view channel, const Error& error, ChannelCounters* counters);

  std::map<std::string, Channel, std::less<>> channels_;
  std::map<std::string, ChannelCounters, std::less<>> counters_;
  std::map<int, LaserShapeWatch> shapes_;  ///< By laser.
  std::vector<std::string> remarks_;
  std::set<std::string> named_;  ///< Channels with unknown types that were remarked on.
};

}  // namespace cairn
