#include "lpm/particle_matcher.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include "base/check.hpp"
#include "lpm/match_score.hpp"
#include "lpm/surface_points.hpp"

namespace cairn {
namespace {

constexpr double kOnWallInSigmas = 2.5;
constexpr double kLossScaleInSigmas = 2.0;  // of Cauchy's loss: people are in no map
constexpr double kPoorScore = 0.80;         // a match that casts doubt on odometry
constexpr double kDoubt = 25.0;             // then its covariance counts as so much larger
constexpr double kClearlyBetter = 0.10;     // in score
constexpr double kKernel = 0.4;             // share of the spread that a resampled particle takes
constexpr double kLeastTemper = 1e-3;       // first step, of 1 in all
constexpr double kLeastGrowth = 0.25;       // of the temper, per step
constexpr double kLeastSigma_m = 1e-4;      // of particles: keeps their covariance regular
constexpr double kLeastSigma_rad = 1e-4;
constexpr double kLearnt = 0.25;  // share of the prior information that is no chance of sampling

using Vector3d = Eigen::Vector3d;

Pose2 moved(const Pose2& around, const Vector3d& deviation) {
  return {around.x() + deviation.x(), around.y() + deviation.y(), around.theta() + deviation.z()};
}

Matrix3d root_of(const Matrix3d& covariance) {
  const Eigen::SelfAdjointEigenSolver<Matrix3d> solver(covariance);
  const Vector3d roots = solver.eigenvalues().cwiseMax(0.0).cwiseSqrt();
  return solver.eigenvectors() * roots.asDiagonal();
}

/// What the returns have added to the information of the prior, without what may be chance.
Matrix3d information_gained(const Matrix3d& prior, const Matrix3d& posterior) {
  // In coordinates in which the prior is the identity.
  const Matrix3d root = root_of(prior);
  const Matrix3d inverse_root = root.inverse();
  const Matrix3d seen = inverse_root * posterior * inverse_root.transpose();
  const Eigen::SelfAdjointEigenSolver<Matrix3d> solver(0.5 * (seen + seen.transpose()));
  Vector3d gained = solver.eigenvalues().cwiseMax(1e-9).cwiseInverse() - Vector3d::Ones();
  gained = (gained.array() < kLearnt).select(0.0, gained);
  const Matrix3d back = inverse_root.transpose() * solver.eigenvectors();
  const Matrix3d information = back * gained.asDiagonal() * back.transpose();
  return 0.5 * (information + information.transpose());
}

}  // namespace

ParticleMatcher::ParticleMatcher(const ScanMatchOptions& options, const ParticleOptions& particles)
    : options_(options),
      particles_(particles),
      random_(static_cast<std::uint64_t>(particles.seed)) {
  CAIRN_CHECK(validate(particles).ok());
}

void ParticleMatcher::take(const ScanBeams& beams) {
  ++scans_;
  matches_ = 0;
  best_score_ = -1.0;
  left_open_ = std::move(next_left_open_);
  next_left_open_.clear();
  surface_points_of(beams, options_.point_spacing_m, options_.max_match_range_m, &returns_);
  few_returns_ = some_of(returns_, static_cast<std::size_t>(particles_.max_returns));
  weight_ = few_returns_.empty()
                ? 0.0
                : options_.independent_share * static_cast<double>(returns_.size()) /
                      static_cast<double>(few_returns_.size());
}

bool ParticleMatcher::is_blocked() const {
  return returns_.size() < static_cast<std::size_t>(options_.min_returns);
}

ScanMatch ParticleMatcher::match(const ScrollingMap& map, const GaussianPose& predicted) {
  const SplitRandom random = random_.split(scans_).split(++matches_);
  std::vector<Vector3d> left_open;
  ScanMatch match = filtered(map, predicted, random.split(1), &left_open);
  if (match.score < kPoorScore) {
    // Odometry may be plain wrong: a slip, a push. That takes a clearly better fit.
    std::vector<Vector3d> doubted_open;
    const GaussianPose doubted{predicted.mean, kDoubt * predicted.covariance};
    const ScanMatch wider = filtered(map, doubted, random.split(2), &doubted_open);
    if (wider.score > match.score + kClearlyBetter) {
      match = wider;
      left_open = std::move(doubted_open);
    }
    match.was_searched = true;
  }
  match.usual_score = usual_score_.value();
  if (match.score > best_score_) {
    best_score_ = match.score;
    next_left_open_ = std::move(left_open);
  }
  usual_score_.learn(match.score);
  return match;
}

std::size_t ParticleMatcher::memory_bytes() const {
  return (left_open_.capacity() + next_left_open_.capacity()) * sizeof(Vector3d);
}

ScanMatch ParticleMatcher::filtered(const ScrollingMap& map,
                                    const GaussianPose& predicted,
                                    SplitRandom random,
                                    std::vector<Vector3d>* left_open) {
  Belief belief{drawn(predicted.covariance, &random), {}};
  first_count_ = static_cast<int>(belief.particles.size());
  const Moments prior = moments_of(belief.particles);
  for (double temper = 0.0; temper < 1.0;) {
    weigh(map.walls(), predicted.mean, &belief);
    const double next = next_temper(belief, temper);
    resample(next - temper, &random, &belief);
    temper = next;
  }
  const Moments posterior = moments_of(belief.particles);
  ScanMatch match;
  match.fit.T_lpm_robot = moved(predicted.mean, posterior.mean);
  match.fit.information = information_gained(prior.covariance, posterior.covariance);
  match.fit.spread_m = options_.hit_sigma_m;
  match.fit.cost = 0.5 * posterior.mean.dot(prior.covariance.inverse() * posterior.mean) -
                   log_likelihood(map.walls(), match.fit.T_lpm_robot);
  judge(map, returns_, kOnWallInSigmas * options_.hit_sigma_m, &match);
  *left_open = std::move(belief.particles);
  // Along an endless corridor the belief would grow without bounds.
  const double spread_m = std::sqrt(posterior.covariance.topLeftCorner<2, 2>().trace());
  const double share = std::min(1.0, options_.search_range_m / spread_m);
  for (Vector3d& deviation : *left_open) {
    deviation = Vector3d(share, share, 1.0).cwiseProduct(deviation - posterior.mean);
  }
  return match;
}

std::size_t ParticleMatcher::enough(std::size_t bins) const {
  const auto least = static_cast<std::size_t>(particles_.least_count);
  const auto greatest = std::max(least, static_cast<std::size_t>(particles_.greatest_count));
  if (bins < 2) {
    return least;
  }
  const double k = static_cast<double>(bins - 1);
  const double a = 2.0 / (9.0 * k);  // Fox 2001, (7): Wilson and Hilferty's chi-square quantile
  const double root = 1.0 - a + std::sqrt(a) * particles_.kld_quantile;
  const double count = k / (2.0 * particles_.kld_error) * root * root * root;
  return std::clamp(static_cast<std::size_t>(std::max(count, 0.0)), least, greatest);
}

ParticleMatcher::Bin ParticleMatcher::bin_of(const Vector3d& deviation) const {
  const auto cell = [](double value, double size) {
    return static_cast<int>(std::floor(std::clamp(value / size, -1e8, 1e8)));
  };
  return {cell(deviation.x(), particles_.bin_m), cell(deviation.y(), particles_.bin_m),
          cell(deviation.z(), particles_.bin_rad)};
}

std::vector<Vector3d> ParticleMatcher::drawn(const Matrix3d& covariance,
                                             SplitRandom* random) const {
  const Matrix3d root = root_of(covariance);
  std::vector<Vector3d> particles;
  std::set<Bin> bins;
  const auto add = [&](const Vector3d& p) {
    particles.push_back(p);
    bins.insert(bin_of(p));
  };
  while (particles.size() < enough(bins.size())) {
    Vector3d deviation = root * Vector3d(random->normal(), random->normal(), random->normal());
    if (!left_open_.empty()) {
      const double pick = random->uniform() * static_cast<double>(left_open_.size());
      deviation += left_open_[static_cast<std::size_t>(pick)];
    }
    // In pairs, so that the mean stays where it was predicted while returns say nothing.
    add(deviation);
    add(-deviation);
  }
  return particles;
}

double ParticleMatcher::log_likelihood(const DistanceField& walls, const Pose2& pose) const {
  const double scale_m = kLossScaleInSigmas * options_.hit_sigma_m;
  const double factor = -0.5 * weight_ * kLossScaleInSigmas * kLossScaleInSigmas;
  const double c = std::cos(pose.theta());
  const double s = std::sin(pose.theta());
  // log(1 + a) + log(1 + b) = log((1 + a) (1 + b)): a logarithm for many returns.
  double sum = 0.0;
  double product = 1.0;
  for (const auto& [p, normal] : few_returns_) {
    const Vector2d at(pose.x() + c * p.x() - s * p.y(), pose.y() + s * p.x() + c * p.y());
    const double share = walls.sample(at).distance_m / scale_m;
    product *= 1.0 + share * share;
    if (product > 1e100) {
      sum += std::log(product);
      product = 1.0;
    }
  }
  return factor * (sum + std::log(product));
}

void ParticleMatcher::weigh(const DistanceField& walls, const Pose2& around, Belief* belief) const {
  belief->log_likelihoods.clear();
  for (const Vector3d& deviation : belief->particles) {
    belief->log_likelihoods.push_back(log_likelihood(walls, moved(around, deviation)));
  }
}

double ParticleMatcher::next_temper(const Belief& belief, double temper) const {
  const std::vector<double>& logs = belief.log_likelihoods;
  const double top = *std::max_element(logs.begin(), logs.end());
  const auto effective_share = [&](double step) {
    double sum = 0.0;
    double squares = 0.0;
    for (const double value : logs) {
      const double weight = std::exp(step * (value - top));
      sum += weight;
      squares += weight * weight;
    }
    return sum * sum / (squares * static_cast<double>(logs.size()));
  };
  double high = 1.0 - temper;
  if (effective_share(high) >= particles_.effective_share) {
    return 1.0;
  }
  double low = 0.0;
  for (int i = 0; i < 20; ++i) {
    const double middle = 0.5 * (low + high);
    (effective_share(middle) >= particles_.effective_share ? low : high) = middle;
  }
  return std::min(1.0, temper + std::max({low, kLeastTemper, kLeastGrowth * temper}));
}

void ParticleMatcher::resample(double temper_step, SplitRandom* random, Belief* belief) const {
  const std::vector<Vector3d>& old = belief->particles;
  const std::vector<double>& logs = belief->log_likelihoods;
  const double top = *std::max_element(logs.begin(), logs.end());
  std::vector<double> weights;
  double sum = 0.0;
  Vector3d mean = Vector3d::Zero();
  Matrix3d squares = Matrix3d::Zero();
  std::set<Bin> bins;
  for (std::size_t i = 0; i < old.size(); ++i) {
    weights.push_back(std::exp(temper_step * (logs[i] - top)));
    sum += weights[i];
    mean += weights[i] * old[i];
    squares += weights[i] * old[i] * old[i].transpose();
    bins.insert(bin_of(old[i]));
  }
  mean /= sum;
  const Matrix3d kernel = kKernel * root_of(squares / sum - mean * mean.transpose());
  const double keep = std::sqrt(1.0 - kKernel * kKernel);
  const std::size_t count = enough(bins.size());
  const double step = sum / static_cast<double>(count);
  double at = random->uniform() * step;
  double passed = weights[0];
  std::vector<Vector3d> next;
  Vector3d noise = Vector3d::Zero();
  for (std::size_t n = 0, i = 0; n < count; ++n, at += step) {
    while (passed < at && i + 1 < old.size()) {
      passed += weights[++i];
    }
    const Vector3d normal(random->normal(), random->normal(), random->normal());
    noise = n % 2 == 0 ? Vector3d(kernel * normal) : Vector3d(-noise);
    next.emplace_back(mean + keep * (old[i] - mean) + noise);
  }
  belief->particles = std::move(next);
}

ParticleMatcher::Moments ParticleMatcher::moments_of(const std::vector<Vector3d>& particles) {
  Moments moments;
  const double count = static_cast<double>(particles.size());
  for (const Vector3d& p : particles) {
    moments.mean += p / count;
  }
  for (const Vector3d& p : particles) {
    moments.covariance += (p - moments.mean) * (p - moments.mean).transpose() / count;
  }
  moments.covariance.diagonal() +=
      Vector3d(kLeastSigma_m, kLeastSigma_m, kLeastSigma_rad).cwiseAbs2();
  return moments;
}

}  // namespace cairn
