#include "refinement/patch_matcher.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/check.hpp"
#include "base/validator.hpp"
#include "lpm/match_score.hpp"
#include "lpm/scan_beams.hpp"
#include "lpm/surface_points.hpp"
#include "lpm/surface_refinement.hpp"
#include "refinement/passages.hpp"

namespace cairn {
namespace {

constexpr double kRaster_m = 0.05;  // of where matches begin: well within their reach
constexpr double kRaster_rad = 0.02;
constexpr double kStartSigma_m = 0.3;
constexpr double kStartSigma_rad = 0.08;
constexpr double kWindow_m = 24.0;  // of a patch
constexpr double kRange_m = 12.0;  // Farther returns tell more of their patch's heading than of it.
constexpr double kSpacing_m = 0.02;
constexpr double kOnWall_m = 0.125;
constexpr double kHitSigma_m = 0.05;
constexpr double kIndependentShare = 0.2;
constexpr double kLeastSigma_m = 0.005;  // no match is better than this
constexpr double kLeastSigma_rad = 0.001;
constexpr double kFarthest_m = 1e6;
/// Patches end where local mapping does not know the way any better.
constexpr double kWayKnown_m2 = 0.2 * 0.2;

Matrix3d diagonal(double sigma_m, double sigma_rad) {
  return Eigen::Vector3d(sigma_m, sigma_m, sigma_rad).cwiseAbs2().asDiagonal();
}

bool is_way_known(const KeyScan& key) {
  return std::max(key.T_before_this.covariance(0, 0), key.T_before_this.covariance(1, 1)) <=
         kWayKnown_m2;
}

ScrollingMapOptions patch_map() {
  ScrollingMapOptions options;
  options.window_m = kWindow_m;
  return options;
}

std::int32_t rounded(double value, double step) {
  return static_cast<std::int32_t>(std::lround(value / step));
}

}  // namespace

Status validate(const PatchMatchOptions& options) {
  return Validator("refinement.matching")
      .within("patch_reach_m", options.patch_reach_m, 0.0, 10.0)
      .within("patch_every_m", options.patch_every_m, 0.1, 10.0)
      .within("apart_m", options.apart_m, 0.0, 1e6)
      .within("near_m", options.near_m, 0.1, 10.0)
      .within("passes", options.passes, 1, 20)
      .within("min_score", options.min_score, 0.0, 1.0)
      .within("min_known_share", options.min_known_share, 0.0, 1.0)
      .status();
}

Pose2 PatchMatcher::Start::pose() const {
  return {kRaster_m * x, kRaster_m * y, kRaster_rad * turn};
}

PatchMatcher::PatchMatcher(const PatchMatchOptions& options)
    : options_(options), map_(patch_map()) {
  CAIRN_CHECK(validate(options).ok());
}

PatchMatcher::Starts PatchMatcher::starts(const KeyScans& keys,
                                          const std::vector<Pose2>& T_global_key) const {
  const Passages passages(keys, T_global_key, options_);
  Starts starts;
  for (int key = 0; key < static_cast<int>(keys.size()); ++key) {
    for (const int patch : passages.near(key)) {
      const Pose2 T_patch_key = T_global_key[static_cast<std::size_t>(patch)].inverse() *
                                T_global_key[static_cast<std::size_t>(key)];
      starts[patch].push_back({key, rounded(T_patch_key.x(), kRaster_m),
                               rounded(T_patch_key.y(), kRaster_m),
                               rounded(wrap_angle(T_patch_key.theta()), kRaster_rad)});
    }
  }
  return starts;
}

std::vector<PatchMatch> PatchMatcher::match(const KeyScans& keys,
                                            const std::vector<Pose2>& T_global_key) {
  CAIRN_CHECK(keys.size() == T_global_key.size());
  for (const Pose2& pose : T_global_key) {
    CAIRN_CHECK(std::abs(pose.x()) < kFarthest_m && std::abs(pose.y()) < kFarthest_m);
  }
  std::vector<PatchMatch> matches;
  for (const auto& [patch, starts] : starts(keys, T_global_key)) {
    bool is_drawn = false;
    for (const Start& start : starts) {
      const auto [known, is_new] = known_.try_emplace({patch, start});
      known->second.asked_in = period_;
      if (is_new) {
        if (!std::exchange(is_drawn, true)) {
          draw(keys, patch);
        }
        known->second.T_patch_key =
            laid_on_patch(*keys[static_cast<std::size_t>(start.key)]->scan, start.pose());
        ++matches_made_;
      }
      if (known->second.T_patch_key) {
        matches.push_back({patch, start.key, *known->second.T_patch_key});
      }
    }
  }
  return matches;
}

void PatchMatcher::forget_unused() {
  std::erase_if(known_, [this](const auto& one) { return one.second.asked_in != period_; });
  ++period_;
}

void PatchMatcher::draw(const KeyScans& keys, int patch) {
  const auto middle = static_cast<std::size_t>(patch);
  const auto is_within = [&](std::size_t key) {
    return std::abs(keys[key]->travel_m - keys[middle]->travel_m) <= options_.patch_reach_m;
  };
  ScanBeams beams;
  const auto insert = [&](std::size_t key, const Pose2& T_patch_key) {
    beams.take(*keys[key]->scan, Twist{}, kRange_m);
    map_.insert(beams, T_patch_key, 0.0);
  };
  map_.clear();
  insert(middle, Pose2());
  Pose2 T_patch_key;
  for (std::size_t key = middle; key > 0 && is_within(key - 1) && is_way_known(*keys[key]); --key) {
    T_patch_key = T_patch_key * keys[key]->T_before_this.mean.inverse();
    insert(key - 1, T_patch_key);
  }
  T_patch_key = Pose2();
  for (std::size_t key = middle + 1;
       key < keys.size() && is_within(key) && is_way_known(*keys[key]); ++key) {
    T_patch_key = T_patch_key * keys[key]->T_before_this.mean;
    insert(key, T_patch_key);
  }
}

std::optional<GaussianPose> PatchMatcher::laid_on_patch(const LaserScan& scan,
                                                        const Pose2& start) const {
  ScanBeams beams;
  beams.take(scan, Twist{}, kRange_m);
  std::vector<SurfacePoint> points;
  surface_points_of(beams, kSpacing_m, kRange_m, &points);
  const GaussianPose prior{start, diagonal(kStartSigma_m, kStartSigma_rad)};
  ScanMatch match;
  match.fit = refine_on_surfaces(map_, points, prior, start, {kHitSigma_m, kIndependentShare});
  judge(map_, points, kOnWall_m, &match);
  const GaussianPose T_patch_key{
      match.fit.T_lpm_robot,
      match.covariance(kHitSigma_m) + diagonal(kLeastSigma_m, kLeastSigma_rad)};
  const bool is_believed = match.score >= options_.min_score &&
                           match.known_share >= options_.min_known_share &&
                           is_positive_definite(T_patch_key.covariance);
  return is_believed ? std::optional(T_patch_key) : std::nullopt;
}

}  // namespace cairn
