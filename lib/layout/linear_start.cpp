#include "layout/linear_start.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <optional>
#include <utility>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/OrderingMethods>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include "layout/travel_tree.hpp"

namespace cairn {
namespace {

using Complex = std::complex<double>;
template <typename T>
using Sparse = Eigen::SparseMatrix<T>;
template <typename T>
using Vector = Eigen::Matrix<T, Eigen::Dynamic, 1>;

/// Lower triangle of the normal equations of a sum of squares |to - from * step|^2 / variance and
/// the like: place 0 is known and goes to the right side. None where it is singular to rounding.
template <typename T>
std::optional<Vector<T>> solved(const std::vector<Eigen::Triplet<T>>& lower,
                                const Vector<T>& right) {
  Sparse<T> matrix(right.size(), right.size());
  matrix.setFromTriplets(lower.begin(), lower.end());
  Eigen::SimplicialLDLT<Sparse<T>, Eigen::Lower, Eigen::NaturalOrdering<int>> solver(matrix);
  if (solver.info() != Eigen::Success) {
    return std::nullopt;
  }
  Vector<T> solution = solver.solve(right);
  return solution.allFinite() ? std::optional(std::move(solution)) : std::nullopt;
}

/// Headings as complex numbers: minimises the sum of |h_to - h_from z|^2 / variance, h_0 = 1.
std::optional<std::vector<double>> chordal_headings(int place_count,
                                                    const std::vector<TravelConstraint>& travels) {
  std::vector<Eigen::Triplet<Complex>> lower;
  lower.reserve(3 * travels.size());
  Vector<Complex> right = Vector<Complex>::Zero(place_count - 1);
  for (const TravelConstraint& travel : travels) {
    if (travel.from == travel.to) {
      continue;
    }
    const double weight = 1.0 / travel.T_from_to.covariance(2, 2);
    const Complex turn = std::polar(weight, travel.T_from_to.mean.theta());
    const int i = travel.from - 1;
    const int j = travel.to - 1;
    if (i >= 0) {
      lower.emplace_back(i, i, weight);
    }
    if (j >= 0) {
      lower.emplace_back(j, j, weight);
    }
    if (i < 0) {
      right[j] += turn;
    } else if (j < 0) {
      right[i] += std::conj(turn);
    } else if (j > i) {
      lower.emplace_back(j, i, -turn);
    } else {
      lower.emplace_back(i, j, -std::conj(turn));
    }
  }
  const std::optional<Vector<Complex>> headings = solved<Complex>(lower, right);
  if (!headings) {
    return std::nullopt;
  }
  std::vector<double> headings_rad(static_cast<std::size_t>(place_count), 0.0);
  for (int place = 1; place < place_count; ++place) {
    headings_rad[static_cast<std::size_t>(place)] = std::arg((*headings)[place - 1]);
  }
  return headings_rad;
}

/// Adds a 2 x 2 block to the lower triangle of the positions' normal equations.
void add_block(int row,
               int column,
               const Eigen::Matrix2d& block,
               std::vector<Eigen::Triplet<double>>* lower) {
  for (int r = 0; r < 2; ++r) {
    for (int c = 0; c < 2; ++c) {
      if (2 * row + r >= 2 * column + c) {
        lower->emplace_back(2 * row + r, 2 * column + c, block(r, c));
      }
    }
  }
}

/// All places by the least uncertain ways from place 0.
PlaceVector chained(int place_count, const std::vector<TravelConstraint>& travels) {
  const TravelTree tree = least_uncertain_ways(place_count, travels, {0});
  std::vector<Pose2> T_first_place(static_cast<std::size_t>(place_count));
  for (const int place : tree.order) {
    const int parent = tree.parent[static_cast<std::size_t>(place)];
    if (parent >= 0) {
      T_first_place[static_cast<std::size_t>(place)] =
          T_first_place[static_cast<std::size_t>(parent)] *
          displacement_from_parent(tree, travels, place).mean;
    }
  }
  PlaceVector places;
  for (const Pose2& pose : T_first_place) {
    places.emplace_back(pose.x(), pose.y(), pose.theta());
  }
  return places;
}

/// All positions, with the headings as they are.
PlaceVector positions_for(const std::vector<double>& headings_rad,
                          const std::vector<TravelConstraint>& travels) {
  const int place_count = static_cast<int>(headings_rad.size());
  PlaceVector places(headings_rad.size(), Eigen::Vector3d::Zero());
  std::vector<Eigen::Triplet<double>> lower;
  lower.reserve(10 * travels.size());
  Vector<double> right = Vector<double>::Zero(2 * (place_count - 1));
  for (const TravelConstraint& travel : travels) {
    if (travel.from == travel.to) {
      continue;
    }
    const double heading_rad = headings_rad[static_cast<std::size_t>(travel.from)];
    const Eigen::Matrix2d rotation = Eigen::Rotation2Dd(heading_rad).toRotationMatrix();
    const Eigen::Matrix2d covariance =
        rotation * travel.T_from_to.covariance.topLeftCorner<2, 2>() * rotation.transpose();
    const Eigen::Matrix2d information = covariance.inverse();
    const Vector2d pull = information * (rotation * travel.T_from_to.mean.translation());
    const int i = travel.from - 1;
    const int j = travel.to - 1;
    if (i >= 0) {
      add_block(i, i, information, &lower);
      right.segment<2>(2 * i) -= pull;
    }
    if (j >= 0) {
      add_block(j, j, information, &lower);
      right.segment<2>(2 * j) += pull;
    }
    if (i >= 0 && j >= 0) {
      add_block(std::max(i, j), std::min(i, j), -information, &lower);
    }
  }
  const std::optional<Vector<double>> positions = solved<double>(lower, right);
  if (!positions) {
    return chained(place_count, travels);
  }
  for (int place = 1; place < place_count; ++place) {
    places[static_cast<std::size_t>(place)] << positions->segment<2>(2 * (place - 1)),
        headings_rad[static_cast<std::size_t>(place)];
  }
  return places;
}

}  // namespace

PlaceVector linear_start(int place_count, const std::vector<TravelConstraint>& travels) {
  PlaceVector places(static_cast<std::size_t>(place_count), Eigen::Vector3d::Zero());
  if (place_count < 2) {
    return places;
  }
  const std::optional<std::vector<double>> headings_rad = chordal_headings(place_count, travels);
  return headings_rad ? positions_for(*headings_rad, travels) : chained(place_count, travels);
}

}  // namespace cairn
