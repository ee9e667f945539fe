#include "topology/topology_options.hpp"

#include "base/validator.hpp"

namespace cairn {

Status validate(const TopologyOptions& options) {
  constexpr double kMostHypotheses = 10'000'000;
  return Validator("topology")
      .require("max_places", options.max_places.value_or(1) >= 1, "be at least 1")
      .within("max_hypotheses", options.max_hypotheses, 1, kMostHypotheses)
      .within("max_broken_hypotheses", options.max_broken_hypotheses, 1, kMostHypotheses)
      .within("log_prior_new_place", options.log_prior_new_place, -1000.0, 0.0)
      .within("log_penalty_handle", options.log_penalty_handle, 0.0, 10'000.0)
      .within("log_penalty_missed_gateway", options.log_penalty_missed_gateway, 0.0, 10'000.0)
      .within("log_penalty_false_gateway", options.log_penalty_false_gateway, 0.0, 10'000.0)
      .within("log_penalty_unnoticed", options.log_penalty_unnoticed, 0.0, 10'000.0)
      .within("log_penalty_junction", options.log_penalty_junction, 0.0, 10'000.0)
      .within("log_penalty_break", options.log_penalty_break, 0.0, 10'000.0)
      .within("log_penalty_misread", options.log_penalty_misread, 0.0, 10'000.0)
      .within("blame_margin", options.blame_margin, 0.0, 10'000.0)
      .within("recognition_threshold", options.recognition_threshold, 0.0, 10'000.0)
      .within("max_log_evidence", options.max_log_evidence, 0.0, 1000.0)
      .within("max_visits_compared", options.max_visits_compared, 1, 1000)
      .within("evidence_correlation", options.evidence_correlation, 0.0, 1.0)
      .within("max_bytes", static_cast<double>(options.max_bytes), 65'536.0, 1e12)
      .within("max_revivals", options.max_revivals, 0, kMostHypotheses)
      .within("max_repair_steps", options.max_repair_steps, 0, kMostHypotheses)
      .within("live_margin", options.live_margin, 0.0, 1e6)
      .within("log_loss_waiting", options.log_loss_waiting, 0.0, 100.0)
      .within("max_alike", options.max_alike, 1, kMostHypotheses)
      .within("claim_odds", options.claim_odds, 1.0, 1e12)
      .within("layout_margin", options.layout_margin, 0.0, 1e6)
      .status();
}

double most_independent_answers(const TopologyOptions& options) {
  return independent_answers(options.max_visits_compared, options.evidence_correlation);
}

double independent_answers(int answers, double correlation) {
  return answers / (1.0 + (answers - 1) * correlation);
}

}  // namespace cairn
