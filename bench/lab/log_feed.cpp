#include "bench/lab/log_feed.hpp"

#include <optional>

#include "clients/common/failure.hpp"
#include "clients/common/progress.hpp"
#include "wire/log_reader.hpp"

namespace cairn::lab {

using clients::ExitCode;
using clients::Failure;

std::string feed_log(const std::string& log, const DaemonOptions& options, const LogSinks& sinks) {
  wire::Expected<wire::LogReader> reader = wire::LogReader::open(log);
  if (!reader) {
    throw Failure(ExitCode::kBadData, reader.error());
  }
  Inlets inlets(to_inlet_options(options), {sinks.scan, sinks.odometry, [](const SonarRing&) {}});
  clients::Progress progress(log);
  while (const std::optional<wire::LogMessage> message = reader->next()) {
    if (sinks.before_message) {
      sinks.before_message();
    }
    inlets.dispatch(message->channel, message->bytes.data(), message->bytes.size());
    if (sinks.after_message) {
      sinks.after_message();
    }
    progress.show(reader->bytes_read(), reader->bytes_total());
  }
  if (sinks.at_end) {
    sinks.at_end(inlets);
  }
  return reader->damage().value_or("");
}

void refuse_without_scans(const std::string& log, const std::string& damage) {
  throw Failure(ExitCode::kBadData,
                log + ": no scan in it" + (damage.empty() ? "" : "; " + damage));
}

double seconds_of(TimePoint time) {
  return static_cast<double>(utime_of(time)) * 1e-6;
}

}  // namespace cairn::lab
