#include "service/options.hpp"

#include <string>

#include "topology/evidence.hpp"

namespace cairn {

Status validate(const ServiceOptions& options) {
  std::string complaints;
  const Status stages[] = {validate(options.joiner),       validate(options.lpm),
                           validate(options.localisation), validate(options.relocalisation),
                           validate(options.place),        validate(options.recognition),
                           validate(options.recall),       validate(options.topology),
                           validate(options.layout),       validate(options.refinement),
                           validate(options.global_map),   validate(options.path)};
  for (const Status& stage : stages) {
    if (!stage) {
      complaints += (complaints.empty() ? "" : "; ") + stage.error().message;
    }
  }
  if (const Result<std::vector<EvidenceName>> names = evidence_named(options.evidence); !names) {
    complaints += (complaints.empty() ? "" : "; ") + names.error().message;
  }
  if (complaints.empty()) {
    return {};
  }
  return Error{ErrorCode::kInvalidValue, complaints};
}

}  // namespace cairn
