#include "layout/clique_tree.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "layout/clique_plan.hpp"

namespace cairn {
namespace {

std::size_t at(int index) {
  return static_cast<std::size_t>(index);
}

/// The graph of some places: a travel joins two, and a tree below joins all that it leaves over.
/// @param number by place, its number among `places`, or -1
std::vector<std::vector<int>> neighbors_of(const std::vector<int>& places,
                                           const std::vector<int>& number,
                                           const std::vector<CliquePtr>& below,
                                           const TravelGraph& graph) {
  std::vector<std::vector<int>> neighbors(places.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    graph.for_each_travel_of(places[i], [&](int index) {
      const TravelResidual& travel = graph.travel(index);
      neighbors[i].push_back(number[at(travel.from == places[i] ? travel.to : travel.from)]);
    });
  }
  for (const CliquePtr& tree : below) {
    for (std::size_t a = at(tree->eliminated); a < tree->places.size(); ++a) {
      std::vector<int>& list = neighbors[at(number[at(tree->places[a])])];
      std::transform(tree->places.begin() + tree->eliminated, tree->places.end(),
                     std::back_inserter(list), [&](int place) { return number[at(place)]; });
    }
  }
  for (std::size_t i = 0; i < places.size(); ++i) {
    std::vector<int>& list = neighbors[i];
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
    list.erase(std::remove_if(list.begin(), list.end(),
                              [&](int other) { return other < 0 || other == static_cast<int>(i); }),
               list.end());
  }
  return neighbors;
}

/// Also where it is not finite.
bool is_beyond(const Eigen::Vector3d& change, const StepTolerance& tolerance) {
  return !(change.head<2>().squaredNorm() <= tolerance.m * tolerance.m &&
           std::abs(change.z()) <= tolerance.rad);
}

}  // namespace

bool CliqueTree::take_up(const std::vector<int>& touched,
                         const LinearisedTravels& travels,
                         CliqueMaker* maker) {
  make_room(travels.about.size());
  for (const int place : touched) {
    if (is_known(place)) {
      mark_up(place);
    }
  }
  const std::vector<CliquePtr> marked = take_marked();
  return carry_out(plan(marked, touched, travels.graph), travels, maker);
}

bool CliqueTree::relinearise(const std::vector<int>& moved,
                             const LinearisedTravels& travels,
                             CliqueMaker* maker) {
  for (const int place : moved) {
    mark_up(place);
  }
  mark_down(moved);
  return carry_out(same_again(take_marked()), travels, maker);
}

void CliqueTree::make_room(std::size_t place_count) {
  head_of_.resize(place_count, -1);
  clique_of_.resize(place_count, nullptr);
  parent_of_.resize(place_count, -1);
  is_marked_.resize(place_count, 0);
  is_fresh_.resize(place_count, 0);
}

void CliqueTree::clear() {
  roots_.clear();
  std::fill(head_of_.begin(), head_of_.end(), -1);
}

bool CliqueTree::is_known(int place) const {
  return head_of_[at(place)] >= 0;
}

/// The clique that eliminates the place, and all above it.
void CliqueTree::mark_up(int place) {
  for (int head = head_of_[at(place)]; head >= 0 && is_marked_[at(head)] == 0;
       head = parent_of_[at(head)]) {
    is_marked_[at(head)] = 1;
  }
}

/// The cliques below that have one of the places left over.
void CliqueTree::mark_down(const std::vector<int>& moved) {
  std::vector<char> has_moved(head_of_.size(), 0);
  std::vector<const Clique*> open;
  for (const int place : moved) {
    has_moved[at(place)] = 1;
  }
  for (const int place : moved) {
    open.push_back(clique_of_[at(head_of_[at(place)])]);
  }
  std::vector<char> is_done(head_of_.size(), 0);
  while (!open.empty()) {
    const Clique& clique = *open.back();
    open.pop_back();
    if (std::exchange(is_done[at(clique.places.front())], 1) != 0) {
      continue;
    }
    for (const CliquePtr& child : clique.children) {
      const bool is_touched =
          std::any_of(child->places.begin() + child->eliminated, child->places.end(),
                      [&](int place) { return has_moved[at(place)] != 0; });
      if (is_touched) {
        is_marked_[at(child->places.front())] = 1;
        open.push_back(child.get());
      }
    }
  }
}

/// Takes the marked cliques off the tree, each before its children.
std::vector<CliquePtr> CliqueTree::take_marked() {
  std::vector<CliquePtr> marked;
  const auto is_marked = [&](const CliquePtr& clique) {
    return is_marked_[at(clique->places.front())] != 0;
  };
  const auto first_kept = std::stable_partition(roots_.begin(), roots_.end(), is_marked);
  marked.assign(roots_.begin(), first_kept);
  roots_.erase(roots_.begin(), first_kept);
  for (std::size_t i = 0; i < marked.size(); ++i) {
    const CliquePtr clique = marked[i];
    std::copy_if(clique->children.begin(), clique->children.end(), std::back_inserter(marked),
                 is_marked);
  }
  return marked;
}

/// What was marked and what is new, as one graph to be planned.
std::vector<CliqueTree::Task> CliqueTree::plan(const std::vector<CliquePtr>& marked,
                                               const std::vector<int>& touched,
                                               const TravelGraph& graph) const {
  std::vector<int> places;
  std::vector<CliquePtr> below;
  for (const CliquePtr& clique : marked) {
    places.insert(places.end(), clique->places.begin(),
                  clique->places.begin() + clique->eliminated);
    std::copy_if(
        clique->children.begin(), clique->children.end(), std::back_inserter(below),
        [&](const CliquePtr& child) { return is_marked_[at(child->places.front())] == 0; });
  }
  std::copy_if(touched.begin(), touched.end(), std::back_inserter(places),
               [&](int place) { return !is_known(place); });
  std::sort(places.begin(), places.end());
  std::vector<int> number(head_of_.size(), -1);
  for (std::size_t i = 0; i < places.size(); ++i) {
    number[at(places[i])] = static_cast<int>(i);
  }
  std::vector<char> comes_last(places.size(), 0);
  for (const int place : touched) {
    comes_last[at(number[at(place)])] = 1;
  }
  std::vector<Task> tasks;
  for (CliqueShape& shape : plan_cliques(neighbors_of(places, number, below, graph), comes_last)) {
    for (int& place : shape.places) {
      place = places[at(place)];
    }
    tasks.push_back({std::move(shape.places), shape.eliminated, shape.parent, {}});
  }
  hang_below(std::move(below), &tasks);
  return tasks;
}

/// Each tree goes below the clique that eliminates the first of what it leaves over.
void CliqueTree::hang_below(std::vector<CliquePtr> below, std::vector<Task>* tasks) const {
  std::vector<int> task_of(head_of_.size(), -1);
  std::vector<int> order(head_of_.size(), -1);
  int eliminated_before = 0;
  for (std::size_t task = 0; task < tasks->size(); ++task) {
    for (int slot = 0; slot < (*tasks)[task].eliminated; ++slot) {
      const int place = (*tasks)[task].places[at(slot)];
      task_of[at(place)] = static_cast<int>(task);
      order[at(place)] = eliminated_before++;
    }
  }
  for (CliquePtr& tree : below) {
    const int first = *std::min_element(tree->places.begin() + tree->eliminated, tree->places.end(),
                                        [&](int a, int b) { return order[at(a)] < order[at(b)]; });
    (*tasks)[at(task_of[at(first)])].children.push_back(std::move(tree));
  }
}

std::vector<CliqueTree::Task> CliqueTree::same_again(const std::vector<CliquePtr>& marked) const {
  std::vector<int> task_of(head_of_.size(), -1);
  std::vector<Task> tasks(marked.size());
  for (std::size_t i = 0; i < marked.size(); ++i) {
    const std::size_t task = marked.size() - 1 - i;
    const Clique& clique = *marked[i];
    task_of[at(clique.places.front())] = static_cast<int>(task);
    const int parent = parent_of_[at(clique.places.front())];
    tasks[task].places = clique.places;
    tasks[task].eliminated = clique.eliminated;
    tasks[task].parent = parent < 0 ? -1 : task_of[at(parent)];
    std::copy_if(
        clique.children.begin(), clique.children.end(), std::back_inserter(tasks[task].children),
        [&](const CliquePtr& child) { return is_marked_[at(child->places.front())] == 0; });
  }
  return tasks;
}

bool CliqueTree::carry_out(std::vector<Task> tasks,
                           const LinearisedTravels& travels,
                           CliqueMaker* maker) {
  std::fill(is_marked_.begin(), is_marked_.end(), 0);
  for (Task& task : tasks) {
    const int head = task.places.front();
    for (int slot = 0; slot < task.eliminated; ++slot) {
      head_of_[at(task.places[at(slot)])] = head;
    }
    for (const CliquePtr& child : task.children) {
      parent_of_[at(child->places.front())] = head;
    }
    parent_of_[at(head)] = -1;
    is_fresh_[at(head)] = 1;
    eliminated_count_ += task.eliminated;
    const CliquePtr clique =
        maker->make(std::move(task.places), task.eliminated, std::move(task.children), travels);
    if (clique == nullptr) {
      return false;
    }
    clique_of_[at(head)] = clique.get();
    (task.parent < 0 ? roots_ : tasks[at(task.parent)].children).push_back(clique);
  }
  return true;
}

std::vector<int> CliqueTree::solve(const std::vector<StepTolerance>& tolerances,
                                   PlaceVector* steps) {
  std::vector<int> changed;
  std::vector<char> has_changed(head_of_.size(), 0);
  std::vector<const Clique*> open;
  for (const CliquePtr& root : roots_) {
    open.push_back(root.get());
  }
  Eigen::VectorXd solved;
  while (!open.empty()) {
    const Clique& clique = *open.back();
    open.pop_back();
    const bool is_fresh = std::exchange(is_fresh_[at(clique.places.front())], 0) != 0;
    const bool is_touched =
        is_fresh || std::any_of(clique.places.begin() + clique.eliminated, clique.places.end(),
                                [&](int place) { return has_changed[at(place)] != 0; });
    if (!is_touched) {
      continue;
    }
    back_substitute(clique, *steps, &solved);
    for (int slot = 0; slot < clique.eliminated; ++slot) {
      const int place = clique.places[at(slot)];
      const Eigen::Vector3d step = solved.segment<3>(3 * slot);
      if (is_beyond(step - (*steps)[at(place)], tolerances[at(place)])) {
        (*steps)[at(place)] = step;
        has_changed[at(place)] = 1;
        changed.push_back(place);
      }
    }
    for (const CliquePtr& child : clique.children) {
      open.push_back(child.get());
    }
  }
  return changed;
}

}  // namespace cairn
