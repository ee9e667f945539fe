#pragma once

#include <string>

#include <cairn_lcm/status_t.hpp>

#include "lpm/localisation_health.hpp"

namespace cairn {

/// Fills in what the status says of the localisation.
void add_health(const LocalisationHealth& health,
                const LocalisationOptions& options,
                cairn_lcm::status_t* status);

/// State and reason in one line, as "lost: ..."; "tracking" while all is well.
[[nodiscard]] std::string health_text(const LocalisationHealth& health,
                                      const LocalisationOptions& options);

/// State, cause and fault as one code, as "degraded, fault, slip": for counting.
[[nodiscard]] std::string health_code(const LocalisationHealth& health);

/// Logs a change; nothing where both are alike.
void log_health(const LocalisationHealth& before,
                const LocalisationHealth& after,
                const LocalisationOptions& options);

}  // namespace cairn
