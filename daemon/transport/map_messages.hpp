#pragma once

#include <cstdint>

#include <cairn_lcm/assertions_t.hpp>
#include <cairn_lcm/hypotheses_t.hpp>
#include <cairn_lcm/place_event_t.hpp>
#include <cairn_lcm/pose_t.hpp>
#include <cairn_lcm/topology_t.hpp>
#include <cairn_lcm/trajectory_t.hpp>
#include <cairn_lcm/visit_places_t.hpp>

#include "lpm/local_mapper.hpp"
#include "service/map_state.hpp"

namespace cairn {

/// Whose messages these are.
struct Sender {
  std::int64_t boot_id = 0;
  std::int64_t map_id = 0;
};

/// What the daemon says of its map. `utime` of every message is that of the last scan, so that the
/// same log gives the same bytes.
[[nodiscard]] cairn_lcm::topology_t to_topology(const MapState& state, const Sender& sender);
[[nodiscard]] cairn_lcm::hypotheses_t to_hypotheses(const MapState& state, const Sender& sender);
[[nodiscard]] cairn_lcm::assertions_t to_assertions(const MapState& state, const Sender& sender);
[[nodiscard]] cairn_lcm::trajectory_t to_trajectory(const MapState& state, const Sender& sender);
[[nodiscard]] cairn_lcm::visit_places_t to_visit_places(const MapState& state,
                                                        const Sender& sender);

/// @param T_global_robot none while no pose in the global frame is claimed
/// @param state may be null: no place is known then
[[nodiscard]] cairn_lcm::pose_t to_pose(const LocalFix& fix,
                                        const GaussianPose* T_global_robot,
                                        const MapState* state,
                                        const Sender& sender);

}  // namespace cairn
