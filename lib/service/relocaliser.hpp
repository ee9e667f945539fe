#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/result.hpp"
#include "geometry/gaussian_pose.hpp"
#include "global_map/global_map.hpp"
#include "lpm/global_localiser.hpp"
#include "lpm/global_search.hpp"
#include "sensing/laser_scan.hpp"

namespace cairn {

/// Looking for a robot that has lost its local map in the map of all that it has seen. In the
/// configuration file: "relocalisation".
struct RelocalisationOptions {
  bool looks = true;                 ///< If not, the robot goes on in a new local map, and no more.
  double cell_m = 0.1;               ///< Of the map that is searched. [0.05, 1]
  int max_cells = 2'000'000;         ///< A larger map is not searched. [1000, 20000000]
  double draw_every_m = 0.3;         ///< Travel between scans that are drawn. [0, 10]
  int lookups_per_scan = 2'000'000;  ///< Work with each scan, in cells looked up. [10000, 1e9]
  int max_searches = 60;             ///< Then it is given up. [1, 100000]
  double accept_travel_m = 4;        ///< So much travel must be explained, [0, 1000]
  double accept_score = 0.86;        ///< with this mean score, [0, 1]
  double accept_margin = 0.05;       ///< so much better than by any other pose. [0, 1]
};

/// Names every field that is out of range, with its value.
[[nodiscard]] Status validate(const RelocalisationOptions& options);

/// Where a robot was found again. It is said, not acted upon: whether the place is the same is for
/// the hypotheses to decide.
struct Relocalisation {
  std::int64_t number = 0;  ///< Counts up from 1.
  TimePoint time;
  GaussianPose T_global_robot;  ///< In the best map as of when the robot got lost.
  int place = -1;               ///< The nearest one of the best map; -1: it has none.
  double distance_m = 0.0;      ///< To that place.
  double score = 0.0;           ///< Mean over the key scans, [0, 1].
  double margin = 0.0;          ///< How much better than the next pose.
  double travel_m = 0.0;        ///< Since the robot got lost.
};

/// As in "relocalised near place 3, ...".
[[nodiscard]] std::string to_text(const Relocalisation& found);

/// Searches the whole map for a robot that is lost, until a pose is accepted with a margin after
/// some travel, or the budget is spent. With each scan a bounded amount of work is done, counted
/// and not timed, so that the same scans always lead to the same end: first the map is drawn and
/// made ready, then it is searched.
///
/// Source: Modayil et al., IROS 2004, Sec. IV-B; GlobalLocaliser.
class Relocaliser {
 public:
  /// @pre validate(options).ok()
  explicit Relocaliser(const RelocalisationOptions& options = {});

  /// The robot is lost: what it has seen so far is searched from now on. Nothing comes of it where
  /// that is nothing, or too much.
  void start(const std::vector<PosedScan>& seen);
  void stop();
  [[nodiscard]] bool is_searching() const { return stage_ != Stage::kIdle; }

  /// Takes the next scan.
  /// @param motion since the scan before
  /// @return time, pose and figures where the robot was found with this scan; place and number are
  ///         for the caller to fill in
  std::optional<Relocalisation> absorb(const LaserScan& scan, const GaussianPose& motion);

 private:
  enum class Stage : std::uint8_t { kIdle, kDrawing, kCopying, kPreparing, kSearching };

  // Each goes on for so much work and tells what is left of it.
  std::int64_t draw(std::int64_t lookups);
  std::int64_t copy(std::int64_t lookups);
  std::int64_t prepare(std::int64_t lookups);
  std::optional<Relocalisation> search(const LaserScan& scan, std::int64_t lookups);

  RelocalisationOptions options_;
  Stage stage_ = Stage::kIdle;
  std::vector<PosedScan> seen_;  // to be drawn, first those at the end
  GlobalMap map_;
  std::vector<PosedScan> drawn_;
  std::vector<TileIndex> tiles_;  // to be copied
  OccupancyGrid grid_;
  std::unique_ptr<GlobalSearch> search_;
  std::unique_ptr<GlobalLocaliser> localiser_;
  GaussianPose motion_;  // since the last scan that was searched for
  double travel_m_ = 0.0;
};

}  // namespace cairn
