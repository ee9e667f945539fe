#pragma once

#include <vector>

#include <Eigen/Core>

namespace cairn::lab {

/// What is known of one pair: numbers, and whether it is one of the same.
struct Example {
  Eigen::VectorXd features;
  bool is_same = false;
};

/// Weights of a log-likelihood ratio that is linear in the features, by logistic regression with
/// both kinds weighing as much as each other, so that no prior is in it. A little ridge keeps the
/// weights finite where the examples can be told apart without error.
/// @pre examples of both kinds, all with as many features
[[nodiscard]] Eigen::VectorXd fitted_weights(const std::vector<Example>& examples);

/// A log-likelihood ratio, and which kind of pair it was said of.
struct Judgement {
  double log_likelihood_ratio = 0.0;
  bool is_same = false;
};

/// Pairs whose predicted probability falls into a bin, and how often they were the same, as it were
/// if both kinds were as frequent.
struct ReliabilityBin {
  double low = 0.0;   ///< Log-likelihood ratios from here on,
  double high = 0.0;  ///< to below this one.
  int same = 0;
  int different = 0;
  double predicted = 0.0;  ///< Mean probability of being the same.
  double actual = 0.0;
};

[[nodiscard]] std::vector<ReliabilityBin> reliability(const std::vector<Judgement>& judgements);

/// Mean of -ln(probability of the truth) in nats, both kinds weighing as much: ln 2 for one who
/// says nothing.
[[nodiscard]] double log_loss(const std::vector<Judgement>& judgements);

/// What accepting from a threshold on gets wrong.
struct ErrorRates {
  double threshold = 0.0;
  double false_matches = 0.0;   ///< Share of the different ones that are accepted.
  double missed_matches = 0.0;  ///< Share of the same ones that are not.
};

[[nodiscard]] ErrorRates error_rates(const std::vector<Judgement>& judgements, double threshold);

}  // namespace cairn::lab
