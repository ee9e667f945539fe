#include "clients/common/hypothesis_source.hpp"

#include <string>
#include <utility>

#include "clients/common/failure.hpp"

namespace cairn::clients {

HypothesisSource::HypothesisSource(std::unique_ptr<MapSource> source, std::int64_t hypothesis_id)
    : source_(std::move(source)), map_(source_->hypothesis_map(hypothesis_id)) {
  if (map_.hypothesis_id != hypothesis_id || map_.topology.hypothesis_id != hypothesis_id) {
    throw Failure(ExitCode::kBadData, "asked for hypothesis " + std::to_string(hypothesis_id) +
                                          ", got the map of " +
                                          std::to_string(map_.topology.hypothesis_id));
  }
}

}  // namespace cairn::clients
