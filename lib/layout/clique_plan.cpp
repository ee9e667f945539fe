#include "layout/clique_plan.hpp"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <iterator>
#include <queue>

namespace cairn {
namespace {

std::size_t at(int index) {
  return static_cast<std::size_t>(index);
}

/// The graph while places are taken out of it.
class Elimination {
 public:
  Elimination(std::vector<std::vector<int>> neighbors, const std::vector<char>& comes_last)
      : neighbors_(std::move(neighbors)),
        comes_last_(comes_last),
        height_(neighbors_.size(), 0),
        is_gone_(neighbors_.size(), 0) {
    for (std::size_t place = 0; place < neighbors_.size(); ++place) {
      open_.push(key_of(static_cast<int>(place)));
    }
  }

  /// Takes out all places; afterwards neighbors() are those left when a place went.
  std::vector<int> run() {
    std::vector<int> order;
    order.reserve(neighbors_.size());
    while (!open_.empty()) {
      const std::uint64_t key = open_.top();
      open_.pop();
      const int place = static_cast<int>(key & kMask);
      if (is_gone_[at(place)] == 0 && key == key_of(place)) {
        take_out(place);
        order.push_back(place);
      }
    }
    return order;
  }

  [[nodiscard]] const std::vector<std::vector<int>>& neighbors() const { return neighbors_; }

 private:
  static constexpr int kBits = 20;
  static constexpr std::uint64_t kMask = (1U << kBits) - 1U;

  /// Degrees below two are as good as two: else a chain would be taken up from its end.
  [[nodiscard]] std::uint64_t key_of(int place) const {
    const std::uint64_t degree = std::max<std::size_t>(neighbors_[at(place)].size(), 2);
    const auto height = static_cast<std::uint64_t>(height_[at(place)]);
    const std::uint64_t group = comes_last_[at(place)] != 0 ? 1 : 0;
    return (((group << kBits | degree) << kBits | height) << kBits) |
           static_cast<std::uint64_t>(place);
  }

  void take_out(int place) {
    is_gone_[at(place)] = 1;
    const std::vector<int>& left = neighbors_[at(place)];
    for (const int neighbor : left) {
      std::vector<int>& mine = neighbors_[at(neighbor)];
      merged_.clear();
      std::set_union(mine.begin(), mine.end(), left.begin(), left.end(),
                     std::back_inserter(merged_));
      mine.clear();
      std::copy_if(merged_.begin(), merged_.end(), std::back_inserter(mine),
                   [&](int other) { return other != neighbor && other != place; });
      height_[at(neighbor)] = std::max(height_[at(neighbor)], height_[at(place)] + 1);
      open_.push(key_of(neighbor));
    }
  }

  std::vector<std::vector<int>> neighbors_;
  const std::vector<char>& comes_last_;
  std::vector<int> height_;
  std::vector<char> is_gone_;
  std::vector<int> merged_;
  std::priority_queue<std::uint64_t, std::vector<std::uint64_t>, std::greater<>> open_;
};

/// A clique that takes up places from the last to the first.
struct Growing {
  std::vector<int> eliminated;  ///< The last first.
  std::vector<int> left;
  int parent = -1;
};

}  // namespace

std::vector<CliqueShape> plan_cliques(std::vector<std::vector<int>> neighbors,
                                      const std::vector<char>& comes_last) {
  Elimination elimination(std::move(neighbors), comes_last);
  const std::vector<int> order = elimination.run();
  std::vector<int> position(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    position[at(order[i])] = static_cast<int>(i);
  }
  const auto is_earlier = [&](int a, int b) { return position[at(a)] < position[at(b)]; };
  std::vector<Growing> grown;  // From the roots down.
  std::vector<int> grown_of(order.size(), -1);
  for (auto place = order.rbegin(); place != order.rend(); ++place) {
    std::vector<int> left = elimination.neighbors()[at(*place)];
    std::sort(left.begin(), left.end(), is_earlier);
    const int parent = left.empty() ? -1 : grown_of[at(left.front())];
    if (parent >= 0 && grown[at(parent)].eliminated.back() == left.front() &&
        grown[at(parent)].eliminated.size() + grown[at(parent)].left.size() == left.size()) {
      grown[at(parent)].eliminated.push_back(*place);
      grown_of[at(*place)] = parent;
    } else {
      grown_of[at(*place)] = static_cast<int>(grown.size());
      grown.push_back({{*place}, std::move(left), parent});
    }
  }
  std::vector<CliqueShape> shapes;
  shapes.reserve(grown.size());
  for (auto clique = grown.rbegin(); clique != grown.rend(); ++clique) {
    std::vector<int> places(clique->eliminated.rbegin(), clique->eliminated.rend());
    places.insert(places.end(), clique->left.begin(), clique->left.end());
    const int parent =
        clique->parent < 0 ? -1 : static_cast<int>(grown.size()) - 1 - clique->parent;
    shapes.push_back({std::move(places), static_cast<int>(clique->eliminated.size()), parent});
  }
  return shapes;
}

}  // namespace cairn
