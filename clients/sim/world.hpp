#pragma once

#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "clients/sim/floor_plan.hpp"
#include "clients/sim/geometry.hpp"

namespace cairn::sim {

/// A file of the user cannot be used; the text names file, line and what was expected.
class BadWorld : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A place of the drawing that has a name: mostly a junction.
struct NamedPoint {
  std::string name;
  Point at;
};

/// A walk with straight legs from point to point.
struct Tour {
  std::string name;
  std::vector<NamedPoint> waypoints;  ///< Two or more; neighbours differ.
};

/// A floor plan, its named points, and walks through it.
struct World {
  FloorPlan plan;
  std::vector<NamedPoint> junctions;
  std::vector<Tour> tours;
  std::optional<Pose> start;  ///< Absent: at the first waypoint, facing the second.
};

/// Distance that a tour's legs keep from every wall.
inline constexpr double kRobotRadius_m = 0.25;

/// Reads a drawn world. The text has lines of four kinds, and then the drawing:
///
///     ; a comment
///     cell_m 0.5              side of a cell; once, before the drawing
///     start A 90              where the robot stands and its heading in degrees, counterclockwise
///                             from +x; optional
///     tour loop A B C A       a walk with straight legs between named points; any number
///     map                     the rest of the file is the drawing, its top line has the largest y
///     ###########
///     #A.......B#             '#' wall, '.' free
///     #.#######.#             a letter or digit: a named point at the centre of its free cell
///     #D.......C#
///     ###########
///
/// All lines of a drawing have the same length. Every leg keeps kRobotRadius_m from all walls.
/// @param source name of the file, for messages
/// @throws BadWorld
[[nodiscard]] World parse_world(std::string_view text, const std::string& source);

/// Reads a file for parse_world.
/// @throws BadWorld
[[nodiscard]] World read_world(const std::filesystem::path& file);

/// Reads a floor plan from a PNG picture: white is free, everything else (walls, unknown) is wall.
/// The only tour, "tour", goes through the waypoints of a text file with one waypoint a line:
/// `x_m y_m [name]`, in metres from the lower left corner; '#' begins a comment. Waypoints with a
/// name become named points.
///
/// @param m_per_pixel side of a pixel, > 0
/// @throws BadWorld
[[nodiscard]] World read_floor_plan(const std::filesystem::path& picture,
                                    double m_per_pixel,
                                    const std::filesystem::path& tour_file);

/// The tour of that name; of a world with a single tour also for an empty name.
/// @throws BadWorld naming the tours there are
[[nodiscard]] const Tour& tour_named(const World& world, const std::string& name);

/// The tour's points, preceded by the world's start where the tour begins elsewhere.
[[nodiscard]] std::vector<Point> path_of(const World& world, const Tour& tour);

/// Where the robot stands before the tour.
[[nodiscard]] Pose start_of(const World& world, const Tour& tour);

/// Why a robot of radius kRobotRadius_m cannot drive the leg, or nothing.
[[nodiscard]] std::optional<std::string> obstacle_on(const FloorPlan& plan, Point from, Point to);

}  // namespace cairn::sim
