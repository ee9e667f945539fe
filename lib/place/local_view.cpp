#include "place/local_view.hpp"

#include "place/axis_sites.hpp"

namespace cairn {

LocalView LocalViewer::look_around(const OccupancyGrid& grid,
                                   const Vector2d& p_grid_robot,
                                   const PlaceOptions& options,
                                   double min_turn_rad) {
  states_.take(grid, p_grid_robot, options);
  distances_.update(states_.grid(), states_.moved());
  LocalView view{states_.grid(), distances_.distances(), states_.is_wall()};
  const GridGeometry& map = grid.geometry();
  view.p_map_low = map.origin_m;
  view.p_map_high = map.origin_m + map.cell_m * Vector2d(map.width, map.height);
  view.robot = view.grid.geometry().cell_at(p_grid_robot);
  MedialAxisOptions axis_options;
  axis_options.min_clearance_m = 0.5 * options.robot_width_m;
  axis_options.coastal_distance_m = options.coastal_distance_m;
  view.axis = with_corner_nodes(
      axis_.next(view.distances, distances_.changed(), states_.moved(), view.robot, axis_options),
      view.grid.geometry().cell_m, min_turn_rad);
  view.profiles = edge_profiles(view);
  return view;
}

}  // namespace cairn
