#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <thread>

#include "global_map/global_map.hpp"
#include "refinement/trajectory_refiner.hpp"
#include "runtime/bounded_queue.hpp"
#include "runtime/wakeup.hpp"
#include "service/map_state.hpp"
#include "transport/map_messages.hpp"
#include "wire/replication_server.hpp"

namespace cairn {

/// The map of one live hypothesis to be drawn. The state is immutable.
struct HypothesisOrder {
  std::shared_ptr<const MapState> state;  ///< As of MappingService::state_of. Not null.
  Sender sender;
};

/// The same drawn: a hypothesis_map_t.
struct HypothesisDrawing {
  std::int64_t hypothesis_id = -1;
  wire::Document document;
};

/// Refines and draws one hypothesis from nothing, as the best map is: of the same state the same
/// picture, and the tiles of a map that is drawn afresh.
/// @pre both options are valid
[[nodiscard]] HypothesisDrawing draw_hypothesis(const HypothesisOrder& order,
                                                const TrajectoryRefinementOptions& refinement,
                                                const GlobalMapOptions& map_options);

/// The thread that draws maps of single hypotheses on request. Apart from the solver thread, so
/// that the best map does not wait for it; what it used is given back after each.
class HypothesisDrawer {
 public:
  /// @param wakeup is signalled for every drawing; must outlive this object
  HypothesisDrawer(const TrajectoryRefinementOptions& refinement,
                   const GlobalMapOptions& map_options,
                   const Wakeup& wakeup);
  /// Waits for the drawing that is under way.
  ~HypothesisDrawer();
  HypothesisDrawer(const HypothesisDrawer&) = delete;
  HypothesisDrawer& operator=(const HypothesisDrawer&) = delete;
  HypothesisDrawer(HypothesisDrawer&&) = delete;
  HypothesisDrawer& operator=(HypothesisDrawer&&) = delete;

  /// One waits at most, besides the one under way: a later one takes its place.
  void order(HypothesisOrder order) { orders_.push(std::move(order)); }
  [[nodiscard]] std::optional<HypothesisDrawing> next_drawing() { return drawings_.try_pop(); }

 private:
  void run();

  TrajectoryRefinementOptions refinement_;
  GlobalMapOptions map_options_;
  const Wakeup& wakeup_;
  BoundedQueue<HypothesisOrder> orders_;
  BoundedQueue<HypothesisDrawing> drawings_;
  std::thread thread_;
};

}  // namespace cairn
