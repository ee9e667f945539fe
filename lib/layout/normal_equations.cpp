#include "layout/normal_equations.hpp"

#include <algorithm>
#include <cmath>

namespace cairn {
namespace {

std::size_t at(int index) {
  return static_cast<std::size_t>(index);
}

/// Whether a travel joins two places that may both move.
bool is_between_free_places(const TravelResidual& travel) {
  return travel.from != travel.to && travel.from > 0 && travel.to > 0;
}

}  // namespace

NormalEquations::NormalEquations(int place_count, const std::vector<TravelResidual>& travels)
    : travels_(travels),
      curvature_(3 * (place_count - 1), 3 * (place_count - 1)),
      descent_(3 * (place_count - 1)),
      diagonal_(at(place_count)),
      off_diagonal_(travels.size()) {
  std::vector<Eigen::Triplet<double>> pattern;
  const auto add_block = [&](int row, int column) {
    for (int c = 0; c < 3; ++c) {
      for (int r = row == column ? c : 0; r < 3; ++r) {
        pattern.emplace_back(3 * row - 3 + r, 3 * column - 3 + c, 0.0);
      }
    }
  };
  for (int place = 1; place < place_count; ++place) {
    add_block(place, place);
  }
  for (const TravelResidual& travel : travels) {
    if (is_between_free_places(travel)) {
      add_block(std::max(travel.from, travel.to), std::min(travel.from, travel.to));
    }
  }
  curvature_.setFromTriplets(pattern.begin(), pattern.end());
  find_blocks();
  solver_.analyzePattern(curvature_);
}

/// Rows of a block follow one another within each column, as columns are sorted.
void NormalEquations::find_blocks() {
  const int* const outer = curvature_.outerIndexPtr();
  const int* const inner = curvature_.innerIndexPtr();
  const auto find = [&](int row, int column) {
    return static_cast<int>(
        std::lower_bound(inner + outer[column], inner + outer[column + 1], row) - inner);
  };
  for (int place = 1; place < static_cast<int>(diagonal_.size()); ++place) {
    for (int c = 0; c < 3; ++c) {
      diagonal_[at(place)][at(c)] = find(3 * place - 3 + c, 3 * place - 3 + c);
    }
  }
  for (std::size_t i = 0; i < travels_.size(); ++i) {
    if (is_between_free_places(travels_[i])) {
      const int row = 3 * std::max(travels_[i].from, travels_[i].to) - 3;
      const int column = 3 * std::min(travels_[i].from, travels_[i].to) - 3;
      off_diagonal_[i] = {find(row, column), find(row, column + 1), find(row, column + 2)};
    }
  }
}

void NormalEquations::add_to_diagonal(int place, const Matrix3d& block) {
  double* const values = curvature_.valuePtr();
  for (int c = 0; c < 3; ++c) {
    for (int r = c; r < 3; ++r) {
      values[diagonal_[at(place)][at(c)] + r - c] += block(r, c);
    }
  }
}

void NormalEquations::add_below_diagonal(const BlockColumns& columns, const Matrix3d& block) {
  double* const values = curvature_.valuePtr();
  for (int c = 0; c < 3; ++c) {
    for (int r = 0; r < 3; ++r) {
      values[columns[at(c)] + r] += block(r, c);
    }
  }
}

bool NormalEquations::expand_about(const PlaceVector& places, double outlier_sigmas) {
  std::fill_n(curvature_.valuePtr(), curvature_.nonZeros(), 0.0);
  descent_.setZero();
  for (std::size_t i = 0; i < travels_.size(); ++i) {
    const TravelResidual& travel = travels_[i];
    if (travel.from == travel.to) {
      continue;
    }
    Matrix3d by_from;
    Matrix3d by_to;
    const Eigen::Vector3d residual =
        travel.at(places[at(travel.from)], places[at(travel.to)], &by_from, &by_to);
    const double sigmas = residual.norm();
    const double weight =
        outlier_sigmas > 0.0 && sigmas > outlier_sigmas ? outlier_sigmas / sigmas : 1.0;
    if (travel.from > 0) {
      add_to_diagonal(travel.from, weight * by_from.transpose() * by_from);
      descent_.segment<3>(3 * travel.from - 3) -= weight * by_from.transpose() * residual;
    }
    if (travel.to > 0) {
      add_to_diagonal(travel.to, weight * by_to.transpose() * by_to);
      descent_.segment<3>(3 * travel.to - 3) -= weight * by_to.transpose() * residual;
    }
    if (is_between_free_places(travel)) {
      const bool from_is_row = travel.from > travel.to;
      add_below_diagonal(off_diagonal_[i], weight * (from_is_row ? by_from : by_to).transpose() *
                                               (from_is_row ? by_to : by_from));
    }
  }
  solver_.factorize(curvature_);
  return solver_.info() == Eigen::Success;
}

Eigen::VectorXd NormalEquations::step() const {
  return solver_.solve(descent_);
}

double NormalEquations::predicted_gain(const Eigen::VectorXd& step) const {
  return step.dot(descent_);
}

PlaceVector moved(const PlaceVector& places, const Eigen::VectorXd& step, double share) {
  PlaceVector after = places;
  for (std::size_t place = 1; place < after.size(); ++place) {
    after[place] += share * step.segment<3>(3 * static_cast<Eigen::Index>(place) - 3);
  }
  return after;
}

// Selected inversion (Takahashi, Fagan and Chin, 1973): the inverse where L has entries depends on
// the inverse where L has entries, from the last column to the first.
std::vector<Matrix3d> NormalEquations::place_covariances() const {
  const Eigen::SparseMatrix<double>& lower = solver_.matrixL().nestedExpression();
  const Eigen::VectorXd diagonal = solver_.vectorD();
  const Eigen::Index columns = lower.cols();
  const int* const begins = lower.outerIndexPtr();
  const int* const rows = lower.innerIndexPtr();
  const double* const factor = lower.valuePtr();
  std::vector<double> inverse(static_cast<std::size_t>(lower.nonZeros()));  // as L, below diagonal
  std::vector<double> inverse_diagonal(static_cast<std::size_t>(columns));
  std::vector<double> sums;
  for (Eigen::Index column = columns - 1; column >= 0; --column) {
    const int begin = begins[column];
    const int count = begins[column + 1] - begin;
    sums.assign(static_cast<std::size_t>(count), 0.0);
    for (int a = 0; a < count; ++a) {
      const auto at_a = static_cast<std::size_t>(a);
      const int row = rows[begin + a];
      sums[at_a] -= factor[begin + a] * inverse_diagonal[at(row)];
      // The rows after this one are among those of its column: walk along both.
      int other = begins[row];
      for (int b = a + 1; b < count; ++b) {
        while (rows[other] != rows[begin + b]) {
          ++other;
        }
        sums[at_a] -= factor[begin + b] * inverse[at(other)];
        sums[static_cast<std::size_t>(b)] -= factor[begin + a] * inverse[at(other)];
      }
    }
    double own = 1.0 / diagonal[column];
    for (int a = 0; a < count; ++a) {
      inverse[at(begin + a)] = sums[static_cast<std::size_t>(a)];
      own -= factor[begin + a] * sums[static_cast<std::size_t>(a)];
    }
    inverse_diagonal[static_cast<std::size_t>(column)] = own;
  }
  std::vector<Matrix3d> covariances(diagonal_.size(), Matrix3d::Zero());
  for (std::size_t place = 1; place < covariances.size(); ++place) {
    const int first = 3 * static_cast<int>(place) - 3;
    for (int k = 0; k < 3; ++k) {
      covariances[place](k, k) = inverse_diagonal[at(first + k)];
      // What follows the diagonal of a column in L are the rows of the same place.
      for (int m = k + 1; m < 3; ++m) {
        const double entry = inverse[at(begins[first + k] + m - k - 1)];
        covariances[place](k, m) = entry;
        covariances[place](m, k) = entry;
      }
    }
  }
  return covariances;
}

Matrix3d NormalEquations::covariance_of_prediction(const TravelResidual& travel,
                                                   const PlaceVector& places) const {
  Matrix3d by_from;
  Matrix3d by_to;
  static_cast<void>(travel.at(places[at(travel.from)], places[at(travel.to)], &by_from, &by_to));
  Eigen::MatrixXd gradients = Eigen::MatrixXd::Zero(descent_.size(), 3);
  const auto rows_of = [](int place) { return 3 * static_cast<Eigen::Index>(place) - 3; };
  if (travel.from > 0) {
    gradients.middleRows<3>(rows_of(travel.from)) = by_from.transpose();
  }
  if (travel.to > 0) {
    gradients.middleRows<3>(rows_of(travel.to)) = by_to.transpose();
  }
  const Eigen::MatrixXd moves = solver_.solve(gradients);
  Matrix3d covariance = Matrix3d::Zero();
  if (travel.from > 0) {
    covariance += by_from * moves.middleRows<3>(rows_of(travel.from));
  }
  if (travel.to > 0) {
    covariance += by_to * moves.middleRows<3>(rows_of(travel.to));
  }
  return covariance;
}

double cost_of(const PlaceVector& places,
               const std::vector<TravelResidual>& travels,
               double outlier_sigmas) {
  double cost = 0.0;
  for (const TravelResidual& travel : travels) {
    if (travel.from == travel.to) {
      continue;
    }
    const double squared = travel.at(places[at(travel.from)], places[at(travel.to)]).squaredNorm();
    const double sigmas = std::sqrt(squared);
    cost += outlier_sigmas > 0.0 && sigmas > outlier_sigmas
                ? outlier_sigmas * (2.0 * sigmas - outlier_sigmas)
                : squared;
  }
  return cost;
}

}  // namespace cairn
