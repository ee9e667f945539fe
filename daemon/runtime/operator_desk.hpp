#pragma once

#include <cairn_lcm/assert_request_t.hpp>
#include <cairn_lcm/assertion_report_t.hpp>
#include <cairn_lcm/explain_request_t.hpp>
#include <cairn_lcm/explanation_t.hpp>
#include <cairn_lcm/perception_request_t.hpp>
#include <cairn_lcm/perception_t.hpp>

#include "runtime/engine.hpp"

namespace cairn {

/// Does what an operator asks for, with places told by visit, number or name. What cannot be done
/// is said in the result. Of the moved visits the first kMostMoved are listed.
[[nodiscard]] cairn_lcm::assertion_report_t answer(const cairn_lcm::assert_request_t& request,
                                                   TimePoint now,
                                                   Engine* engine);
constexpr std::size_t kMostMoved = 1'000;

/// Why the maps are what they are. An overview has at most kVisitsAtOnce visits, a visit at most
/// kMostSteps alternatives, those taken and possible first: the answer fits into one message.
[[nodiscard]] cairn_lcm::explanation_t answer(const cairn_lcm::explain_request_t& request,
                                              const Engine& engine);
/// What was seen of a place at a visit.
[[nodiscard]] cairn_lcm::perception_t answer(const cairn_lcm::perception_request_t& request,
                                             Engine* engine);
constexpr std::int64_t kVisitsAtOnce = 20;
constexpr std::size_t kMostSteps = 120;

}  // namespace cairn
