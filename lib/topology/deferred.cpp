#include "topology/deferred.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

#include "base/check.hpp"

namespace cairn {

bool comes_before(const Rank& a, const Rank& b, Preference preference) {
  const auto simplicity = [](const Rank& rank) {
    return std::tuple(rank.contradictions, rank.path_count, rank.place_count);
  };
  if (preference == Preference::kPosterior) {
    return std::tuple(-a.log_posterior, simplicity(a), a.age) <
           std::tuple(-b.log_posterior, simplicity(b), b.age);
  }
  return std::tuple(simplicity(a), -a.log_posterior, a.age) <
         std::tuple(simplicity(b), -b.log_posterior, b.age);
}

bool DeferredLeaves::is_worse(const Waiting& a, const Waiting& b) const {
  return comes_before(b.rank, a.rank, preference_);
}

void DeferredLeaves::add(const Leaf& leaf, const Rank& rank) {
  waiting_.push_back({leaf, rank});
  count_ += leaf.count();
  std::push_heap(waiting_.begin(), waiting_.end(),
                 [&](const Waiting& a, const Waiting& b) { return is_worse(a, b); });
}

Leaf DeferredLeaves::take_best() {
  CAIRN_CHECK(!waiting_.empty());
  std::pop_heap(waiting_.begin(), waiting_.end(),
                [&](const Waiting& a, const Waiting& b) { return is_worse(a, b); });
  const Leaf best = waiting_.back().leaf;
  waiting_.pop_back();
  count_ -= best.count();
  return best;
}

std::vector<Leaf> DeferredLeaves::take_worst_half() {
  const auto kept = static_cast<std::ptrdiff_t>(waiting_.size() / 2);
  std::nth_element(waiting_.begin(), waiting_.begin() + kept, waiting_.end(),
                   [&](const Waiting& a, const Waiting& b) { return is_worse(b, a); });
  std::vector<Leaf> worst;
  for (auto next = waiting_.begin() + kept; next != waiting_.end(); ++next) {
    worst.push_back(next->leaf);
    count_ -= next->leaf.count();
  }
  waiting_.erase(waiting_.begin() + kept, waiting_.end());
  waiting_.shrink_to_fit();
  std::make_heap(waiting_.begin(), waiting_.end(),
                 [&](const Waiting& a, const Waiting& b) { return is_worse(a, b); });
  return worst;
}

std::vector<Leaf> DeferredLeaves::take_all() {
  std::vector<Leaf> all;
  count_ = 0;
  for (const Waiting& one : std::exchange(waiting_, {})) {
    all.push_back(one.leaf);
  }
  return all;
}

}  // namespace cairn
