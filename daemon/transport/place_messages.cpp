#include "transport/place_messages.hpp"

#include "place/perception.hpp"
#include "sensing/time.hpp"
#include "star/small_scale_star.hpp"

namespace cairn {
namespace {

constexpr std::int8_t kFree = 0;
constexpr std::int8_t kWall = 100;
constexpr auto kUnknown = static_cast<std::int8_t>(-1);  // 255 of an unsigned byte

void put(const Pose2& pose, double* out) {
  out[0] = pose.x();
  out[1] = pose.y();
  out[2] = pose.theta();
}

std::int32_t state_of(OpeningState state) {
  switch (state) {
    case OpeningState::kGateway:
      return cairn_lcm::opening_t::GATEWAY;
    case OpeningState::kUnsure:
      return cairn_lcm::opening_t::UNSURE;
    case OpeningState::kUndecided:
      return cairn_lcm::opening_t::UNDECIDED;
    case OpeningState::kRejected:
      break;
  }
  return cairn_lcm::opening_t::REJECTED;
}

cairn_lcm::opening_t to_opening(const NumberedOpening& numbered) {
  const ConsideredOpening& opening = numbered.opening;
  cairn_lcm::opening_t message{};
  for (std::size_t i = 0; i < 2; ++i) {
    message.ends_m[2 * i] = opening.line.basis_points[i].x();
    message.ends_m[2 * i + 1] = opening.line.basis_points[i].y();
  }
  message.x_m = opening.line.middle.x();
  message.y_m = opening.line.middle.y();
  message.bearing_rad = opening.line.outward_bearing_rad;
  message.width_m = opening.line.width_m;
  message.seen_behind_m = opening.line.seen_beyond_m;
  message.between_walls_m = opening.behind.between_walls_m;
  message.needed_behind_m = opening.needed_m;
  message.log_odds = opening.log_odds;
  message.gateway = numbered.gateway;
  message.state = state_of(opening.state);
  message.state_name = to_string(opening.state);
  message.reason = why(opening);
  return message;
}

void put(const StateGrid& grid, cairn_lcm::perceived_place_t* message) {
  const GridGeometry& geometry = grid.geometry();
  message->cell_m = geometry.cell_m;
  message->origin_x_m = geometry.origin_m.x();
  message->origin_y_m = geometry.origin_m.y();
  message->width = geometry.width;
  message->height = geometry.height;
  for (int y = 0; y < geometry.height; ++y) {
    for (int x = 0; x < geometry.width; ++x) {
      const CellState state = grid.state({x, y});
      const std::int8_t cell = state == CellState::kFree       ? kFree
                               : state == CellState::kOccupied ? kWall
                                                               : kUnknown;
      message->cells.push_back(static_cast<std::uint8_t>(cell));
    }
  }
  message->num_cells = static_cast<std::int32_t>(message->cells.size());
}

void put_axis(const std::vector<std::vector<Vector2d>>& axis,
              cairn_lcm::perceived_place_t* message) {
  for (const std::vector<Vector2d>& line : axis) {
    for (const Vector2d& p : line) {
      message->axis_x_m.push_back(static_cast<float>(p.x()));
      message->axis_y_m.push_back(static_cast<float>(p.y()));
    }
    message->axis_line_points.push_back(static_cast<std::int32_t>(line.size()));
  }
  message->num_axis_points = static_cast<std::int32_t>(message->axis_x_m.size());
  message->num_axis_lines = static_cast<std::int32_t>(message->axis_line_points.size());
}

}  // namespace

cairn_lcm::perceived_place_t to_perceived_place(const PlaceVisit& perceived,
                                                std::int64_t visit,
                                                const PlaceOptions& options) {
  const PlacePerception perception = perceive(perceived, options);
  cairn_lcm::perceived_place_t message{};
  message.visit = visit;
  message.place_id = -1;
  message.entered_utime = utime_of(perceived.entered);
  message.left_utime = utime_of(perceived.left);
  message.arrival_gateway = perceived.arrival_gateway;
  message.departure_gateway = perceived.departure_gateway;
  put(perceived.T_place_robot_at_entry, message.entry_m_rad);
  put(perceived.T_place_robot_at_exit, message.exit_m_rad);
  message.distinctiveness_share = perceived.neighbourhood.distinctiveness;
  message.star = small_scale_text(perceived.neighbourhood.star, 0);
  for (const NumberedOpening& opening : perception.openings) {
    message.openings.push_back(to_opening(opening));
  }
  message.num_openings = static_cast<std::int32_t>(message.openings.size());
  for (const PathFragment& fragment : perceived.neighbourhood.fragments) {
    message.fragment_from.push_back(fragment.gateway);
    message.fragment_through.push_back(fragment.through);
  }
  message.num_fragments = static_cast<std::int32_t>(message.fragment_from.size());
  put_axis(perception.axis, &message);
  put(perception.looked_at, &message);
  return message;
}

}  // namespace cairn
