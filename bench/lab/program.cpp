#include "bench/lab/program.hpp"

#include <algorithm>
#include <exception>
#include <new>
#include <ostream>

#include <CLI/CLI.hpp>

#include "bench/lab/buildings_command.hpp"
#include "bench/lab/closures_command.hpp"
#include "bench/lab/islands_command.hpp"
#include "bench/lab/layout_command.hpp"
#include "bench/lab/localmap_command.hpp"
#include "bench/lab/places_command.hpp"
#include "bench/lab/recognition_command.hpp"
#include "bench/lab/rooms_command.hpp"
#include "bench/lab/topology_command.hpp"
#include "bench/lab/trajectory_command.hpp"
#include "clients/common/failure.hpp"

namespace cairn::lab {
namespace {

using clients::ExitCode;
using clients::Failure;

constexpr char kExitStatus[] =
    "Exit status: 0 done; 1 done, but the counts are not those of the file, an agreement does "
    "not hold, or a layout has not converged; 64 wrong command line; 65 bad data; 73 cannot write; "
    "78 wrong configuration.";

/// No option of any command has a meaning without a value: an empty name, as of a shell variable
/// that is not set, would be taken for a file that is not wanted.
void check_no_empty(const std::vector<std::string>& arguments) {
  std::string before;
  for (const std::string& argument : arguments) {
    if (argument.empty()) {
      throw Failure(ExitCode::kUsage, before + (before.empty() ? "" : ": ") +
                                          "expected the name of a file, or a value: it is empty");
    }
    if (argument.size() > 2 && argument.rfind("--", 0) == 0 && argument.back() == '=') {
      throw Failure(ExitCode::kUsage, argument.substr(0, argument.size() - 1) +
                                          ": expected the name of a file, or a value: it is empty");
    }
    before = argument;
  }
}

}  // namespace

int run_lab(const std::vector<std::string>& arguments, std::ostream& out, std::ostream& err) {
  CLI::App app{"Experiments with cairn's algorithms where the right answer is known.", "cairn-lab"};
  app.set_version_flag("--version", "cairn-lab " CAIRN_VERSION);
  app.footer(kExitStatus);
  app.require_subcommand(1);
  int status = 0;
  try {
    add_topology_command(app, {out, err}, &status);
    add_localmap_command(app, {out, err}, &status);
    add_places_command(app, {out, err}, &status);
    add_closures_command(app, {out, err}, &status);
    add_trajectory_command(app, {out, err});
    add_buildings_command(app, {out, err}, &status);
    add_islands_command(app, {out, err}, &status);
    add_rooms_command(app, {out, err}, &status);
    add_recognition_command(app, {out, err}, &status);
    add_layout_command(app, {out, err}, &status);
    check_no_empty(arguments);
    std::vector<std::string> reversed(arguments.rbegin(), arguments.rend());
    app.parse(reversed);
    out.flush();
    return out ? status : static_cast<int>(ExitCode::kCannotCreate);
  } catch (const CLI::ParseError& error) {
    return app.exit(error, out, err) == 0 ? 0 : static_cast<int>(ExitCode::kUsage);
  } catch (const Failure& failure) {
    out.flush();
    err << "cairn-lab: " << failure.what() << '\n';
    return static_cast<int>(failure.code());
  } catch (const std::bad_alloc&) {
    err << "cairn-lab: not enough memory for this search; --max-nodes bounds it\n";
    return static_cast<int>(ExitCode::kBadData);
  } catch (const std::exception& error) {
    err << "cairn-lab: " << error.what() << '\n';
    return static_cast<int>(ExitCode::kBadData);
  }
}

}  // namespace cairn::lab
