#include "bench/lab/recognition_fit.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

namespace cairn::lab {
namespace {

double probability_of(double log_likelihood_ratio) {
  return 1.0 / (1.0 + std::exp(-log_likelihood_ratio));
}

/// Of one example of either kind, so that the two kinds weigh 1 each.
struct Weights {
  double same = 0.0;
  double different = 0.0;
};

template <typename Examples>
Weights weights_of(const Examples& examples) {
  const auto same = static_cast<double>(std::count_if(
      examples.begin(), examples.end(), [](const auto& example) { return example.is_same; }));
  return {1.0 / std::max(same, 1.0),
          1.0 / std::max(static_cast<double>(examples.size()) - same, 1.0)};
}

}  // namespace

Eigen::VectorXd fitted_weights(const std::vector<Example>& examples) {
  constexpr int kSteps = 50;
  constexpr double kRidge = 1e-5;
  const Eigen::Index count = examples.front().features.size();
  const Weights weights = weights_of(examples);
  Eigen::VectorXd fitted = Eigen::VectorXd::Zero(count);
  for (int step = 0; step < kSteps; ++step) {
    Eigen::MatrixXd hessian = kRidge * Eigen::MatrixXd::Identity(count, count);
    Eigen::VectorXd gradient = -kRidge * fitted;
    for (const Example& example : examples) {
      const double p = probability_of(fitted.dot(example.features));
      const double weight = example.is_same ? weights.same : weights.different;
      gradient += weight * ((example.is_same ? 1.0 : 0.0) - p) * example.features;
      hessian += weight * p * (1.0 - p) * example.features * example.features.transpose();
    }
    fitted += hessian.ldlt().solve(gradient);
  }
  return fitted;
}

std::vector<ReliabilityBin> reliability(const std::vector<Judgement>& judgements) {
  const Weights weights = weights_of(judgements);
  std::vector<ReliabilityBin> bins;
  for (const double low : {-100.0, -6.0, -4.0, -3.0, -2.0, -1.0, 0.0, 1.0, 2.0, 3.0, 4.0, 6.0}) {
    if (!bins.empty()) {
      bins.back().high = low;
    }
    bins.push_back({low, 100.0, 0, 0, 0.0, 0.0});
  }
  for (ReliabilityBin& bin : bins) {
    double same = 0.0;
    double all = 0.0;
    for (const auto& [ratio, is_same] : judgements) {
      if (ratio >= bin.low && ratio < bin.high) {
        const double weight = is_same ? weights.same : weights.different;
        (is_same ? bin.same : bin.different) += 1;
        same += is_same ? weight : 0.0;
        all += weight;
        bin.predicted += weight * probability_of(ratio);
      }
    }
    bin.predicted /= all > 0.0 ? all : 1.0;
    bin.actual = all > 0.0 ? same / all : 0.0;
  }
  return bins;
}

double log_loss(const std::vector<Judgement>& judgements) {
  const Weights weights = weights_of(judgements);
  double loss = 0.0;
  for (const auto& [ratio, is_same] : judgements) {
    loss += is_same ? 0.5 * weights.same * std::log1p(std::exp(-ratio))
                    : 0.5 * weights.different * std::log1p(std::exp(ratio));
  }
  return loss;
}

ErrorRates error_rates(const std::vector<Judgement>& judgements, double threshold) {
  const Weights weights = weights_of(judgements);
  ErrorRates rates{threshold, 0.0, 0.0};
  for (const auto& [ratio, is_same] : judgements) {
    rates.false_matches += !is_same && ratio >= threshold ? weights.different : 0.0;
    rates.missed_matches += is_same && ratio < threshold ? weights.same : 0.0;
  }
  return rates;
}

}  // namespace cairn::lab
