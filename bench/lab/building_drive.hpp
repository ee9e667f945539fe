#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "bench/lab/recognition_building.hpp"
#include "place/place_detector.hpp"

namespace cairn::lab {

/// A visit that a simulated robot made, as it perceived it, and where it truly was.
struct SimulatedVisit {
  PlaceVisit perceived;
  Pose2 T_world_place;
  std::optional<int> junction;  ///< In its midst, or within two metres; none: no junction.
  int session = 0;
};

/// Drives through a building in one session and perceives it as the service does: by scans and
/// odometry, with their noise, through the local layer and the place detector. The robot is of some
/// make, by the seed: how far and wide it sees, how noisy.
/// @param travels length of the tour, in corridors, >= 1
[[nodiscard]] std::vector<SimulatedVisit> drive_building(const Building& building,
                                                         std::uint64_t seed,
                                                         int session,
                                                         int travels);

}  // namespace cairn::lab
