#include "grid/clearance_order.hpp"

#include <algorithm>

namespace cairn {

std::vector<std::size_t> cells_by_clearance(const DistanceTransform& distances,
                                            const CellMask& set) {
  const std::vector<std::int32_t>& squared = distances.squared_clearances_cells();
  CAIRN_CHECK(set.cells.size() == squared.size());
  std::int32_t most = 0;
  for (const std::int32_t value : squared) {
    most = value == DistanceTransform::kUnbounded ? most : std::max(most, value);
  }
  // A counting sort; what nothing bounds comes last, in a bucket of its own.
  const auto bucket_of = [&](std::size_t index) {
    return static_cast<std::size_t>(std::min(squared[index], most + 1));
  };
  std::vector<std::size_t> end(static_cast<std::size_t>(most) + 3);
  for (std::size_t i = 0; i < squared.size(); ++i) {
    end[bucket_of(i) + 1] += set.cells[i] != 0 ? 1U : 0U;
  }
  for (std::size_t bucket = 1; bucket < end.size(); ++bucket) {
    end[bucket] += end[bucket - 1];
  }
  std::vector<std::size_t> order(end.back());
  for (std::size_t i = 0; i < squared.size(); ++i) {
    if (set.cells[i] != 0) {
      order[end[bucket_of(i)]++] = i;
    }
  }
  return order;
}

}  // namespace cairn
