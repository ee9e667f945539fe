#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "lpm/distance_field.hpp"
#include "lpm/scan_refinement.hpp"

namespace cairn {

/// The box of poses that is searched, and how much is thought of the poses in it beforehand.
struct SearchWindow {
  Pose2 center;                    ///< T_frame_body
  double range_m = 0.5;            ///< Half the side, >= 0
  double turn_rad = 0.3;           ///< Half the angle, >= 0
  double sigma_m = 1e3;            ///< Prior belief around the centre; large: none.
  double sigma_rad = 1e3;          ///< Prior belief around the centre; large: none.
  double independent_share = 0.1;  ///< Share of the points that count against the prior. (0, 1]
  int step_level = 0;              ///< The raster's side is 2^step_level cells. [0, 4]
};

/// The best pose of a window on a raster of cells and angles.
struct SearchResult {
  Pose2 pose;
  double score = 0.0;  ///< Mean likelihood of the points on the raster, [0, 1].
};

/// Multi-resolution correlative search: the best pose of a raster over its window, exactly. The
/// raster's side is a cell or a few, its angle the one that moves the farthest point by as much.
///
/// Source: Olson, "Real-time correlative scan matching", ICRA 2009; bounds by max-pyramids and
/// branch and bound as in Hess et al., "Real-time loop closure in 2D lidar SLAM", ICRA 2016,
/// Sec. V-B.
class CorrelativeSearch {
 public:
  /// Takes the walls to search on, as they are now, as far as a square reaches; beyond it there are
  /// none.
  /// @param hit_sigma_m spread of a point around a wall, > 0
  /// @param reach_m half the side of the square, >= 0
  void prepare(const DistanceField& walls,
               double hit_sigma_m,
               const Vector2d& middle,
               double reach_m);

  /// @param points in the body frame; their normals do not matter here
  /// @pre prepare() has been called
  [[nodiscard]] SearchResult find(const std::vector<SurfacePoint>& points,
                                  const SearchWindow& window);

  [[nodiscard]] std::size_t memory_bytes() const;

 private:
  struct Candidate {
    std::int32_t angle = 0;
    std::int32_t x = 0;  // lowest offset of the block, in cells
    std::int32_t y = 0;
    std::int32_t level = 0;  // the block is 2^level offsets wide
    double bound = 0.0;
  };

  /// By bound, and in a fixed order where bounds are equal.
  [[nodiscard]] static bool is_worse(const Candidate& a, const Candidate& b);
  void take_walls(const DistanceField& walls, double hit_sigma_m, Cell low);
  void raise_level(int level);
  void widen_level(int level);
  [[nodiscard]] int height_of(int level) const {
    return (geometry_.height + (1 << level) - 1) >> level;
  }
  template <class T>
  static void give_back(std::vector<T>* scratch);
  void place_points(const std::vector<SurfacePoint>& points, const SearchWindow& window);
  [[nodiscard]] double bound_of(const Candidate& block, const SearchWindow& window) const;
  [[nodiscard]] double likelihood_sum(const Candidate& block) const;
  void branch(const Candidate& block, const SearchWindow& window);
  void push(Candidate block, const SearchWindow& window);

  static constexpr int kLevels = 5;
  GridGeometry geometry_;
  // [0]: the likelihood of every cell; [level]: on every 2^level-th cell, the maximum over the
  // 2^(level + 1) x 2^(level + 1) cells from there on, which hold every block of that level.
  std::array<std::vector<std::uint8_t>, kLevels> pyramid_;
  std::array<int, kLevels> widths_{};
  int angle_count_ = 0;  // on either side of the centre
  double angle_step_rad_ = 0.0;
  int range_cells_ = 0;
  std::size_t point_count_ = 0;
  static constexpr std::size_t kMostScratchBytes = 256 * 1024;  // of each that is kept
  std::vector<Cell> points_;  // of all angles, one angle after the other
  std::vector<Candidate> open_;
  Candidate best_;
};

}  // namespace cairn
