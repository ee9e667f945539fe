#pragma once

#include <string>
#include <vector>

#include "bench/lab/topology_command.hpp"

namespace cairn::lab {

/// What `cairn-lab localmap` was asked for.
struct LocalmapRequest {
  std::string log;
  std::string config_file;
  std::string matcher;               ///< Name of a MatcherKind; empty: as configured.
  std::vector<std::string> without;  ///< Parts for leave_out().
  std::string relations_file;
  std::string png_file;
  std::string trajectory_file;
  std::string places_folder;
  bool as_json = false;
};

/// Adds `localmap` to the program. The exit status of a run that has come to its end is left in
/// *status.
void add_localmap_command(CLI::App& app, const Streams& streams, int* status);

}  // namespace cairn::lab
