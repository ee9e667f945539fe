#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "geometry/gaussian_pose.hpp"
#include "global_map/global_map.hpp"
#include "layout/place_layout.hpp"
#include "place/gateway.hpp"
#include "refinement/trajectory_refiner.hpp"
#include "sensing/laser_scan.hpp"
#include "sensing/time.hpp"
#include "service/operator_log.hpp"

namespace cairn {

/// Where the robot was, in the global frame.
struct TimedPose {
  TimePoint time;
  Pose2 T_global_robot;
  bool is_of_scan = true;  ///< If not, of odometry between scans.
};

/// A gateway of a place of the best map, in the place frame.
struct MappedGateway {
  Gateway perceived;
  bool is_pending = true;
  int path = -1;
};

/// A place of the best map.
struct MappedPlace {
  int id = -1;
  std::string name;  ///< Given by a person; empty otherwise.
  GaussianPose T_global_place;
  std::string star;  ///< Fig. 3(f) of Kuipers et al., ICRA 2004.
  int visit_count = 0;
  std::vector<MappedGateway> gateways;  ///< Clockwise.
  std::size_t anchor_scan = 0;          ///< Of the first visit: the robot was near its origin.
};

/// One travel along a segment.
struct SegmentTravel {
  int visit = -1;              ///< In which it ended.
  std::size_t constraint = 0;  ///< Its number in MapState::travels.
};

/// A path segment of the best map: leaving one place by a gateway leads to another. Or a travel
/// that the map leaves unexplained.
struct MappedSegment {
  int from_place = -1;
  int from_gateway = -1;
  int to_place = -1;
  int to_gateway = -1;
  bool is_broken = false;  ///< Travelled, but the map has no link there.
  int travel_count = 0;
  double length_m = 0.0;  ///< Of the shortest travel.
  GaussianPose T_from_to;
  /// Of all travels along it, in their order.
  std::vector<SegmentTravel> travels;
  double disagreement_sigmas = 0.0;  ///< Of the travel that disagrees most with all others.
  int disagreeing_visit = -1;        ///< In which it ended; -1: nothing checks any of them.
  std::size_t first_scan = 0;        ///< Of one travel along it, in MapState::trajectory.
  std::size_t last_scan = 0;
};

/// One live hypothesis, for people who watch.
struct HypothesisSummary {
  std::int64_t id = -1;
  std::int64_t parent = -1;
  double log_posterior = 0.0;
  double probability = 0.0;  ///< Share among the live ones.
  int places = 0;
  int paths = 0;
  int closures = 0;
  int pending = 0;
};

/// Everything that is published about the map, as one immutable picture: queries, the global map
/// and the documents are made from it on other threads.
struct MapState {
  TimePoint time;  ///< Of the last scan.
  std::int64_t topology_revision = 0;
  std::int64_t visit_count = 0;
  std::int64_t hypothesis = -1;  ///< Whose map this is, mostly the best one; -1: no visit yet.
  double probability = 0.0;
  int at_place = -1;  ///< Where the last visit was.
  int path_count = 0;
  int closure_count = 0;
  std::vector<int> place_of_visit;  ///< By visit. Places are numbered as they were first met.
  std::vector<MappedPlace> places;
  std::vector<MappedSegment> segments;
  std::vector<HypothesisSummary> hypotheses;  ///< Best first; the best ones only.
  std::int64_t live_count = 0;
  std::int64_t waiting_count = 0;  ///< Consistent ones that are not live, as others are better.
  std::int64_t refuted_count = 0;
  std::int64_t refused_visits = 0;          ///< Stars that are no valid view.
  std::int64_t guarantee_given_up_at = -1;  ///< Visit number; -1: every consistent map is alive.
  std::string guarantee_reason;
  std::string blamed;  ///< By the last repair; empty: no visit had to be blamed.
  std::vector<AuditedAssertion> assertions;  ///< All that operators ever said, in order.
  std::vector<PosedScan> trajectory;         ///< Every scan so far: H(x).
  /// Every scan and every odometry sample between scans, in the order of arrival.
  std::vector<TimedPose> poses;
  Pose2 T_global_lpm;  ///< Where the frame of the local map lies now.
  KeyScans key_scans;  ///< Of the trajectory.
  /// By key scan, of its refined pose in the global frame, as against the first; may be empty.
  std::vector<Matrix3d> key_covariances;
  std::vector<TravelConstraint> travels;  ///< What the layout rests on.
  std::vector<SamePlace> same_places;     ///< What ties the trajectory to itself.
};

}  // namespace cairn
