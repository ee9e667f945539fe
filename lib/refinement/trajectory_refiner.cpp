#include "refinement/trajectory_refiner.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Geometry>

#include "base/check.hpp"
#include "base/validator.hpp"
#include "layout/place_layout.hpp"
#include "layout/trajectory.hpp"

namespace cairn {
namespace {

constexpr int kReweightings = 4;
constexpr double kLeastWeight = 1e-6;
constexpr double kLetGo = 0.1;            // A match that weighs less hardly counts.
constexpr double kStillVariance = 1e-10;  // keeps the motion of a robot that stands regular

/// What holds key scans together.
struct Links {
  std::vector<TravelConstraint> motions;  // from each key scan to the next
  std::vector<TravelConstraint> loose;    // what may be wrong: places and matches
};

std::vector<TravelConstraint> motions_of(const KeyScans& keys) {
  std::vector<TravelConstraint> motions;
  for (std::size_t i = 1; i < keys.size(); ++i) {
    TravelConstraint motion{static_cast<int>(i) - 1, static_cast<int>(i), keys[i]->T_before_this};
    motion.T_from_to.covariance.diagonal().array() += kStillVariance;
    motions.push_back(motion);
  }
  return motions;
}

/// The last key scan that is not after a scan.
std::size_t key_before(const KeyScans& keys, std::size_t scan) {
  const auto after =
      std::upper_bound(keys.begin(), keys.end(), scan,
                       [](std::size_t number, const auto& key) { return number < key->number; });
  return static_cast<std::size_t>(after - keys.begin()) - 1;
}

/// What the layout says of two scans, as between the key scans before them.
TravelConstraint between_keys(const SamePlace& same,
                              const KeyScans& keys,
                              const std::vector<Pose2>& T_global_robot) {
  const std::size_t from = key_before(keys, same.scan);
  const std::size_t to = key_before(keys, same.other_scan);
  const auto from_key = [&](std::size_t key, std::size_t scan) {
    return GaussianPose{T_global_robot[keys[key]->number].inverse() * T_global_robot[scan],
                        Matrix3d::Zero()};
  };
  return {static_cast<int>(from), static_cast<int>(to),
          compounded(compounded(from_key(from, same.scan), same.T_scan_other),
                     inverted(from_key(to, same.other_scan)))};
}

/// Key scans as the links have them; those that contradict the others give way.
Result<PlaceLayout> settle(const Links& links,
                           double tolerance,
                           std::vector<Pose2>* T_global_key,
                           std::vector<double>* weights) {
  PlaceLayout start;
  const Pose2 T_global_first = T_global_key->front();
  weights->assign(links.loose.size(), 1.0);
  Result<PlaceLayout> layout = start;
  for (int i = 0; i < kReweightings; ++i) {
    std::vector<TravelConstraint> all = links.motions;
    for (std::size_t k = 0; k < links.loose.size(); ++k) {
      all.push_back(links.loose[k]);
      all.back().T_from_to.covariance /= (*weights)[k];
    }
    start.T_global_place.clear();
    for (const Pose2& pose : *T_global_key) {
      start.T_global_place.push_back(T_global_first.inverse() * pose);
    }
    LayoutOptions options;
    options.covariances = i + 1 == kReweightings;
    layout = solve_layout(static_cast<int>(T_global_key->size()), all, options, &start);
    if (!layout) {
      return layout;
    }
    for (std::size_t k = 0; k < T_global_key->size(); ++k) {
      (*T_global_key)[k] = T_global_first * layout->T_global_place[k];
    }
    for (std::size_t k = 0; k < weights->size(); ++k) {
      const double chi2 = layout->chi2_of_travel[links.motions.size() + k] / (*weights)[k];
      const double share = tolerance / (tolerance + chi2);
      (*weights)[k] = std::max(kLeastWeight, share * share);
    }
  }
  return layout;
}

/// Covariances in a frame that is turned by so much, as seen from outside.
std::vector<Matrix3d> turned(const std::vector<Matrix3d>& covariances, double angle_rad) {
  Matrix3d turn = Matrix3d::Identity();
  turn.topLeftCorner<2, 2>() = Eigen::Rotation2Dd(angle_rad).toRotationMatrix();
  std::vector<Matrix3d> seen;
  for (const Matrix3d& covariance : covariances) {
    const Matrix3d product = turn * covariance * turn.transpose();
    seen.push_back(0.5 * (product + product.transpose()));
  }
  return seen;
}

/// All scans, bent between the key scans.
std::vector<Pose2> spread(const std::vector<Pose2>& T_global_robot,
                          const KeyScans& keys,
                          const std::vector<Pose2>& T_global_key) {
  std::vector<Pose2> poses;
  poses.reserve(T_global_robot.size());
  const auto at = [&](std::size_t scan) {
    return T_global_robot.begin() + static_cast<std::ptrdiff_t>(scan);
  };
  for (std::size_t k = 0; k + 1 < keys.size(); ++k) {
    const std::vector<Pose2> bent = interpolate_travel(
        {at(keys[k]->number), at(keys[k + 1]->number) + 1}, T_global_key[k], T_global_key[k + 1]);
    poses.insert(poses.end(), bent.begin(), bent.end() - 1);
  }
  const std::size_t last = keys.back()->number;
  const Pose2 T_new_old = T_global_key.back() * T_global_robot[last].inverse();
  for (std::size_t i = last; i < T_global_robot.size(); ++i) {
    poses.push_back(T_new_old * T_global_robot[i]);
  }
  return poses;
}

}  // namespace

Status validate(const TrajectoryRefinementOptions& options) {
  if (Status status = validate(options.matching); !status) {
    return status;
  }
  return Validator("refinement")
      .within("rounds", options.rounds, 1, 10)
      .within("tolerance", options.tolerance, 1e-3, 1000.0)
      .status();
}

TrajectoryRefiner::TrajectoryRefiner(const TrajectoryRefinementOptions& options)
    : options_(options), matcher_(options.matching) {
  CAIRN_CHECK(validate(options).ok());
}

Result<RefinedTrajectory> TrajectoryRefiner::refine(const std::vector<Pose2>& T_global_robot,
                                                    const KeyScans& keys,
                                                    const std::vector<SamePlace>& same_places) {
  RefinedTrajectory refined;
  refined.T_global_robot = T_global_robot;
  if (!options_.enabled || keys.size() < 2) {
    return refined;
  }
  CAIRN_CHECK(keys.back()->number < T_global_robot.size());
  std::vector<Pose2> T_global_key;
  for (const auto& key : keys) {
    T_global_key.push_back(T_global_robot[key->number]);
  }
  Links places{motions_of(keys), {}};
  for (const SamePlace& same : same_places) {
    const TravelConstraint link = between_keys(same, keys, T_global_robot);
    if (link.from != link.to && is_positive_definite(link.T_from_to.covariance)) {
      places.loose.push_back(link);
    }
  }
  std::vector<double> weights;
  for (int round = 0; round < options_.rounds; ++round) {
    Links links = places;
    for (const PatchMatch& match : matcher_.match(keys, T_global_key)) {
      links.loose.push_back({match.patch, match.key, match.T_patch_key});
    }
    refined.matches = static_cast<int>(links.loose.size() - places.loose.size());
    const Result<PlaceLayout> layout = settle(links, options_.tolerance, &T_global_key, &weights);
    if (!layout) {
      return layout.error();
    }
    refined.chi2 = layout->chi2;
    refined.key_covariances = turned(layout->covariances, T_global_robot.front().theta());
  }
  matcher_.forget_unused();
  const auto first_match = weights.end() - refined.matches;
  refined.let_go = static_cast<int>(
      std::count_if(first_match, weights.end(), [](double weight) { return weight < kLetGo; }));
  refined.T_global_robot = spread(T_global_robot, keys, T_global_key);
  return refined;
}

}  // namespace cairn
