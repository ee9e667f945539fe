#pragma once

#include <optional>
#include <vector>

#include <cairn_lcm/perceived_place_t.hpp>
#include <cairn_lcm/topology_t.hpp>
#include <cairn_lcm/trajectory_t.hpp>

#include "clients/common/canvas.hpp"
#include "clients/common/raster.hpp"

namespace cairn::clients {

/// What is drawn over each other, from below. What is not there is left out.
struct MapLayers {
  std::optional<Raster> grid;
  std::optional<cairn_lcm::topology_t> topology;
  std::optional<cairn_lcm::trajectory_t> trajectory;
  /// What was seen of places, each at the visit that the map shows; drawn over the topology.
  std::vector<cairn_lcm::perceived_place_t> perceived;
};

/// The picture of a map: walls, paths in colours (dashed where a travel led one way only), places
/// with their ids, gateways as bars (dashed stubs where nobody knows where they lead), the robot's
/// way, and below it a scale bar and the key.
/// @param longest_side_pixels of the map itself, [64, 16384]
[[nodiscard]] Canvas draw_map(const MapLayers& layers, int longest_side_pixels);

class Viewport;

/// Draws what was seen of a place where the map has it: the medial axis, the path fragments as
/// curves, openings that are no gateways of the map, and the numbers and widths of those that are.
/// Nothing of a visit whose frame is not that of the place. Throws Failure(kBadData) for a message
/// whose numbers do not fit together.
void draw_perceived(Canvas& canvas,
                    const Viewport& view,
                    const cairn_lcm::place_t& place,
                    const cairn_lcm::perceived_place_t& perceived);

/// Part of the global frame that is shown, and its scale.
class Viewport {
 public:
  /// Fits everything that is finite and within 1000 km of the origin, with a margin; of the grid
  /// the part that is more than stray beams.
  Viewport(const MapLayers& layers, int longest_side_pixels);

  [[nodiscard]] PixelPoint pixel(double x_m, double y_m) const {
    return {(x_m - left_m_) * pixels_per_m_, (top_m_ - y_m) * pixels_per_m_};
  }
  [[nodiscard]] double x_m(double pixel_x) const { return left_m_ + pixel_x / pixels_per_m_; }
  [[nodiscard]] double y_m(double pixel_y) const { return top_m_ - pixel_y / pixels_per_m_; }
  [[nodiscard]] double pixels_per_m() const { return pixels_per_m_; }
  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }

 private:
  double left_m_ = 0.0;
  double top_m_ = 0.0;
  double pixels_per_m_ = 1.0;
  int width_ = 0;
  int height_ = 0;
};

/// Length of a scale bar in metres: 1, 2 or 5 times a power of ten, at most that long.
[[nodiscard]] double scale_bar_m(double longest_m);

/// "20 m", "5 km", "10 cm".
[[nodiscard]] std::string length_text(double length_m);

/// Colours told apart by number; the same number is always the same colour.
[[nodiscard]] Colour path_colour(std::int64_t path_id);

inline constexpr Colour kPlaceColour{201, 62, 20};
inline constexpr Colour kGatewayColour{30, 130, 60};
inline constexpr Colour kPendingColour{200, 30, 120};
inline constexpr Colour kTrajectoryColour{95, 105, 120};
inline constexpr Colour kInkColour{40, 44, 52};

/// Length of the stub that shows a pending gateway.
inline constexpr double kStubM = 0.9;

/// The course of a path segment in the global frame: out of one place by its gateway, into the
/// other by its own. Empty if a place or a gateway is not in the map.
struct MapPoint {
  double x_m = 0.0;
  double y_m = 0.0;
};
[[nodiscard]] std::vector<MapPoint> course_of(const cairn_lcm::topology_t& topology,
                                              const cairn_lcm::segment_t& segment);

/// Path on which a segment lies: that of the gateway it leaves by; -1 where it is not in the map.
[[nodiscard]] std::int64_t path_of(const cairn_lcm::topology_t& topology,
                                   const cairn_lcm::segment_t& segment);

/// Nothing if there is no place of that id.
[[nodiscard]] const cairn_lcm::place_t* find_place(const cairn_lcm::topology_t& topology,
                                                   std::int64_t id);

}  // namespace cairn::clients
