#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "geometry/gaussian_pose.hpp"
#include "grid/occupancy_grid.hpp"
#include "lpm/dead_reckoning.hpp"
#include "lpm/heading_drift.hpp"
#include "lpm/lpm_options.hpp"
#include "lpm/matcher.hpp"
#include "lpm/scan_beams.hpp"
#include "lpm/scrolling_map.hpp"
#include "lpm/wall_orientation.hpp"
#include "sensing/scan_joiner.hpp"

namespace cairn {

/// What the local layer has to say about how it came to a fix.
enum class FixNote : std::uint8_t {
  kMatched,        ///< The scan agrees with the map and with odometry.
  kFirst,          ///< Nothing to match with: the first scan, or the first after a restart.
  kSlip,           ///< Matched, but odometry says otherwise: slip, push, or a stalled wheel.
  kTeleport,       ///< Matched; odometry jumped farther than the robot can drive.
  kBlockedSensor,  ///< Refused: hardly any returns, all from close by, or the same while driving.
  kNoOverlap,      ///< Refused: hardly any return falls where the map knows anything.
  kContradiction,  ///< Refused: the returns do not fall on the walls of the map.
};

/// The name of a note, as in "no overlap".
[[nodiscard]] const char* to_string(FixNote note);

/// Whether the scan was matched with nothing, though there was something to match it with.
[[nodiscard]] bool is_refused(FixNote note);

/// Where the robot is in the local metrical map, after one scan.
struct LocalFix {
  TimePoint time;
  /// In the "lpm" frame: one continuous frame of corrected odometry for the whole life of the
  /// mapper.
  Pose2 T_lpm_robot;
  /// Of the match alone, of (x, y, theta) in the lpm frame, in m^2, m rad and rad^2: positive
  /// definite, long along a corridor. Where the match was refused, that of dead reckoning.
  Matrix3d covariance = Matrix3d::Identity();
  /// T_previous_robot: the robot in the frame of the robot at the fix before. Motions of successive
  /// fixes are to be compounded as independent ones: their covariance is the rate at which dead
  /// reckoning by scan matching drifts. Where walls show that the heading of the lpm frame drifts,
  /// it is corrected here, and here alone: the map stays as it was drawn.
  GaussianPose motion;
  bool is_matched = false;
  bool is_degenerate = false;  ///< The scan does not fix every direction (a corridor, few returns).
  double score = 0.0;  ///< Share of the returns over known cells that fall on walls, [0, 1].
  /// Share of the returns that lie behind walls of the map from where the scan was matched: as no
  /// beam goes through a wall, the robot is elsewhere, or a wall is gone. Asked of every fourth
  /// scan and of those that odometry disagrees with; nothing: not asked.
  std::optional<double> through_walls;
  FixNote note = FixNote::kFirst;
  /// Why odometry and scans disagree, over this step and those before it.
  MotionFault fault = MotionFault::kNone;
};

/// The local metrical layer: tracks the robot within a map of its surroundings that is made on the
/// way, scrolls with it, and forgets what was left behind, so that no large loop can close by
/// accident. Depends on nothing but recent sensing.
///
/// Source: Kuipers et al., ICRA 2004, Sec. III-A; Modayil et al., IROS 2004, Sec. IV-A. Where the
/// papers localize by a particle filter, a scan is matched here: prediction by odometry, least
/// squares on the distance to the walls, and where that fails an exact correlative search.
///
/// Memory is constant. The same scans give the same fixes, bit for bit.
class LocalMapper {
 public:
  /// @pre validate(options).ok()
  explicit LocalMapper(const LpmOptions& options = {});

  /// Takes the next scan: every scan gives a fix, matched or refused.
  /// @pre validate(joined.scan).ok()
  LocalFix absorb(const JoinedScan& joined);
  /// The first half of absorb(): the fix.
  [[nodiscard]] LocalFix locate(const JoinedScan& joined);
  /// The second half, with the fix of the first: the map takes up that scan if it should.
  /// @return whether it did
  bool take_up(const LocalFix& fix);
  /// The other second half: the map is started afresh with that scan, whatever the fix.
  void start_anew();

  /// The occupancy grid around the robot, in the lpm frame. Its origin moves by whole cells.
  [[nodiscard]] const OccupancyGrid& grid() const { return map_.grid(); }
  /// How often the map was started afresh, since nothing fitted any more, and it was not known how
  /// the robot had come to where it is.
  [[nodiscard]] std::int64_t restarts() const { return restarts_; }
  /// How often the map was drawn anew around the robot, since nothing fitted any more, while the
  /// way was known: odometry was sound, and the surroundings went on from scan to scan.
  [[nodiscard]] std::int64_t renewals() const { return renewals_; }
  /// By how much scans are stamped later than odometry, as far as turns have shown it. >= 0
  [[nodiscard]] double scan_lag_s() const { return motion_.scan_lag_s(); }
  /// What the map and the search upon it hold.
  [[nodiscard]] std::size_t memory_bytes() const;

  /// Puts back a scan remembered with its pose, without matching, to rebuild the map after a
  /// restart: oldest first. The next scan absorbed is looked for where odometry says that the robot
  /// has gone since the scan restored last; without odometry, around that scan's pose.
  /// @param takes_up false where the map did not take up that scan: the robot was there, no more
  /// @pre validate(scan).ok()
  void restore(const LaserScan& scan,
               const Pose2& T_lpm_robot,
               const std::optional<Pose2>& T_odom_robot,
               bool takes_up = true);

 private:
  [[nodiscard]] bool is_sensor_blocked() const;
  [[nodiscard]] ScanMatch best_match(const GaussianPose& predicted);
  void settle(const ScanMatch& match, const GaussianPose& predicted, LocalFix* fix);
  void advance(const JoinedScan& joined, LocalFix* fix);
  void ask_what_is_behind_walls(LocalFix* fix);
  void correct_heading(LocalFix* fix);
  void ask_walls();
  void note_way(const LocalFix& fix);
  void clear_map();
  void draw();

  LpmOptions options_;
  ScanBeams beams_;  // of the scan taken last
  ScrollingMap map_;
  Matcher matcher_;
  DeadReckoning motion_;
  WallOrientation wall_orientation_;
  HeadingDrift heading_drift_;
  double heading_correction_rad_ = 0.0;  // that the motions told so far contain
  bool is_started_ = false;
  Pose2 T_lpm_robot_;
  Matrix3d uncertainty_ = Matrix3d::Zero();  // of dead reckoning since the last match, lpm frame
  std::map<int, Pose2> T_lpm_drawn_;         // by laser: where the map took its last scan
  /// What a laser saw last, if it was not blocked.
  struct Seen {
    Pose2 T_lpm_robot;
    std::vector<Vector2d> returns;
  };
  std::map<int, Seen> seen_;   // by laser
  bool is_way_known_ = false;  // since the last match
  int laser_ = 0;              // of the scan taken last
  double travel_m_ = 0.0;
  int refusals_ = 0;
  double blind_way_m_ = 0.0;  // by odometry, since the last match
  int unasked_ = 0;           // scans in a row, of what is behind walls
  std::int64_t restarts_ = 0;
  std::int64_t renewals_ = 0;
};

}  // namespace cairn
