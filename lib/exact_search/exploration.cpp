#include "exact_search/exploration.hpp"

#include <string>

namespace cairn {
namespace {

Error out_of_range(std::size_t step, const std::string& field, int value, int count) {
  const std::string where = step == 0 ? "start" : "step " + std::to_string(step - 1);
  return {ErrorCode::kInvalidValue, "exploration, " + where + ": " + field + " must be in [0, " +
                                        std::to_string(count - 1) + "], is " +
                                        std::to_string(value)};
}

/// @param step 0 for the start, else one more than the step's number
Status validate_view(std::size_t step, const Star& star, int gateway, const std::string& field) {
  if (const Status status = validate(star); !status) {
    const std::string where = step == 0 ? "start" : "step " + std::to_string(step - 1);
    return Error{status.error().code, "exploration, " + where + ": " + status.error().message};
  }
  const int gateways = gateway_count(star);
  if (gateway < 0 || gateway >= gateways) {
    return out_of_range(step, field, gateway, gateways);
  }
  return {};
}

}  // namespace

Status validate(const Exploration& exploration) {
  if (Status status =
          validate_view(0, exploration.start, exploration.start_gateway, "start_gateway");
      !status) {
    return status;
  }
  int gateways = gateway_count(exploration.start);
  std::size_t number = 0;
  for (const ExplorationStep& step : exploration.steps) {
    ++number;
    if (step.turn < 0 || step.turn >= gateways) {
      return out_of_range(number, "turn", step.turn, gateways);
    }
    if (Status status = validate_view(number, step.star, step.arrival_gateway, "arrival_gateway");
        !status) {
      return status;
    }
    gateways = gateway_count(step.star);
  }
  return {};
}

}  // namespace cairn
