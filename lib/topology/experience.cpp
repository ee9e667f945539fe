#include "topology/experience.hpp"

#include <string>

namespace cairn {

Status validate(const View& view) {
  if (Status status = validate(view.star); !status) {
    return status;
  }
  const int gateways = gateway_count(view.star);
  if (view.arrival_gateway < 0 || view.arrival_gateway >= gateways) {
    return Error{ErrorCode::kInvalidValue, "view: arrival_gateway must be in [0, " +
                                               std::to_string(gateways - 1) + "], is " +
                                               std::to_string(view.arrival_gateway)};
  }
  if (!view.visit.is_valid()) {
    return Error{ErrorCode::kInvalidValue, "view: must have a visit"};
  }
  return {};
}

}  // namespace cairn
