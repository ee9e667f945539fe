#include "service/refined_map.hpp"

#include <cmath>
#include <map>
#include <utility>

#include "layout/consistency.hpp"
#include "layout/trajectory.hpp"

namespace cairn {
namespace {

/// Of a travel's information, by direction; what others say less of they cannot contradict.
constexpr double kLeastChecked = 1e-3;

/// The poses between scans, bent along with those of the scans.
void follow_scans(const std::vector<Pose2>& T_global_robot, std::vector<TimedPose>* poses) {
  std::size_t scan = 0;
  std::vector<Pose2> run;  // from one scan to the next
  std::size_t first = 0;   // of `run` in `poses`
  for (std::size_t i = 0; i < poses->size(); ++i) {
    run.push_back((*poses)[i].T_global_robot);
    if (!(*poses)[i].is_of_scan) {
      continue;
    }
    if (scan > 0) {
      const std::vector<Pose2> bent =
          interpolate_travel(run, T_global_robot[scan - 1], T_global_robot[scan]);
      for (std::size_t k = 1; k + 1 < bent.size(); ++k) {
        (*poses)[first + k].T_global_robot = bent[k];
      }
    }
    run.assign(1, (*poses)[i].T_global_robot);
    first = i;
    (*poses)[i].T_global_robot = T_global_robot[scan++];
  }
}

void move_places(const std::vector<PosedScan>& before,
                 const std::vector<Pose2>& T_global_robot,
                 MapState* state) {
  for (MappedPlace& place : state->places) {
    const std::size_t anchor = place.anchor_scan;
    if (anchor < T_global_robot.size()) {
      place.T_global_place.mean = T_global_robot[anchor] * before[anchor].T_global_robot.inverse() *
                                  place.T_global_place.mean;
    }
  }
  for (MappedSegment& segment : state->segments) {
    segment.T_from_to.mean =
        state->places[static_cast<std::size_t>(segment.from_place)].T_global_place.mean.inverse() *
        state->places[static_cast<std::size_t>(segment.to_place)].T_global_place.mean;
  }
}

/// Which travel of each segment disagrees most with what all others say.
void check_travels(MapState* state) {
  PlaceLayout layout;
  for (const MappedPlace& place : state->places) {
    layout.T_global_place.push_back(place.T_global_place.mean);
  }
  const Result<std::vector<Agreement>> agreements = agreements_of(layout, state->travels);
  if (!agreements) {
    return;
  }
  for (MappedSegment& segment : state->segments) {
    for (const SegmentTravel& travel : segment.travels) {
      const Agreement& agreement = (*agreements)[travel.constraint];
      const bool is_checked = agreement.checked_share > kLeastChecked;
      if (is_checked &&
          (segment.disagreeing_visit < 0 || agreement.sigmas > segment.disagreement_sigmas)) {
        segment.disagreeing_visit = travel.visit;
        segment.disagreement_sigmas = agreement.sigmas;
      }
    }
  }
}

}  // namespace

std::shared_ptr<const MapState> MapRefiner::refined(const std::shared_ptr<const MapState>& state) {
  std::vector<Pose2> T_global_robot;
  T_global_robot.reserve(state->trajectory.size());
  for (const PosedScan& posed : state->trajectory) {
    T_global_robot.push_back(posed.T_global_robot);
  }
  const Result<RefinedTrajectory> trajectory =
      refiner_.refine(T_global_robot, state->key_scans, state->same_places);
  auto refined = std::make_shared<MapState>(*state);
  check_travels(refined.get());
  if (trajectory && !T_global_robot.empty()) {
    const std::vector<Pose2>& moved = trajectory->T_global_robot;
    for (std::size_t i = 0; i < moved.size(); ++i) {
      refined->trajectory[i].T_global_robot = moved[i];
    }
    refined->key_covariances = trajectory->key_covariances;
    follow_scans(moved, &refined->poses);
    move_places(state->trajectory, moved, refined.get());
    refined->T_global_lpm = moved.back() * T_global_robot.back().inverse() * state->T_global_lpm;
  }
  refined->poses = one_pose_for_each_time(refined->poses);
  return refined;
}

std::vector<TimedPose> one_pose_for_each_time(const std::vector<TimedPose>& poses) {
  /// Sums over the poses of one stamp.
  struct Sum {
    Vector2d p = Vector2d::Zero();
    Vector2d heading = Vector2d::Zero();
    double count = 0.0;
  };
  std::map<TimePoint, std::pair<Sum, Sum>> sums;  // of scans, and of poses between
  for (const TimedPose& posed : poses) {
    auto& [of_scans, between] = sums[posed.time];
    Sum& sum = posed.is_of_scan ? of_scans : between;
    const Pose2& pose = posed.T_global_robot;
    sum.p += pose.translation();
    sum.heading += Vector2d(std::cos(pose.theta()), std::sin(pose.theta()));
    sum.count += 1.0;
  }
  std::vector<TimedPose> unique;
  for (const TimedPose& posed : poses) {
    auto& [of_scans, between] = sums[posed.time];
    const bool is_of_scan = of_scans.count != 0.0;
    Sum& sum = is_of_scan ? of_scans : between;
    if (sum.count == 1.0 && posed.is_of_scan == is_of_scan) {
      unique.push_back(posed);
    } else if (sum.count > 1.0) {
      unique.push_back(
          {posed.time,
           Pose2(Vector2d(sum.p / sum.count), std::atan2(sum.heading.y(), sum.heading.x())),
           is_of_scan});
      sum.count = -1.0;  // Told.
    }
  }
  return unique;
}

}  // namespace cairn
