#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "geometry/gaussian_pose.hpp"
#include "grid/occupancy_grid.hpp"
#include "lpm/dead_reckoning.hpp"
#include "lpm/heading_drift.hpp"
#include "lpm/local_fix.hpp"
#include "lpm/lpm_options.hpp"
#include "lpm/matcher.hpp"
#include "lpm/scan_beams.hpp"
#include "lpm/scrolling_map.hpp"
#include "lpm/wall_orientation.hpp"
#include "lpm/way_watch.hpp"
#include "sensing/scan_joiner.hpp"

namespace cairn {

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
  [[nodiscard]] ScanMatch best_match(const GaussianPose& predicted);
  void settle(const ScanMatch& match, const GaussianPose& predicted, LocalFix* fix);
  void advance(const JoinedScan& joined, LocalFix* fix);
  void correct_heading(LocalFix* fix);
  void ask_walls();
  void note_way(LocalFix* fix);
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
  WayWatch way_;
  double usual_score_ = 0.0;  // of matches of late
  int laser_ = 0;             // of the scan taken last
  double travel_m_ = 0.0;
  int refusals_ = 0;
  std::int64_t restarts_ = 0;
  std::int64_t renewals_ = 0;
};

}  // namespace cairn
