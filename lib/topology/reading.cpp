#include "topology/reading.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>

namespace cairn {
namespace {

Error invalid(const std::string& what) {
  return Error{ErrorCode::kInvalidValue, what};
}

/// Whether no gateway is named twice and all in clockwise order: then one round of the reading is
/// one round of the first reading, not more.
bool is_clockwise(const std::vector<int>& gateways, int first_gateway_count) {
  std::vector<int> known;
  std::copy_if(gateways.begin(), gateways.end(), std::back_inserter(known),
               [](int gateway) { return gateway >= 0; });
  if (known.size() < 2) {
    return true;
  }
  int turned = 0;
  int previous = known.back();
  for (const int gateway : known) {
    const int step = (gateway - previous + first_gateway_count) % first_gateway_count;
    turned += step == 0 ? first_gateway_count : step;
    previous = gateway;
  }
  return turned == first_gateway_count;
}

Status validate_gateways(const Reading& reading, int first_gateway_count) {
  for (std::size_t index = 0; index < reading.gateways.size(); ++index) {
    const int gateway = reading.gateways[index];
    if (gateway < -1 || gateway >= first_gateway_count) {
      return invalid("gateways[" + std::to_string(index) + "] must be in [-1, " +
                     std::to_string(first_gateway_count - 1) + "], is " + std::to_string(gateway));
    }
  }
  if (!is_clockwise(reading.gateways, first_gateway_count)) {
    std::string found;
    for (const int gateway : reading.gateways) {
      found += " " + std::to_string(gateway);
    }
    return invalid("gateways must name each gateway at most once and clockwise, are" + found);
  }
  return {};
}

}  // namespace

std::optional<int> gateway_in(const Reading& reading, int gateway_of_first) {
  const auto found = std::find(reading.gateways.begin(), reading.gateways.end(), gateway_of_first);
  if (gateway_of_first < 0 || found == reading.gateways.end()) {
    return std::nullopt;
  }
  return static_cast<int>(found - reading.gateways.begin());
}

Status validate(const Reading& reading, int first_gateway_count, int arrival_gateway) {
  if (Status status = validate_read_star(reading.star); !status) {
    return status;
  }
  const auto gateways = static_cast<std::size_t>(gateway_count(reading.star));
  if (reading.gateways.size() != gateways) {
    return invalid("gateways must have " + std::to_string(gateways) + " entries, has " +
                   std::to_string(reading.gateways.size()));
  }
  if (Status status = validate_gateways(reading, first_gateway_count); !status) {
    return status;
  }
  if (!gateway_in(reading, arrival_gateway)) {
    return invalid("gateways must name the arrival gateway " + std::to_string(arrival_gateway) +
                   ", which is missing");
  }
  return validate_log_likelihood(reading.log_likelihood);
}

Status validate_read_star(const Star& star) {
  constexpr std::size_t kMostSlots = 2 * static_cast<std::size_t>(kMostGateways);
  if (star.slots.size() > kMostSlots) {
    return invalid("star must have at most " + std::to_string(kMostSlots) + " slots, has " +
                   std::to_string(star.slots.size()));
  }
  if (Status status = validate(star); !status) {
    return status;
  }
  const int gateways = gateway_count(star);
  return gateways <= kMostGateways
             ? Status()
             : invalid("star must have at most " + std::to_string(kMostGateways) +
                       " gateways, has " + std::to_string(gateways));
}

Status validate_log_likelihood(double log_likelihood) {
  if (!std::isfinite(log_likelihood) || log_likelihood > 0.0) {
    return invalid("log_likelihood must be finite and at most 0, is " +
                   std::to_string(log_likelihood));
  }
  return {};
}

}  // namespace cairn
