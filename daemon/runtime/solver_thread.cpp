#include "runtime/solver_thread.hpp"

#include <utility>

#include "runtime/planner.hpp"

namespace cairn {

SolverThread::SolverThread(const TrajectoryRefinementOptions& refinement,
                           const GlobalMapOptions& map_options,
                           const PathOptions& path_options,
                           const Wakeup& wakeup)
    : map_refiner_(refinement),
      map_maker_(map_options),
      path_options_(path_options),
      wakeup_(wakeup),
      orders_(kMaxWaiting),
      outcomes_(4 * kMaxWaiting),
      thread_([this] { run(); }) {}

SolverThread::~SolverThread() {
  stop();
}

void SolverThread::stop() {
  orders_.close();
  if (thread_.joinable()) {
    thread_.join();
  }
}

void SolverThread::run() {
  while (const auto order = orders_.pop()) {
    outcomes_.push(std::visit([this](const auto& one) { return carry_out(one); }, *order));
    wakeup_.signal();
  }
}

SolverThread::Outcome SolverThread::carry_out(const DrawOrder& order) {
  Drawing drawing;
  drawing.state = map_refiner_.refined(order.state);
  drawing.changed = map_maker_.draw(*drawing.state);
  if (order.with_documents) {
    drawing.documents = map_maker_.documents(*drawing.state, order.sender);
  }
  drawn_ = drawing.state;
  return drawing;
}

SolverThread::Outcome SolverThread::carry_out(const PlanOrder& order) {
  if (drawn_ == nullptr) {
    return refusal(order.request.header, order.sender, cairn_lcm::result_t::NOT_FOUND,
                   "there is no map yet");
  }
  return answer(order.request, *drawn_, map_maker_.map(), path_options_, order.sender);
}

}  // namespace cairn
