#pragma once

#include <string>
#include <vector>

#include "bench/lab/topology_command.hpp"
#include "region/region_options.hpp"

namespace cairn::lab {

/// What `cairn-lab rooms` was asked for.
struct RoomsRequest {
  std::vector<std::string> maps;
  std::vector<std::string> truths;  ///< None, or one for every map.
  std::string png_file;
  double cell_m = 0.05;
  RegionOptions options;
  bool as_json = false;
};

/// Adds `rooms` to the program. The exit status of a run that has come to its end is left in
/// *status.
void add_rooms_command(CLI::App& app, const Streams& streams, int* status);

}  // namespace cairn::lab
