#pragma once

#include <array>
#include <optional>

#include "geometry/gaussian_pose.hpp"
#include "lpm/local_mapper.hpp"
#include "lpm/localisation_health.hpp"
#include "sensing/time.hpp"

namespace cairn {

/// For how long one of two streams has been silent while the other went on, by the stamps of that
/// other one. Stamps that step back or jump ahead count for little.
class Silence {
 public:
  void heard();
  void other_heard(TimePoint time);
  [[nodiscard]] double seconds() const { return silent_s_; }
  /// How long it usually lasts.
  [[nodiscard]] double usual_s() const { return usual_s_; }

 private:
  std::optional<TimePoint> last_;
  double silent_s_ = 0.0;
  double usual_s_ = 0.0;
};

/// Tells by rule, fix after fix, whether the robot knows where it is in its local map: from the
/// error accumulated since the last reliable fix, from scans that are refused, from what odometry
/// and scans disagree about, and from sensors that fall silent.
///
/// A fix is reliable where the scan was matched and fixes every direction. Between reliable fixes
/// motions are compounded; beyond e_max the robot is lost, below e_min and with some matched scans
/// in a row it is found. While it is lost the local map must not change and no place be looked for,
/// since both would be told of where the robot is not; `may_map` and `may_see_places` say so. The
/// same holds while matches are doubted: a robot set down elsewhere in a room often finds a pose
/// that fits so-so, and a map that took up its scans there would soon fit better, and be wrong. A
/// map that nothing fits any more cannot be the way out: after a while `needs_new_map`.
///
/// Source: Simhon and Dudek, IROS 1998, on when a robot is lost.
class LocalisationWatch {
 public:
  /// @pre validate(options).ok()
  explicit LocalisationWatch(const LocalisationOptions& options = {});

  /// Of every reading as it comes in, before scans and odometry are joined.
  void heard_odometry(TimePoint time);
  void heard_scan(TimePoint time);

  /// The next fix, before the map takes up its scan.
  void observe(const LocalFix& fix, bool has_odometry);
  /// The local map was started afresh with the scan of the last fix.
  void started_new_map();

  [[nodiscard]] const LocalisationHealth& health() const { return health_; }
  [[nodiscard]] bool is_lost() const { return is_lost_; }
  /// Whether the map may take up the scan of the last fix.
  [[nodiscard]] bool may_map() const { return (!is_lost_ || is_map_new_) && !is_doubtful_; }
  [[nodiscard]] bool may_see_places() const { return !is_lost_ && !is_doubtful_; }
  /// The robot is lost, and for long nothing has fitted the map.
  [[nodiscard]] bool needs_new_map() const;

 private:
  void accumulate(const LocalFix& fix);
  void doubt(const LocalFix& fix);
  void count_runs(const LocalFix& fix);
  void note_fault(MotionFault fault);
  void lose(LocalisationCause cause);
  void judge();
  [[nodiscard]] bool are_scans_missing() const;
  [[nodiscard]] LocalisationCause cause_of_trouble() const;

  LocalisationOptions options_;
  LocalisationHealth health_;
  Silence odometry_silence_;
  Silence scan_silence_;
  std::optional<LocalFix> fix_;  // the last one
  GaussianPose since_reliable_;  // motion
  double reliable_m2_ = 0.0;     // variance of the last reliable fix
  bool is_lost_ = false;
  double through_walls_ = 0.0;  // as told last
  double usual_score_ = 0.0;    // of matched scans, less what is behind walls; 0 before the first
  bool is_doubted_ = false;     // that the robot is where the map has it
  bool is_doubtful_ = false;    // the last fix, for that
  int trusted_scans_ = 0;       // in a row, while it is doubted
  bool is_map_new_ = false;     // and the robot not yet found in it
  int refused_scans_ = 0;       // in a row
  int unfitting_scans_ = 0;     // in a row, blocked ones aside
  int matched_scans_ = 0;       // in a row
  int guessed_scans_ = 0;       // in a row, without odometry
  std::array<int, LocalisationHealth::kFaults> calm_scans_{};  // in a row, without that fault
  int good_scans_ = 0;                                         // in a row, with no trouble at all
};

}  // namespace cairn
