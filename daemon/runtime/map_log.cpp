#include "runtime/map_log.hpp"

#include <string>
#include <variant>

#include <spdlog/spdlog.h>

namespace cairn {

void log_extensions(const MappingReport& report) {
  for (const ExtendReport& extension : report.extensions) {
    spdlog::info(
        "visit {}: {} hypotheses live, {} waiting ({} closures, {} new places, {} known links)",
        extension.visit.value, extension.leaves, extension.waiting,
        extension.count(StepKind::kClosure), extension.count(StepKind::kNewPlace),
        extension.count(StepKind::kKnownLink));
    if (extension.repair) {
      spdlog::warn("visit {}: no hypothesis explained it; blamed: {}", extension.visit.value,
                   to_text(extension.repair->blamed));
    }
    if (extension.guarantee_given_up) {
      spdlog::warn("visit {}: guarantee given up: {}", extension.visit.value,
                   extension.guarantee_given_up->reason);
    }
  }
}

void log_assertion(const MappingReport& report) {
  const auto* const assertion =
      report.answer ? std::get_if<cairn_lcm::assertion_report_t>(&*report.answer) : nullptr;
  if (assertion == nullptr || assertion->result.code != cairn_lcm::result_t::OK ||
      report.state == nullptr) {
    return;  // Refused, or carried out before.
  }
  const auto index = static_cast<std::size_t>(assertion->assertion) - 1;
  const OperatorAssertion& said = report.state->assertions.at(index).said;
  const std::string by =
      said.retracted_after_visits ? "taken back by " + said.retracted_by : "by " + said.who;
  spdlog::info("assertion {} {}: {}", said.number, by, assertion->sentence);
}

}  // namespace cairn
