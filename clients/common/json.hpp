#pragma once

#include <cairn_lcm/assertion_report_t.hpp>
#include <cairn_lcm/assertions_t.hpp>
#include <cairn_lcm/explanation_t.hpp>
#include <cairn_lcm/frame_change_t.hpp>
#include <cairn_lcm/hypotheses_t.hpp>
#include <cairn_lcm/place_event_t.hpp>
#include <cairn_lcm/plan_t.hpp>
#include <cairn_lcm/pose_t.hpp>
#include <cairn_lcm/status_t.hpp>
#include <cairn_lcm/topology_t.hpp>
#include <nlohmann/json.hpp>

namespace cairn::clients {

/// The messages as JSON, keys as the fields of the messages. What is not finite becomes null.
[[nodiscard]] nlohmann::ordered_json to_json(const cairn_lcm::status_t& status);
[[nodiscard]] nlohmann::ordered_json to_json(const cairn_lcm::topology_t& topology);
[[nodiscard]] nlohmann::ordered_json to_json(const cairn_lcm::hypotheses_t& hypotheses);
[[nodiscard]] nlohmann::ordered_json to_json(const cairn_lcm::place_event_t& event);
[[nodiscard]] nlohmann::ordered_json to_json(const cairn_lcm::frame_change_t& change);
[[nodiscard]] nlohmann::ordered_json to_json(const cairn_lcm::pose_t& pose);
[[nodiscard]] nlohmann::ordered_json to_json(const cairn_lcm::plan_t& plan);
[[nodiscard]] nlohmann::ordered_json to_json(const cairn_lcm::assertion_report_t& report);
[[nodiscard]] nlohmann::ordered_json to_json(const cairn_lcm::assertions_t& assertions);
[[nodiscard]] nlohmann::ordered_json to_json(const cairn_lcm::explained_step_t& step);
[[nodiscard]] nlohmann::ordered_json to_json(const cairn_lcm::explanation_t& explanation);

/// As text with two spaces of indent; bytes that are no UTF-8 are replaced.
[[nodiscard]] std::string dumped(const nlohmann::ordered_json& json);
/// On one line.
[[nodiscard]] std::string dumped_line(const nlohmann::ordered_json& json);

}  // namespace cairn::clients
