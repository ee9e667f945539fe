#include "runtime/hypothesis_drawer.hpp"

#include <utility>

#include <cairn_lcm/hypothesis_map_t.hpp>

#include "runtime/map_maker.hpp"
#include "service/refined_map.hpp"
#include "wire/document.hpp"
#include "wire/signatures.hpp"

namespace cairn {

HypothesisDrawing draw_hypothesis(const HypothesisOrder& order,
                                  const TrajectoryRefinementOptions& refinement,
                                  const GlobalMapOptions& map_options) {
  const std::shared_ptr<const MapState> state = MapRefiner(refinement).refined(order.state);
  MapMaker map_maker(map_options);
  map_maker.draw(*state);
  cairn_lcm::hypothesis_map_t message{};
  message.utime = utime_of(state->time);
  message.boot_id = order.sender.boot_id;
  message.map_id = order.sender.map_id;
  message.revision = state->topology_revision;
  message.hypothesis_id = state->hypothesis;
  message.topology = to_topology(*state, order.sender);
  message.global_map = map_maker.grid_map(order.sender);
  message.trajectory = to_trajectory(*state, order.sender);
  message.visits = to_visit_places(*state, order.sender);
  return {message.hypothesis_id, {message.map_id, message.revision, wire::to_document(message)}};
}

HypothesisDrawer::HypothesisDrawer(const TrajectoryRefinementOptions& refinement,
                                   const GlobalMapOptions& map_options,
                                   const Wakeup& wakeup)
    : refinement_(refinement),
      map_options_(map_options),
      wakeup_(wakeup),
      orders_(1),
      drawings_(2),
      thread_([this] { run(); }) {}

HypothesisDrawer::~HypothesisDrawer() {
  orders_.close();
  thread_.join();
}

void HypothesisDrawer::run() {
  while (const std::optional<HypothesisOrder> order = orders_.pop()) {
    drawings_.push(draw_hypothesis(*order, refinement_, map_options_));
    wakeup_.signal();
  }
}

}  // namespace cairn
