#include "layout/elimination_order.hpp"

#include <algorithm>

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>

namespace cairn {

std::vector<int> elimination_order(int place_count, const std::vector<TravelConstraint>& travels) {
  std::vector<Eigen::Triplet<double>> lower;
  lower.reserve(static_cast<std::size_t>(place_count) + travels.size());
  for (int place = 1; place < place_count; ++place) {
    lower.emplace_back(place - 1, place - 1, 1.0);
  }
  for (const TravelConstraint& travel : travels) {
    const auto [low, high] = std::minmax(travel.from, travel.to);
    if (low > 0 && low != high) {
      lower.emplace_back(high - 1, low - 1, 1.0);
    }
  }
  Eigen::SparseMatrix<double> graph(place_count - 1, place_count - 1);
  graph.setFromTriplets(lower.begin(), lower.end());
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> place_at;
  Eigen::AMDOrdering<int>()(graph.selfadjointView<Eigen::Lower>(), place_at);
  std::vector<int> number(static_cast<std::size_t>(place_count), 0);
  for (int position = 0; position + 1 < place_count; ++position) {
    number[static_cast<std::size_t>(place_at.indices()[position]) + 1] = position + 1;
  }
  return number;
}

}  // namespace cairn
