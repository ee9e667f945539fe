#pragma once

#include <cstdint>
#include <memory>
#include <ostream>
#include <string>

#include <CLI/CLI.hpp>

#include "clients/common/daemon_link.hpp"

namespace cairn::clients {

/// Where the commands write. Data and messages are kept apart, so that output can be piped.
struct Streams {
  std::ostream& out;
  std::ostream& err;
};

/// Options that many subcommands share.
struct SourceOptions {
  LinkOptions link;
  std::string map_file;  ///< Empty: ask the daemon.
  bool as_json = false;
  std::int64_t hypothesis = -1;  ///< A live one; -1: the best one.
};

void add_link_options(CLI::App& command, LinkOptions* link);
void add_map_file(CLI::App& command, SourceOptions* options);
/// For commands that show a map: another one than the best.
void add_hypothesis(CLI::App& command, SourceOptions* options);
void add_json_flag(CLI::App& command, bool* as_json);

/// Accepts whole numbers from `low` on that fit into `high`; says what came in a few words, however
/// long it is.
[[nodiscard]] CLI::Validator whole_number(std::int64_t low, std::int64_t high);
/// What a person typed, short enough for a message.
[[nodiscard]] std::string as_typed(const std::string& text);

/// The map file where one is named, otherwise the daemon; of these the hypothesis that is named.
[[nodiscard]] std::unique_ptr<MapSource> open_source(const SourceOptions& options);

// Each adds one subcommand, which does its work when the command line is parsed and throws Failure
// where it cannot.
void add_status_command(CLI::App& app, const Streams& streams);
void add_watch_command(CLI::App& app, const Streams& streams);
void add_places_command(CLI::App& app, const Streams& streams);
void add_hypotheses_command(CLI::App& app, const Streams& streams);
void add_map_command(CLI::App& app, const Streams& streams);
void add_name_command(CLI::App& app, const Streams& streams);
void add_assertion_commands(CLI::App& app, const Streams& streams);
void add_consistency_command(CLI::App& app, const Streams& streams);
void add_why_command(CLI::App& app, const Streams& streams);
void add_path_command(CLI::App& app, const Streams& streams);
void add_export_command(CLI::App& app, const Streams& streams);
void add_log_command(CLI::App& app, const Streams& streams);

}  // namespace cairn::clients
