#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

#include "exact_search/search_cost.hpp"

namespace cairn {

/// The nodes that a best-first search has not looked at: least cost first, then deepest, then
/// latest. Adding and taking cost a look-up among the different costs that wait.
class OpenList {
 public:
  struct Entry {
    SearchCost cost;
    int depth = 0;
    std::int32_t node = 0;
  };

  /// Cost and depth are those of the list in which a node waits.
  static constexpr std::size_t kBytesPerNode = sizeof(std::int32_t);

  void add(const Entry& entry);
  /// @pre !is_empty()
  Entry take();
  [[nodiscard]] bool is_empty() const { return size_ == 0; }
  [[nodiscard]] std::int64_t size() const { return size_; }

 private:
  struct Level {
    std::vector<std::vector<std::int32_t>> by_depth;
    std::size_t end = 0;  ///< Nothing waits at this depth or deeper.
  };

  std::map<SearchCost, Level> levels_;
  std::int64_t size_ = 0;
};

}  // namespace cairn
