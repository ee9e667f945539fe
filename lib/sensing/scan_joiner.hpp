#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <optional>

#include "base/result.hpp"
#include "sensing/laser_scan.hpp"
#include "sensing/odometry.hpp"

namespace cairn {

/// A scan together with the dead reckoning of the moment at which it was taken.
struct JoinedScan {
  LaserScan scan;
  std::optional<Pose2> T_odom_robot;  ///< At scan.time; none where odometry says nothing about it.
  /// How far odometry went, back and forth, since the scan before: by arrival, so about. A step
  /// from sample to sample counts for 2 m at most, as what is longer is no driving.
  double odom_way_m = 0.0;
};

/// How patiently scans and odometry are brought together. In the configuration file: "joiner".
struct JoinerOptions {
  double history_s = 10.0;  ///< Odometry that is kept, by its stamps. [0.1, 600]
  double patience_s = 0.5;  ///< How long a scan waits for odometry. [0, 60]
  /// A longer jump back, or ahead, is a stray stamp; three in a row that agree are a new clock.
  double clock_step_back_s = 5.0;    ///< [0.1, 3600]
  double clock_step_ahead_s = 3600;  ///< [1, 1e9]
};

/// Names every field that is out of range, with its value.
[[nodiscard]] Status validate(const JoinerOptions& options);

/// What was unusual in the streams. Nothing but exact duplicates and strays is ever dropped.
struct JoinerCounters {
  std::uint64_t duplicates = 0;    ///< Scans dropped: same stamp and ranges as the one before.
  std::uint64_t repeated = 0;      ///< Other scans stamped as the one before, yet passed on.
  std::uint64_t out_of_order = 0;  ///< Others stamped at or before an earlier one, yet passed on.
  std::uint64_t strays = 0;        ///< Scans and odometry dropped: stamped as if by another clock.
  std::uint64_t clock_steps = 0;   ///< New clocks; odometry of the old clock is forgotten.
  std::uint64_t gaps = 0;          ///< Scans whose neighbours in odometry are > patience_s apart.
  std::uint64_t scans_without_odometry = 0;
};

/// Joins scans and odometry by their stamps. Scans of one laser come out in the order in which they
/// came in; those of several lasers in the order of their stamps, as far as they wait together.
///
/// The odometry of a scan is the sample with exactly its stamp if there is one, else interpolated
/// between the two samples around it. A scan waits until a sample stamped at or after it has come.
/// Where later scans show that `patience_s` have passed meanwhile, odometry is extrapolated from
/// the last two samples if they are not older than that, else the scan goes without.
///
/// Stamps may step back, as those of recorded logs do. Samples are kept in the order of arrival,
/// and a scan takes the first of exactly its stamp that came after the sample its predecessor took,
/// so that it gets its own where stamps repeat. A scan whose stamp steps back waits for that. So
/// the result does not depend on how long scans lag behind odometry, nor, while stamps grow, on how
/// the two streams interleave within the patience. Each laser has stamps of its own: one that lags
/// behind another does not step back, and scans of several lasers and one stamp take the same
/// sample.
///
/// Memory is bounded by `history_s` and, against floods of equal stamps, by fixed capacities.
class ScanJoiner {
 public:
  explicit ScanJoiner(const JoinerOptions& options = {});

  /// @pre validate(sample).ok()
  void add(const OdometrySample& sample);
  /// @pre validate(scan).ok()
  void add(LaserScan scan);

  /// The next scan that need not wait any longer.
  [[nodiscard]] std::optional<JoinedScan> next();
  /// The input has ended: no scan waits any longer.
  void flush();

  [[nodiscard]] const JoinerCounters& counters() const { return counters_; }

 private:
  /// Stamps that would be of a new clock, if more of them came.
  struct Suspects {
    TimePoint last{};
    int count = 0;
  };
  struct Waiting {
    LaserScan scan;
    bool steps_back = false;        // stamped at or before an earlier scan
    std::uint64_t came_before = 0;  // arrival number of the next sample
  };

  /// What is known of one laser.
  struct Stream {
    std::optional<TimePoint> newest;
    std::optional<LaserScan> last;
    Suspects suspects;
  };
  /// The sample that had exactly the stamp of a scan.
  struct OwnSample {
    TimePoint time{};
    int laser = 0;
    Pose2 T_odom_robot;
  };

  void queue(Waiting scan);
  void release_ready();
  void release_front(std::optional<Pose2> T_odom_robot);
  void release_all();
  void forget_odometry();
  [[nodiscard]] static bool is_duplicate(const LaserScan& scan, const Stream& stream);
  [[nodiscard]] bool is_clock_step(std::optional<TimePoint> newest, TimePoint time) const;
  bool is_stray(std::optional<TimePoint> newest, TimePoint time, Suspects* suspects);
  void count_clock_step(TimePoint time);
  [[nodiscard]] bool has_waited_long() const;
  [[nodiscard]] std::optional<Pose2> take_own_sample(const LaserScan& scan);
  [[nodiscard]] std::optional<std::uint64_t> find_later_sample(TimePoint time) const;
  [[nodiscard]] std::optional<Pose2> joined(TimePoint time, std::uint64_t last_arrival);
  [[nodiscard]] std::optional<Pose2> extrapolated(TimePoint time);
  [[nodiscard]] const OdometrySample& sample(std::uint64_t arrival) const;
  [[nodiscard]] std::uint64_t end_arrival() const { return first_arrival_ + odometry_.size(); }

  JoinerOptions options_;
  JoinerCounters counters_;
  std::deque<OdometrySample> odometry_;  // in the order of arrival
  std::uint64_t first_arrival_ = 0;      // arrival number of odometry_.front()
  double way_m_ = 0.0;                   // of odometry since the last scan was released
  std::uint64_t cursor_ = 0;             // samples before it belong to earlier scans
  std::deque<Waiting> waiting_;
  std::deque<JoinedScan> ready_;
  std::optional<TimePoint> newest_odometry_;
  Suspects odometry_suspects_;
  std::map<int, Stream> streams_;  // by laser
  std::optional<OwnSample> own_;   // taken last
};

}  // namespace cairn
