#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <thread>
#include <variant>

#include <cairn_lcm/plan_request_t.hpp>
#include <cairn_lcm/plan_t.hpp>

#include "planning/path.hpp"
#include "runtime/bounded_queue.hpp"
#include "runtime/map_maker.hpp"
#include "runtime/wakeup.hpp"
#include "service/refined_map.hpp"

namespace cairn {

/// The global map after one drawing.
struct Drawing {
  std::shared_ptr<const MapState> state;  ///< What was drawn, refined.
  std::map<wire::TileIndex, wire::TileCells> changed;
  std::optional<Documents> documents;  ///< Where they were asked for.
};

/// Work for the solver thread. The state is immutable.
struct DrawOrder {
  std::shared_ptr<const MapState> state;
  Sender sender;
  bool with_documents = false;
};
struct PlanOrder {
  cairn_lcm::plan_request_t request;
  Sender sender;
};

/// The thread that refines the trajectory, draws the global map and plans ways on it, from
/// immutable pictures of the map, so that neither large maps nor many clients ever delay a scan.
class SolverThread {
 public:
  using Outcome = std::variant<Drawing, cairn_lcm::plan_t>;
  static constexpr std::size_t kMaxWaiting = 10;

  /// @param wakeup is signalled for every outcome; must outlive this object
  SolverThread(const TrajectoryRefinementOptions& refinement,
               const GlobalMapOptions& map_options,
               const PathOptions& path_options,
               const Wakeup& wakeup);
  ~SolverThread();
  SolverThread(const SolverThread&) = delete;
  SolverThread& operator=(const SolverThread&) = delete;
  SolverThread(SolverThread&&) = delete;
  SolverThread& operator=(SolverThread&&) = delete;

  /// The caller keeps no more than kMaxWaiting orders waiting; older ones would be lost.
  void order(std::variant<DrawOrder, PlanOrder> order) { orders_.push(std::move(order)); }
  [[nodiscard]] std::optional<Outcome> next_outcome() { return outcomes_.try_pop(); }
  [[nodiscard]] std::size_t waiting() const { return orders_.size(); }

  /// Ends the thread after what waits.
  void stop();

 private:
  void run();
  Outcome carry_out(const DrawOrder& order);
  Outcome carry_out(const PlanOrder& order);

  MapRefiner map_refiner_;
  MapMaker map_maker_;
  PathOptions path_options_;
  const Wakeup& wakeup_;
  std::shared_ptr<const MapState> drawn_;  ///< What the map shows.
  BoundedQueue<std::variant<DrawOrder, PlanOrder>> orders_;
  BoundedQueue<Outcome> outcomes_;
  std::thread thread_;
};

}  // namespace cairn
