#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "lpm/global_search.hpp"
#include "lpm/turned_scans.hpp"

namespace cairn {

/// A search under way, which can be done in slices: what it finds does not depend on how it was
/// sliced.
///
/// Best first, over blocks of cells and angles: no pose in a block is better than if every return,
/// and every point on the ways, met the best that it can meet from within the block. The bound of
/// a block is given up as soon as it cannot come to the least score any more.
///
/// Source: Hess et al., "Real-time loop closure in 2D lidar SLAM", ICRA 2016, Sec. V.
class GlobalSearchRun {
 public:
  static constexpr std::size_t kAtOnce = 4;  ///< Blocks that are looked at together.

  /// @param search must outlive this object
  /// @param points in the robot frame, in the order of the beams
  GlobalSearchRun(const GlobalSearch& search,
                  const std::vector<SurfacePoint>& points,
                  const GlobalQuery& query);

  /// Works on until it is done or has looked up so many cells more, and a few thousand more at
  /// most. Turning a point counts as a lookup, and a refinement as 5000.
  void work(std::int64_t lookups);
  [[nodiscard]] bool is_done() const { return phase_ == Phase::kDone; }
  /// As of now; all that was asked for when done.
  [[nodiscard]] const std::vector<GlobalMatch>& found() const { return found_; }
  /// How many cells were looked up so far.
  [[nodiscard]] std::int64_t lookups() const { return lookups_ + turned_.points_turned(); }

 private:
  /// A square of 2^level cells a side, at the angles of one group.
  struct Block {
    double score = 0.0;  // of the best pose that there may be in it
    std::int32_t level = 0;
    std::int32_t group = 0;
    Cell low;
  };
  struct Box {
    Cell low;
    Cell high;  // included
  };
  /// Some of one level and group.
  struct Blocks {
    std::int32_t level = 0;
    std::int32_t group = 0;
    std::size_t count = 0;
    std::array<Cell, kAtOnce> lows;
  };
  using Scores = std::array<double, kAtOnce>;
  /// Sums of rounded weights may be off by this much of a score.
  static constexpr double kRounding = 1e-9;
  enum class Phase : std::uint8_t { kOpening, kDiving, kSearching, kDone };

  [[nodiscard]] Box box_of(const GlobalWindow& window) const;
  void choose_top_blocks();
  [[nodiscard]] bool is_possible(Cell low, int level) const;
  void open_next();
  void choose_dives();
  void dive_next();
  void search_on();
  void open_parts(const Block& whole, std::vector<Block>* parts);
  void open(Blocks blocks, double may_be, std::vector<Block>* opened);
  void push(const Block& block);
  [[nodiscard]] Pose2 pose_of(const Block& leaf) const;
  void raise_cut(const Block& leaf);
  void take_up(const Block& leaf);
  [[nodiscard]] bool are_inside(const Blocks& blocks, const TurnedScan& turned) const;
  [[nodiscard]] Scores bounds_of(const Blocks& blocks);

  const GlobalSearch& search_;
  GlobalQuery query_;
  std::vector<SurfacePoint> points_;
  TurnedScans turned_;
  Box box_;
  int top_ = 0;
  std::vector<Cell> top_cells_;           // low corners of the blocks of the highest level
  std::size_t next_top_ = 0;              // the next of them to open
  std::size_t next_group_ = 0;            // with this group of angles
  std::vector<Block> dives_;              // the next one last
  std::vector<std::vector<Block>> open_;  // by score
  std::size_t highest_ = 0;               // of open_, that may have blocks
  std::vector<Block> parts_;              // scratch
  std::vector<Block> apart_;  // poses so far apart that each stands for one that will be found
  double cut_ = 0.0;          // poses below this will not be found
  std::vector<GlobalMatch> found_;
  std::int64_t lookups_ = 0;
  Phase phase_ = Phase::kOpening;
};

}  // namespace cairn
