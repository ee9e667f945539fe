#include "layout/place_covariances.hpp"

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include "base/check.hpp"

namespace cairn {
namespace {

using Triplets = std::vector<Eigen::Triplet<double>>;

/// Adds a block to the lower triangle; place 0 has no rows.
void add_block(int row, int column, const Matrix3d& block, Triplets* lower) {
  if (row < 1 || column < 1) {
    return;
  }
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) {
      if (3 * row + r >= 3 * column + c) {
        lower->emplace_back(3 * row - 3 + r, 3 * column - 3 + c, block(r, c));
      }
    }
  }
}

}  // namespace

std::vector<Matrix3d> place_covariances(const PlaceVector& places,
                                        const std::vector<TravelResidual>& travels) {
  std::vector<Matrix3d> covariances(places.size(), Matrix3d::Zero());
  Triplets lower;
  for (const TravelResidual& travel : travels) {
    if (travel.from == travel.to) {
      continue;
    }
    Matrix3d by_from;
    Matrix3d by_to;
    static_cast<void>(travel.at(places[static_cast<std::size_t>(travel.from)],
                                places[static_cast<std::size_t>(travel.to)], &by_from, &by_to));
    add_block(travel.from, travel.from, by_from.transpose() * by_from, &lower);
    add_block(travel.to, travel.to, by_to.transpose() * by_to, &lower);
    add_block(travel.from, travel.to, by_from.transpose() * by_to, &lower);
    add_block(travel.to, travel.from, by_to.transpose() * by_from, &lower);
  }
  const int dimension = 3 * (static_cast<int>(places.size()) - 1);
  Eigen::SparseMatrix<double> information(dimension, dimension);
  information.setFromTriplets(lower.begin(), lower.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower> solver(information);
  CAIRN_CHECK(solver.info() == Eigen::Success);
  Eigen::MatrixXd unit = Eigen::MatrixXd::Zero(dimension, 3);
  for (int row = 0; row < dimension; row += 3) {
    unit.middleRows<3>(row).setIdentity();
    const Matrix3d block = solver.solve(unit).middleRows<3>(row);
    unit.middleRows<3>(row).setZero();
    covariances[static_cast<std::size_t>(row / 3 + 1)] = 0.5 * (block + block.transpose());
  }
  return covariances;
}

}  // namespace cairn
