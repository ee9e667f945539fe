#include "clients/cairn/goal.hpp"

#include <charconv>
#include <cmath>
#include <limits>
#include <numbers>
#include <string_view>
#include <vector>

namespace cairn::clients {
namespace {

template <typename Number>
std::optional<Number> parse_number(std::string_view text) {
  Number value{};
  const char* end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, value);
  return error == std::errc() && rest == end ? std::optional<Number>(value) : std::nullopt;
}

std::optional<std::vector<double>> parse_numbers(std::string_view text) {
  std::vector<double> numbers;
  while (true) {
    const std::size_t comma = text.find(',');
    const std::optional<double> number = parse_number<double>(text.substr(0, comma));
    if (!number) {
      return std::nullopt;
    }
    numbers.push_back(*number);
    if (comma == std::string_view::npos) {
      return numbers;
    }
    text.remove_prefix(comma + 1);
  }
}

}  // namespace

std::optional<cairn_lcm::plan_request_t> parse_goal(const std::string& text) {
  if (text.empty()) {
    return std::nullopt;
  }
  cairn_lcm::plan_request_t request{};
  request.from_place = -1;
  request.goal_place = -1;
  request.goal_theta_rad = std::numeric_limits<double>::quiet_NaN();
  if (const std::optional<std::int64_t> place = parse_number<std::int64_t>(text)) {
    if (*place < 0) {
      return std::nullopt;
    }
    request.goal_place = *place;
    return request;
  }
  const std::optional<std::vector<double>> numbers = parse_numbers(text);
  if (!numbers || (numbers->size() != 2 && numbers->size() != 3)) {
    request.goal_name = text;
    return request;
  }
  for (const double number : *numbers) {
    if (!std::isfinite(number)) {
      return std::nullopt;
    }
  }
  request.goal_x_m = (*numbers)[0];
  request.goal_y_m = (*numbers)[1];
  if (numbers->size() == 3) {
    request.goal_theta_rad =
        std::remainder((*numbers)[2] * std::numbers::pi / 180.0, 2.0 * std::numbers::pi);
  }
  return request;
}

std::optional<cairn_lcm::place_ref_t> parse_place(const std::string& text) {
  constexpr std::string_view kVisit = "visit:";
  const bool is_visit = text.compare(0, kVisit.size(), kVisit) == 0;
  const std::string_view rest = std::string_view(text).substr(is_visit ? kVisit.size() : 0);
  const bool is_number =
      !rest.empty() && rest.find_first_not_of("-0123456789") == std::string_view::npos;
  cairn_lcm::place_ref_t place{-1, -1, ""};
  if (!is_visit && !is_number) {
    place.name = text;
    return text.empty() ? std::nullopt : std::optional(place);
  }
  const std::optional<std::int64_t> number = parse_number<std::int64_t>(rest);
  if (!number || *number < 0) {
    return std::nullopt;
  }
  (is_visit ? place.visit : place.place) = *number;
  return place;
}

}  // namespace cairn::clients
