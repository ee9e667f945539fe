#include "topology/experience.hpp"

#include <string>

#include "base/check.hpp"

namespace cairn {
namespace {

Error invalid(const std::string& what) {
  return Error{ErrorCode::kInvalidValue, "view: " + what};
}

Status validate_first_reading(const View& view) {
  if (Status status = validate_read_star(view.star); !status) {
    return invalid(status.error().message);
  }
  const int gateways = gateway_count(view.star);
  if (view.arrival_gateway < 0 || view.arrival_gateway >= gateways) {
    return invalid("arrival_gateway must be in [0, " + std::to_string(gateways - 1) + "], is " +
                   std::to_string(view.arrival_gateway));
  }
  if (Status status = validate_log_likelihood(view.log_likelihood); !status) {
    return invalid(status.error().message);
  }
  return {};
}

const Reading& other_reading(const View& view, int reading) {
  CAIRN_CHECK(reading >= 1 && reading < reading_count(view));
  return view.others[static_cast<std::size_t>(reading - 1)];
}

}  // namespace

Status validate(const View& view) {
  if (Status status = validate_first_reading(view); !status) {
    return status;
  }
  if (!view.visit.is_valid()) {
    return invalid("must have a visit");
  }
  if (view.others.size() + 1 > kMostReadings) {
    return invalid("must have at most " + std::to_string(kMostReadings) + " readings, has " +
                   std::to_string(view.others.size() + 1));
  }
  const int gateways = gateway_count(view.star);
  for (std::size_t index = 0; index < view.others.size(); ++index) {
    if (Status status = validate(view.others[index], gateways, view.arrival_gateway); !status) {
      return invalid("others[" + std::to_string(index) + "]: " + status.error().message);
    }
  }
  return {};
}

int reading_count(const View& view) {
  return static_cast<int>(view.others.size()) + 1;
}

const Star& star_of(const View& view, int reading) {
  return reading == 0 ? view.star : other_reading(view, reading).star;
}

bool is_recalled(const View& view, int reading) {
  return reading > 0 && other_reading(view, reading).is_recalled;
}

int gateway_of_first(const View& view, int reading, int gateway) {
  return reading == 0 ? gateway
                      : other_reading(view, reading).gateways[static_cast<std::size_t>(gateway)];
}

int arrival_gateway_of(const View& view, int reading) {
  if (reading == 0) {
    return view.arrival_gateway;
  }
  const std::optional<int> arrival = gateway_in(other_reading(view, reading), view.arrival_gateway);
  CAIRN_CHECK(arrival.has_value());
  return *arrival;
}

double log_likelihood_of(const View& view, int reading) {
  return reading == 0 ? view.log_likelihood : other_reading(view, reading).log_likelihood;
}

}  // namespace cairn
