#pragma once

#include <cstdint>
#include <iosfwd>
#include <optional>
#include <string>

#include "bench/lab/noise_command.hpp"
#include "bench/lab/search.hpp"

namespace CLI {
class App;
}

namespace cairn::lab {

struct Streams {
  std::ostream& out;
  std::ostream& err;
};

/// What `cairn-lab topology` was asked for.
struct TopologyRequest {
  std::string grid;  ///< "3x4"
  std::string walk;
  std::string start;  ///< "0,0"
  std::string vectors_file;
  std::optional<std::uint64_t> seed;
  int count = 100;
  NoiseRequest noise;
  SearchKind kind = SearchKind::kDepth;
  SearchOrder order = SearchOrder::kPaths;
  ExactSearchOptions search;
  bool as_json = false;
  std::string svg_file;
  std::string dot_file;
  std::string graphml_file;
  std::string tree_dot_file;
};

/// Adds `topology` to the program. The exit status of a run that has come to its end is left in
/// *status.
void add_topology_command(CLI::App& app, const Streams& streams, int* status);

// The three things that can be explored; each gives its exit status: 1 where something that should
// be the same is not. They throw clients::Failure.

int explore_grid(const TopologyRequest& request, std::ostream& out);
int explore_vectors(const TopologyRequest& request, std::ostream& out);
int explore_random_worlds(const TopologyRequest& request, std::ostream& out);

}  // namespace cairn::lab
