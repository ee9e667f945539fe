#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "clients/sim/world.hpp"
#include "geometry/pose2.hpp"

namespace cairn::lab {

/// A corridor of a building, between two of its junctions, along x or y.
struct Corridor {
  int from = 0;
  int to = 0;
  double width_m = 2.0;
};

/// What stands, or is open, beside a corridor.
struct CorridorFeature {
  enum class Kind { kDoor, kCupboard, kPillar };
  Kind kind = Kind::kDoor;
  int corridor = 0;
  double along_m = 0.0;  ///< Of its middle, from the corridor's first junction.
  double side = 1.0;     ///< 1: left of the way from the first junction; -1: right.
  double length_m = 0.9;
  double depth_m = 0.3;
  double open_share = 0.0;  ///< Of a door: 0 closed, 1 wide open.
};

/// An office building made up at random: corridors on a lattice, some of them missing, with doors
/// to rooms, cupboards along the walls, and pillars. Every other building repeats itself: all its
/// corridors are as wide and, along one axis, as long as one another, with doors at the same
/// distances.
///
/// What is in it changes from one session to the next: doors are opened or closed, cupboards moved,
/// people stand elsewhere.
class Building {
 public:
  /// Same seed, same building, on every machine.
  explicit Building(std::uint64_t seed);

  /// The building as it is in one session, and a tour "walk" through its corridors, turning back
  /// only where there is no other way; the same for the same arguments.
  /// @param travels length of the tour, in corridors, >= 1
  [[nodiscard]] sim::World session(int number, int travels) const;

  /// The junction within two metres of a point.
  [[nodiscard]] std::optional<int> junction_near(const Vector2d& p_world) const;
  [[nodiscard]] bool repeats_itself() const { return repeats_itself_; }
  [[nodiscard]] const std::vector<Vector2d>& junctions() const { return junctions_; }
  [[nodiscard]] const std::vector<Corridor>& corridors() const { return corridors_; }

 private:
  std::uint64_t seed_;
  bool repeats_itself_ = false;
  std::vector<Vector2d> junctions_;
  std::vector<Corridor> corridors_;
  std::vector<CorridorFeature> features_;
};

}  // namespace cairn::lab
