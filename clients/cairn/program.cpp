#include "clients/cairn/program.hpp"

#include <algorithm>
#include <charconv>
#include <exception>
#include <limits>
#include <new>
#include <utility>

#include "clients/cairn/commands.hpp"
#include "clients/common/failure.hpp"
#include "clients/common/hypothesis_source.hpp"
#include "clients/common/map_file.hpp"
#include "clients/common/text.hpp"
#include "clients/common/within.hpp"

namespace cairn::clients {
namespace {

constexpr char kExitStatus[] =
    "Exit status: 0 done; 64 wrong command line; 65 bad data, or no such place; 69 no daemon, or "
    "it "
    "could not do it; 73 cannot write; 78 the bus cannot be opened.";

int status_of(ExitCode code) {
  return static_cast<int>(code);
}

void add_commands(CLI::App& app, const Streams& streams) {
  add_status_command(app, streams);
  add_watch_command(app, streams);
  add_places_command(app, streams);
  add_hypotheses_command(app, streams);
  add_map_command(app, streams);
  add_name_command(app, streams);
  add_assertion_commands(app, streams);
  add_consistency_command(app, streams);
  add_why_command(app, streams);
  add_path_command(app, streams);
  add_export_command(app, streams);
  add_log_command(app, streams);
  app.require_subcommand(1);
}

}  // namespace

void add_link_options(CLI::App& command, LinkOptions* link) {
  command.add_option("--lcm-url", link->lcm_url,
                     "Bus of the daemon [LCM_DEFAULT_URL, else multicast on this machine]");
  command.add_option("--timeout", link->timeout_s, "Seconds to wait for a daemon")
      ->capture_default_str()
      ->check(within(0.05, 3600.0));
}

void add_map_file(CLI::App& command, SourceOptions* options) {
  command.add_option("mapfile", options->map_file, "Read this map file instead of asking a daemon");
}

void add_hypothesis(CLI::App& command, SourceOptions* options) {
  command
      .add_option("--hypothesis", options->hypothesis,
                  "Another one of 'cairn hypotheses' than the best, drawn by the daemon for this")
      ->check(whole_number(0, std::numeric_limits<std::int64_t>::max()));
}

void add_json_flag(CLI::App& command, bool* as_json) {
  command.add_flag("--json", *as_json, "Print JSON");
}

std::string as_typed(const std::string& text) {
  constexpr std::size_t kMost = 40;
  return "'" + printable(text.size() <= kMost ? text : text.substr(0, kMost - 3) + "...") + "'";
}

CLI::Validator whole_number(std::int64_t low, std::int64_t high) {
  const auto complaint = [low, high](const std::string& text) -> std::string {
    std::int64_t number = 0;
    const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error == std::errc() && stop == text.data() + text.size() && number >= low &&
        number <= high) {
      return "";
    }
    return "expected a whole number from " + std::to_string(low) + " to " + std::to_string(high) +
           ", got " + as_typed(text);
  };
  return {[complaint](std::string& text) { return complaint(text); }, "", "whole_number"};
}

std::unique_ptr<MapSource> open_source(const SourceOptions& options) {
  std::unique_ptr<MapSource> source;
  if (options.map_file.empty()) {
    source = std::make_unique<DaemonLink>(options.link);
  } else {
    source = std::make_unique<MapFile>(options.map_file);
  }
  if (options.hypothesis >= 0) {
    source = std::make_unique<HypothesisSource>(std::move(source), options.hypothesis);
  }
  return source;
}

int run_cairn(const std::vector<std::string>& arguments, std::ostream& out, std::ostream& err) {
  CLI::App app{"Looks at maps of cairnd, running or in a file, and asks for ways.", "cairn"};
  app.set_version_flag("--version", "cairn " CAIRN_VERSION);
  app.footer(kExitStatus);
  try {
    add_commands(app, {out, err});
    std::vector<std::string> reversed(arguments.rbegin(), arguments.rend());
    app.parse(reversed);
    out.flush();
    return status_of(out ? ExitCode::kOk : ExitCode::kCannotCreate);
  } catch (const CLI::ParseError& error) {
    return app.exit(error, out, err) == 0 ? 0 : status_of(ExitCode::kUsage);
  } catch (const Failure& failure) {
    out.flush();
    err << "cairn: " << failure.what() << '\n';
    return status_of(failure.code());
  } catch (const std::bad_alloc&) {
    err << "cairn: not enough memory for this map\n";
    return status_of(ExitCode::kBadData);
  } catch (const std::exception& error) {
    err << "cairn: " << error.what() << '\n';
    return status_of(ExitCode::kBadData);
  }
}

}  // namespace cairn::clients
