#include "layout/exclusion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace cairn {
namespace {

/// Beyond so many times the distance of exclusion, places are apart for sure enough.
constexpr double kFarOff = 3.0;
constexpr double kLeastVariance_m2 = 1e-6;

double normal_cdf(double z) {
  return 0.5 * std::erfc(-z / std::sqrt(2.0));
}

/// The ways from place to place along the travels.
class Ways {
 public:
  Ways(const std::vector<Pose2>& T_global_place, const std::vector<TravelConstraint>& travels)
      : T_global_place_(T_global_place), steps_(T_global_place.size()) {
    for (const TravelConstraint& travel : travels) {
      steps_[index(travel.from)].push_back({index(travel.to), travel.T_from_to});
      steps_[index(travel.to)].push_back({index(travel.from), inverted(travel.T_from_to)});
    }
  }

  /// Of every place in the frame of `start`, as the layout has it, by the surest way (Dijkstra).
  [[nodiscard]] std::vector<Matrix3d> covariances_from(std::size_t start) const {
    constexpr double kUnreached = std::numeric_limits<double>::infinity();
    std::vector<Matrix3d> covariances(steps_.size(), Matrix3d::Zero());
    std::vector<double> variances_m2(steps_.size(), kUnreached);
    std::vector<bool> is_done(steps_.size(), false);
    variances_m2[start] = 0.0;
    while (true) {
      std::size_t at = steps_.size();
      for (std::size_t i = 0; i < steps_.size(); ++i) {
        if (!is_done[i] && variances_m2[i] < kUnreached &&
            (at == steps_.size() || variances_m2[i] < variances_m2[at])) {
          at = i;
        }
      }
      if (at == steps_.size()) {
        return covariances;
      }
      is_done[at] = true;
      const GaussianPose T_start_at{T_between(start, at), covariances[at]};
      for (const Step& step : steps_[at]) {
        const Matrix3d reached = compounded(T_start_at, step.T_here_there).covariance;
        const double variance_m2 = reached(0, 0) + reached(1, 1);
        if (variance_m2 < variances_m2[step.there]) {
          variances_m2[step.there] = variance_m2;
          covariances[step.there] = reached;
        }
      }
    }
  }

  [[nodiscard]] Pose2 T_between(std::size_t a, std::size_t b) const {
    return T_global_place_[a].inverse() * T_global_place_[b];
  }

 private:
  struct Step {
    std::size_t there = 0;
    GaussianPose T_here_there;
  };
  static std::size_t index(int place) { return static_cast<std::size_t>(place); }

  const std::vector<Pose2>& T_global_place_;
  std::vector<std::vector<Step>> steps_;
};

using Pair = std::pair<std::size_t, std::size_t>;

/// The pairs of places that lie no farther from each other, each with its lower number first, in
/// the order of these numbers.
std::vector<Pair> pairs_within(double distance_m, const std::vector<Pose2>& T_global_place) {
  std::vector<std::size_t> eastwards(T_global_place.size());
  std::iota(eastwards.begin(), eastwards.end(), std::size_t{0});
  std::stable_sort(eastwards.begin(), eastwards.end(), [&](std::size_t a, std::size_t b) {
    return T_global_place[a].x() < T_global_place[b].x();
  });
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < eastwards.size(); ++i) {
    const Pose2& here = T_global_place[eastwards[i]];
    for (std::size_t j = i + 1; j < eastwards.size(); ++j) {
      const Pose2& there = T_global_place[eastwards[j]];
      if (there.x() - here.x() > distance_m) {
        break;
      }
      if ((there.translation() - here.translation()).norm() <= distance_m) {
        pairs.emplace_back(std::min(eastwards[i], eastwards[j]),
                           std::max(eastwards[i], eastwards[j]));
      }
    }
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

/// That something at p, which is uncertain, is within a square of this half side around the origin,
/// turned towards p.
double probability_near(const Vector2d& p, const Matrix3d& covariance, double within_m) {
  const double distance_m = p.norm();
  const Vector2d along = distance_m > 0.0 ? Vector2d(p / distance_m) : Vector2d(1.0, 0.0);
  const Vector2d across(-along.y(), along.x());
  const auto sigma_m = [&](const Vector2d& way) {
    return std::sqrt(std::max(kLeastVariance_m2, way.dot(covariance.topLeftCorner<2, 2>() * way)));
  };
  const auto share = [within_m](double mean_m, double sigma) {
    return normal_cdf((within_m - mean_m) / sigma) - normal_cdf((-within_m - mean_m) / sigma);
  };
  return share(distance_m, sigma_m(along)) * share(0.0, sigma_m(across));
}

}  // namespace

double log_exclusion(const std::vector<Pose2>& T_global_place,
                     const std::vector<TravelConstraint>& travels,
                     const Exclusion& exclusion) {
  const std::vector<Pair> near = pairs_within(kFarOff * exclusion.apart_m, T_global_place);
  if (near.empty()) {
    return 0.0;
  }
  const Ways ways(T_global_place, travels);
  double sum = 0.0;
  std::size_t from = T_global_place.size();
  std::vector<Matrix3d> covariances;
  for (const auto& [a, b] : near) {
    if (a != from) {
      from = a;
      covariances = ways.covariances_from(a);
    }
    const double together =
        probability_near(ways.T_between(a, b).translation(), covariances[b], exclusion.apart_m);
    sum +=
        together < 1.0 ? std::max(exclusion.log_least, std::log1p(-together)) : exclusion.log_least;
  }
  return sum;
}

}  // namespace cairn
