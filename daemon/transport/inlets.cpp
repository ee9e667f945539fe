#include "transport/inlets.hpp"

#include "base/validator.hpp"
#include "transport/by_fingerprint.hpp"

namespace cairn {
namespace {

/// Messages LCM keeps for us. We are quick; this only covers a moment without the processor.
constexpr int kLaserQueue = 30;
constexpr int kOdometryQueue = 200;

/// A sender that makes up types must not fill our memory.
constexpr std::size_t kMostRemarks = 100;
/// Of one channel that are worth a line in the log; all are counted.
constexpr std::int64_t kMostChangesSaid = 20;

}  // namespace

std::vector<LaserChannelOptions> usual_lasers() {
  std::vector<LaserChannelOptions> lasers;
  for (const char* const channel :
       {"LASER", "LIDAR", "RPLIDAR_LASER", "SKIRT_FRONT", "SENSOR_LASER_FRONT_6DOF"}) {
    lasers.emplace_back().channel = channel;
  }
  return lasers;
}

Status validate(const InletOptions& options) {
  std::set<std::string> channels;
  bool is_unique = true;
  bool is_named = true;
  const auto see = [&](const std::string& channel) {
    is_unique = channels.insert(channel).second && is_unique;
    is_named = is_named && !channel.empty() && channel.size() <= wire::kMaxChannelLength;
  };
  for (const LaserChannelOptions& laser : options.lasers) {
    if (Status status = validate(laser); !status) {
      return status;
    }
    see(laser.channel);
  }
  for (const auto* const list : {&options.odometry_channels, &options.sonar_channels}) {
    for (const std::string& channel : *list) {
      see(channel);
    }
  }
  return Validator("inlets")
      .require("lasers", !options.lasers.empty(), "name at least one channel")
      .require("odometry_channels", !options.odometry_channels.empty(), "name at least one channel")
      .require("channels", is_named, "have names of 1 to 63 characters")
      .require("channels", is_unique, "be named once only")
      .status();
}

Inlets::Inlets(const InletOptions& options, Sinks sinks) {
  for (std::size_t i = 0; i < options.lasers.size(); ++i) {
    const LaserChannelOptions& laser = options.lasers[i];
    add_channel(
        laser.channel, kLaserQueue,
        [laser](const std::uint8_t* bytes, std::size_t size) {
          return scan_of(bytes, size, laser);
        },
        [this, sink = sinks.scan, number = static_cast<int>(i),
         channel = laser.channel](LaserScan scan) {
          scan.laser = number;
          watch_shape(scan, channel);
          sink(std::move(scan));
        });
  }
  for (const std::string& channel : options.odometry_channels) {
    add_channel(channel, kOdometryQueue, odometry_of, sinks.odometry);
  }
  for (const std::string& channel : options.sonar_channels) {
    add_channel(channel, kLaserQueue, sonar_of, sinks.sonar);
  }
}

template <class Adapter, class Sink>
void Inlets::add_channel(const std::string& channel,
                         int queue_capacity,
                         Adapter adapter,
                         Sink sink) {
  const Receive receive = [this, channel, adapter, sink](
                              ChannelCounters& counters, const std::uint8_t* bytes,
                              std::size_t size, std::optional<TimePoint> now) {
    auto value = adapter(bytes, size);
    if (!value) {
      return refuse(channel, value.error(), &counters);
    }
    if (now && seconds_between(*now, value->time) > kMaxAhead_s) {
      ++counters.in_future;
      return refuse(channel,
                    {ErrorCode::kOutOfOrder,
                     "stamp is " + std::to_string(seconds_between(*now, value->time)) +
                         " s ahead of the clock"},
                    &counters);
    }
    ++counters.accepted;
    sink(*std::move(value));
    return Outcome::kAccepted;
  };
  channels_[channel] = {queue_capacity, receive};
  counters_[channel];
}

void Inlets::watch_shape(const LaserScan& scan, const std::string& channel) {
  const std::optional<std::string> change = shapes_[scan.laser].take(scan);
  if (!change) {
    return;
  }
  const std::int64_t changes = ++counters_.find(channel)->second.laser_changes;
  if (changes <= kMostChangesSaid && remarks_.size() < kMostRemarks) {
    remarks_.push_back(channel + ": " + *change);
  }
}

Inlets::Outcome Inlets::refuse(std::string_view channel,
                               const Error& error,
                               ChannelCounters* counters) {
  // Unknown types differ in their text, so that each is named; of other refusals only the first.
  const bool is_news = error.code == ErrorCode::kNotFound
                           ? named_.size() < kMostRemarks &&
                                 named_.insert(std::string(channel) + error.message).second
                           : counters->last_refusal.empty();
  if (is_news && remarks_.size() < kMostRemarks) {
    remarks_.push_back(std::string(channel) + ": " + error.message);
  }
  counters->last_refusal = error.message;
  switch (error.code) {
    case ErrorCode::kNotFound:
      ++counters->unknown_type;
      return Outcome::kUnknownType;
    case ErrorCode::kMalformed:
      ++counters->malformed;
      return Outcome::kMalformed;
    case ErrorCode::kOutOfOrder:
      return Outcome::kRefused;
    default:
      ++counters->refused;
      return Outcome::kRefused;
  }
}

Status Inlets::subscribe(wire::Bus& bus, std::function<TimePoint()> clock) {
  for (const auto& [channel, inlet] : channels_) {
    const bool is_subscribed =
        bus.subscribe(channel, inlet.queue_capacity, [this, clock](const wire::Received& message) {
          dispatch(message.channel, message.bytes, message.size, clock());
        });
    if (!is_subscribed) {
      return Error{ErrorCode::kUnavailable, "LCM refuses to subscribe to " + channel};
    }
  }
  return {};
}

Inlets::Outcome Inlets::dispatch(std::string_view channel,
                                 const std::uint8_t* bytes,
                                 std::size_t size,
                                 std::optional<TimePoint> now) {
  const auto inlet = channels_.find(channel);
  if (inlet == channels_.end()) {
    return Outcome::kNotOurs;
  }
  return inlet->second.receive(counters_.find(channel)->second, bytes, size, now);
}

}  // namespace cairn
