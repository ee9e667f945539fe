#include <algorithm>
#include <map>

#include <nlohmann/json.hpp>

#include "clients/cairn/commands.hpp"
#include "clients/common/failure.hpp"
#include "clients/common/json.hpp"
#include "clients/common/message_types.hpp"
#include "clients/common/progress.hpp"
#include "clients/common/text.hpp"
#include "wire/log_reader.hpp"
#include "wire/log_writer.hpp"

namespace cairn::clients {
namespace {

struct LogOptions {
  std::string input;
  std::string output;
  bool as_json = false;
};

wire::LogReader open_log(const std::string& path) {
  wire::Expected<wire::LogReader> reader = wire::LogReader::open(path);
  if (!reader) {
    throw Failure(ExitCode::kBadData, reader.error());
  }
  return *std::move(reader);
}

/// What one channel of a log carries.
struct ChannelSummary {
  std::int64_t messages = 0;
  std::int64_t bytes = 0;
  std::int64_t first_utime = 0;
  std::int64_t last_utime = 0;
  std::int64_t backward_steps = 0;
  double longest_gap_s = 0.0;
  std::map<std::string, std::int64_t> types;

  void add(const wire::LogMessage& message) {
    if (messages == 0) {
      first_utime = message.utime;
    } else {
      const double step_s =
          static_cast<double>(message.utime) * 1e-6 - static_cast<double>(last_utime) * 1e-6;
      backward_steps += message.utime < last_utime ? 1 : 0;
      longest_gap_s = std::max(longest_gap_s, step_s);
    }
    last_utime = message.utime;
    ++messages;
    bytes += static_cast<std::int64_t>(message.bytes.size());
    ++types[message_type_of(message.bytes)];
  }
  [[nodiscard]] double span_s() const {
    return static_cast<double>(last_utime) * 1e-6 - static_cast<double>(first_utime) * 1e-6;
  }
  [[nodiscard]] double rate_hz() const {
    return messages > 1 && span_s() > 0.0 ? static_cast<double>(messages - 1) / span_s() : 0.0;
  }
  [[nodiscard]] std::string type_text() const {
    std::string text;
    for (const auto& [type, count] : types) {
      text += (text.empty() ? "" : ", ") + type +
              (types.size() > 1 ? " x " + std::to_string(count) : "");
    }
    return text;
  }
};

using Summary = std::map<std::string, ChannelSummary>;

Summary summarize(wire::LogReader& reader) {
  Summary summary;
  Progress progress("reading the log");
  while (const std::optional<wire::LogMessage> message = reader.next()) {
    summary[message->channel].add(*message);
    progress.show(reader.bytes_read(), reader.bytes_total());
  }
  return summary;
}

nlohmann::ordered_json to_json(const Summary& summary, const wire::LogReader& reader) {
  nlohmann::ordered_json json = {{"channels", nlohmann::ordered_json::array()}};
  for (const auto& [channel, s] : summary) {
    json["channels"].push_back({{"channel", channel},
                                {"types", s.types},
                                {"messages", s.messages},
                                {"bytes", s.bytes},
                                {"first_utime", s.first_utime},
                                {"last_utime", s.last_utime},
                                {"rate_hz", s.rate_hz()},
                                {"longest_gap_s", s.longest_gap_s},
                                {"backward_steps", s.backward_steps}});
  }
  json["skipped_lines"] = reader.skipped_lines();
  json["damage"] = reader.damage() ? nlohmann::ordered_json(*reader.damage()) : nullptr;
  return json;
}

void print(std::ostream& out, const Summary& summary, const wire::LogReader& reader) {
  Table table(
      {"channel", "messages", "rate_hz", "span_s", "longest_gap_s", "backward", "bytes", "type"});
  for (const auto& [channel, s] : summary) {
    table.add({printable(channel), std::to_string(s.messages), fixed(s.rate_hz(), 2),
               fixed(s.span_s(), 1), fixed(s.longest_gap_s, 2), std::to_string(s.backward_steps),
               std::to_string(s.bytes), s.type_text()});
  }
  table.print(out);
  for (const auto& [word, count] : reader.skipped_lines()) {
    out << "skipped " << count << " lines " << printable(word) << '\n';
  }
}

// The rest of a damaged log is lost, what came before stands; the caller must still be told.
void require_whole(const wire::LogReader& reader, const std::string& path) {
  if (reader.damage()) {
    throw Failure(ExitCode::kBadData, path + ": damaged: " + *reader.damage());
  }
}

void inspect(const LogOptions& options, const Streams& streams) {
  wire::LogReader reader = open_log(options.input);
  const Summary summary = summarize(reader);
  if (options.as_json) {
    streams.out << dumped(to_json(summary, reader)) << '\n';
  } else {
    print(streams.out, summary, reader);
  }
  require_whole(reader, options.input);
}

void convert(const LogOptions& options, const Streams& streams) {
  std::error_code error;
  if (std::filesystem::equivalent(options.input, options.output, error)) {
    throw Failure(ExitCode::kUsage, "log convert: input and output are the same file");
  }
  wire::LogReader reader = open_log(options.input);
  wire::Expected<wire::LogWriter> writer = wire::LogWriter::open(options.output);
  if (!writer) {
    throw Failure(ExitCode::kCannotCreate, writer.error());
  }
  std::int64_t count = 0;
  {
    Progress progress("converting");
    while (const std::optional<wire::LogMessage> message = reader.next()) {
      if (!writer->write(message->utime, message->channel, message->bytes)) {
        break;
      }
      ++count;
      progress.show(reader.bytes_read(), reader.bytes_total());
    }
  }
  if (!writer->close()) {
    throw Failure(ExitCode::kCannotCreate, "cannot write " + options.output);
  }
  streams.err << "wrote " << count << " messages to " << options.output << '\n';
  require_whole(reader, options.input);
}

}  // namespace

void add_log_command(CLI::App& app, const Streams& streams) {
  CLI::App* command = app.add_subcommand("log", "Recorded logs, CARMEN or LCM");
  command->require_subcommand(1);
  const auto options = std::make_shared<LogOptions>();

  CLI::App* converting = command->add_subcommand("convert", "Writes a log as LCM event log");
  converting->add_option("in", options->input, "CARMEN or LCM log")->required();
  converting->add_option("out", options->output, "LCM event log to write")->required();
  converting->callback([options, streams] { convert(*options, streams); });

  CLI::App* inspecting =
      command->add_subcommand("inspect", "Channels, types, rates, gaps and steps back in time");
  inspecting->add_option("in", options->input, "CARMEN or LCM log")->required();
  add_json_flag(*inspecting, &options->as_json);
  inspecting->callback([options, streams] { inspect(*options, streams); });
}

}  // namespace cairn::clients
