#include "bench/lab/run_breadth.hpp"

#include <utility>

namespace cairn::lab {

SearchRun run_breadth(const Exploration& exploration, const ExactSearchOptions& options) {
  Enumeration all = enumerate(exploration, options);
  SearchRun run;
  run.counts = std::move(all.counts);
  run.is_complete = all.is_complete;
  return run;
}

}  // namespace cairn::lab
