// Arguments, configuration, exit codes; nothing else.

#include <cstdio>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "runtime/daemon.hpp"
#include "runtime/daemon_options.hpp"
#include "runtime/exit_code.hpp"
#include "runtime/logging.hpp"
#include "runtime/replay.hpp"
#include "runtime/version.hpp"

namespace cairn {
namespace {

struct Arguments {
  std::string config_file;
  std::string lcm_url;
  std::string map_file;
  std::vector<std::string> replay_logs;
  bool check_config = false;
  bool dump_config = false;
  bool dump_schema = false;
  bool dump_options = false;
  bool self_test = false;
  bool json = false;
  bool verbose = false;
};

void declare(CLI::App* app, Arguments* arguments) {
  const auto not_empty = CLI::Validator(
      [](const std::string& text) { return text.empty() ? "must not be empty" : std::string(); },
      "");
  app->add_option("--config", arguments->config_file,
                  "configuration file (JSON); all defaults are built in")
      ->check(not_empty);
  app->add_option("--lcm-url", arguments->lcm_url, "LCM url of the bus")->check(not_empty);
  app->add_option("--map", arguments->map_file, "map file; created where there is none")
      ->check(not_empty);
  app->add_option("--replay", arguments->replay_logs,
                  "run recorded logs (CARMEN or LCM) offline into a new map file, then exit")
      ->check(not_empty);
  app->add_flag("--check-config", arguments->check_config, "check the configuration, then exit");
  app->add_flag("--dump-config", arguments->dump_config,
                "print the effective configuration, then exit");
  app->add_flag("--dump-schema", arguments->dump_schema,
                "print the JSON schema of the configuration, then exit");
  app->add_flag("--dump-options", arguments->dump_options,
                "print every option as a Markdown table, then exit");
  app->add_flag("--self-test", arguments->self_test, "test the bus, then exit");
  app->add_flag("--json", arguments->json, "print the summary of a replay as JSON");
  app->add_flag("--verbose", arguments->verbose, "log more");
  app->set_version_flag("--version", std::string("cairnd ") + kVersion);
}

int fail(ExitCode code, const std::string& message) {
  static_cast<void>(std::fprintf(stderr, "cairnd: %s\n", message.c_str()));
  return to_status(code);
}

Result<DaemonOptions> read_options_file(const std::string& name) {
  std::ifstream file(name);
  if (!file) {
    return Error{ErrorCode::kNotFound, "the file cannot be read"};
  }
  std::ostringstream content;
  content << file.rdbuf();
  return read_options(content.str());
}

Result<DaemonOptions> options_of(const Arguments& arguments) {
  Result<DaemonOptions> options =
      arguments.config_file.empty() ? read_options("{}") : read_options_file(arguments.config_file);
  if (!options) {
    return Error{options.error().code,
                 (arguments.config_file.empty() ? "defaults" : arguments.config_file) + ": " +
                     options.error().message};
  }
  if (!arguments.lcm_url.empty()) {
    options->lcm_url = arguments.lcm_url;
  }
  if (!arguments.map_file.empty()) {
    options->map_file = arguments.map_file;
  }
  return options;
}

int run(const Arguments& arguments) {
  Result<DaemonOptions> options = options_of(arguments);
  if (!options) {
    return fail(ExitCode::kConfig, options.error().message);
  }
  if (arguments.check_config) {
    static_cast<void>(std::printf("the configuration is sound\n"));
    return to_status(ExitCode::kOk);
  }
  if (arguments.dump_config || arguments.dump_schema || arguments.dump_options) {
    const OptionObject description = describe(&*options);
    const std::string text = arguments.dump_config   ? description.write().dump(2) + "\n"
                             : arguments.dump_schema ? description.schema().dump(2) + "\n"
                                                     : description.table();
    static_cast<void>(std::printf("%s", text.c_str()));
    return to_status(ExitCode::kOk);
  }
  if (arguments.self_test) {
    return to_status(test_bus(*options));
  }
  if (!arguments.replay_logs.empty()) {
    if (arguments.map_file.empty()) {
      return fail(ExitCode::kUsage, "--replay needs --map FILE for the map it makes");
    }
    return to_status(replay(*options, arguments.replay_logs, arguments.map_file, arguments.json));
  }
  start_logging(arguments.verbose);
  return to_status(serve(*options));
}

}  // namespace
}  // namespace cairn

int main(int argc, char** argv) {
  CLI::App app("cairnd: topological mapping for mobile robots over LCM");
  cairn::Arguments arguments;
  cairn::declare(&app, &arguments);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : cairn::to_status(cairn::ExitCode::kUsage);
  }
  return cairn::run(arguments);
}
