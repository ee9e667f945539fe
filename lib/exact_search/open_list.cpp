#include "exact_search/open_list.hpp"

#include <algorithm>

namespace cairn {

void OpenList::add(const Entry& entry) {
  Level& level = levels_[entry.cost];
  const auto depth = static_cast<std::size_t>(entry.depth);
  if (level.by_depth.size() <= depth) {
    level.by_depth.resize(depth + 1);
  }
  level.by_depth[depth].push_back(entry.node);
  level.end = std::max(level.end, depth + 1);
  ++size_;
}

OpenList::Entry OpenList::take() {
  const auto least = levels_.begin();
  Level& level = least->second;
  std::vector<std::int32_t>& deepest = level.by_depth[level.end - 1];
  const Entry entry{least->first, static_cast<int>(level.end) - 1, deepest.back()};
  deepest.pop_back();
  while (level.end > 0 && level.by_depth[level.end - 1].empty()) {
    --level.end;
  }
  if (level.end == 0) {
    levels_.erase(least);
  }
  --size_;
  return entry;
}

}  // namespace cairn
