#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "geometry/gaussian_pose.hpp"
#include "lpm/local_mapper.hpp"
#include "place/place_detector.hpp"
#include "refinement/key_scan.hpp"
#include "sensing/laser_scan.hpp"
#include "sensing/odometry.hpp"

namespace cairn {

/// What the local layer made of one scan.
struct PerceivedScan {
  std::shared_ptr<const LaserScan> scan;
  LocalFix fix;
  std::optional<Pose2> T_odom_robot;  ///< Dead reckoning at the scan, where it is known.
  /// Odometry since the scan before, in the order of arrival, as poses in the frame of the robot at
  /// that scan; the last one is of this scan itself. Poses between scans are interpolated along
  /// them. Empty where one of the two scans has no odometry.
  std::vector<OdometrySample> between;
  /// Whether the local map may take it up: a scan of a lost robot, or of a blocked sensor, is
  /// remembered, but no map is drawn from it.
  bool is_trusted = true;
};

/// Whether a step between two scans says next to nothing of where the robot went: on the way from a
/// local map that nothing fitted any more to a new one, it may have been carried anywhere.
[[nodiscard]] bool is_way_unknown(const GaussianPose& motion);

/// A visit, and the scan at which the robot was closest to the origin of the place: the end of one
/// travel and the start of the next.
struct Visit {
  PlaceVisit perceived;
  std::size_t anchor_scan = 0;
};

/// The travel from one visit to the next.
struct Travel {
  GaussianPose
      T_from_to;          ///< F(lambda): place frame of the later visit in that of the earlier one.
  double length_m = 0.0;  ///< Along the way.
};

/// All that is remembered: every perceived scan and every visit, in order. The journal is this, on
/// disk; everything global is a fold over it.
class Experience {
 public:
  void add(PerceivedScan scan);

  /// The visit that the detector has just closed, with its anchor among the scans since the last
  /// visit's: those on the local map of its own.
  /// @pre at least one scan has been added
  [[nodiscard]] Visit anchored(PlaceVisit visit) const;

  /// Remembers a visit; from the second one on there is a travel to it.
  /// @pre its anchor is not before the last visit's and is a scan that has been added
  void add(Visit visit);

  /// The robot turned around on its way and came back to the last visit's place by the gateway by
  /// which it had left: that visit goes on, until the robot leaves by another gateway or none.
  /// @param departure_gateway in the numbers of the last visit; -1: the robot is still there
  /// @pre there is a visit
  void continue_last_visit(TimePoint left, int departure_gateway);

  /// Whether the robot may have been carried anywhere since the last visit.
  [[nodiscard]] bool is_way_unknown_since_last_visit() const;

  [[nodiscard]] const std::vector<PerceivedScan>& scans() const { return scans_; }
  [[nodiscard]] const KeyScans& key_scans() const { return key_scans_.key_scans(); }
  [[nodiscard]] const std::vector<Visit>& visits() const { return visits_; }
  /// Travel i leads from visit i to visit i + 1.
  [[nodiscard]] const std::vector<Travel>& travels() const { return travels_; }

 private:
  [[nodiscard]] Travel travel_between(const Visit& from, const Visit& to) const;

  std::vector<PerceivedScan> scans_;
  KeyScanChooser key_scans_;
  std::vector<Visit> visits_;
  std::vector<Travel> travels_;
};

}  // namespace cairn
