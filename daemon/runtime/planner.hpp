#pragma once

#include <cairn_lcm/plan_request_t.hpp>
#include <cairn_lcm/plan_t.hpp>

#include "global_map/global_map.hpp"
#include "planning/path.hpp"
#include "service/map_state.hpp"
#include "transport/map_messages.hpp"

namespace cairn {

/// Answers a plan request from one immutable picture of the map: the shortest route over the
/// places, refined to a metric path on the global map. What cannot be planned is said in the
/// result.
[[nodiscard]] cairn_lcm::plan_t answer(const cairn_lcm::plan_request_t& request,
                                       const MapState& state,
                                       const GlobalMap& map,
                                       const PathOptions& options,
                                       const Sender& sender);

/// The answer to a request that was carried out, or not.
[[nodiscard]] cairn_lcm::result_t to_result(const cairn_lcm::rpc_header_t& request,
                                            const Status& status);

/// An answer without a plan. `request` gives the header to answer to.
[[nodiscard]] cairn_lcm::plan_t refusal(const cairn_lcm::rpc_header_t& request,
                                        const Sender& sender,
                                        std::int32_t code,
                                        const std::string& reason);

}  // namespace cairn
