#pragma once

#include <map>
#include <vector>

#include "geometry/pose2.hpp"
#include "lpm/local_fix.hpp"
#include "lpm/scan_beams.hpp"

namespace cairn {

/// Tells whether it is known how the robot came to where it is, whatever a map says.
///
/// A robot that drives sees most of what it saw in the scan before, where odometry has it. One that
/// was lifted and set down elsewhere does not: its surroundings break off. The new ones then mostly
/// fit the map somewhere, somehow; that is found out by going on. So the way stays unknown until
/// all scans have fitted as well as before the break for so much travel that the robot has looked
/// at its surroundings from another side.
class WayWatch {
 public:
  /// What is known about a fix besides itself.
  struct Circumstances {
    int laser = 0;
    bool has_odometry = false;
    double usual_score = 0.0;  ///< What scans scored of late.
  };

  /// The step that odometry tells, before the scan at its end is matched.
  void foretell(const Pose2& step);
  /// Whether the next call of `note` will have a question to this fix: after a break, or where it
  /// is not what was to be expected.
  [[nodiscard]] bool is_in_doubt(const LocalFix& fix, double usual_score) const;
  /// The fix of the scan. Not for scans of blocked sensors.
  void note(const Circumstances& circumstances, const ScanBeams& beams, const LocalFix& fix);
  /// The map was started afresh: what was before does not matter.
  void start_anew();

  /// Since the last match.
  [[nodiscard]] bool is_known() const { return is_known_; }
  /// The surroundings broke off, and no travel has shown yet that the robot is where it was
  /// matched.
  [[nodiscard]] bool has_broken_off() const { return has_broken_off_; }

 private:
  /// What a laser saw last.
  struct Seen {
    Pose2 T_lpm_robot;
    Pose2 T_robot_foretold;  // where odometry has the robot now, seen from there
    std::vector<Vector2d> returns;
  };
  [[nodiscard]] bool breaks_off(const Seen& seen,
                                const ScanBeams& beams,
                                const LocalFix& fix) const;
  void confirm(const LocalFix& fix);

  std::map<int, Seen> seen_;  // by laser
  bool is_known_ = false;
  bool has_broken_off_ = false;
  double confirmed_m_ = 0.0;     // of the travel that shows where the robot is
  double unbroken_score_ = 0.0;  // usual before the break
  Pose2 T_lpm_robot_;            // at the fix before
};

}  // namespace cairn
