#pragma once

#include <array>
#include <vector>

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include "layout/travel_residual.hpp"

namespace cairn {

/// The sum of squares of a place layout to second order about given places, and its Gauss-Newton
/// step. The sparse pattern is found once; place 0 is held. Part of the place
/// layout; not for other layers.
class NormalEquations {
 public:
  /// @param travels must outlive this object
  /// @pre at least two places, all of them joined by travels, and numbered by elimination_order (or
  ///     it takes longer)
  NormalEquations(int place_count, const std::vector<TravelResidual>& travels);

  /// Expands about these places. Beyond so many standard deviations a residual counts less, as by
  /// Huber's loss; 0 is plain least squares.
  /// @return whether the sum has curvature in every direction
  [[nodiscard]] bool expand_about(const PlaceVector& places, double outlier_sigmas);

  /// From the places of the expansion to its least, x, y, theta by place but 0.
  /// @pre expand_about was true
  [[nodiscard]] Eigen::VectorXd step() const;

  /// By how much the expansion falls along a step: what the sum of squares would lose if it were
  /// quadratic.
  [[nodiscard]] double predicted_gain(const Eigen::VectorXd& step) const;

  /// The covariance of every place: the diagonal blocks of the inverse curvature.
  /// @pre expand_about was true
  [[nodiscard]] std::vector<Matrix3d> place_covariances() const;

  /// The covariance of a whitened residual as all travels together predict it.
  /// @param travel between two of the places, not a loop at one
  /// @param places of the expansion
  /// @pre expand_about was true
  [[nodiscard]] Matrix3d covariance_of_prediction(const TravelResidual& travel,
                                                  const PlaceVector& places) const;

 private:
  /// Where the three columns of a block of the matrix begin among its values.
  using BlockColumns = std::array<int, 3>;

  void find_blocks();
  void add_to_diagonal(int place, const Matrix3d& block);
  void add_below_diagonal(const BlockColumns& columns, const Matrix3d& block);

  const std::vector<TravelResidual>& travels_;
  Eigen::SparseMatrix<double> curvature_;   ///< Lower triangle.
  Eigen::VectorXd descent_;                 ///< Minus half the gradient.
  std::vector<BlockColumns> diagonal_;      ///< By place but 0.
  std::vector<BlockColumns> off_diagonal_;  ///< By travel; unused where it touches place 0.
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower, Eigen::NaturalOrdering<int>>
      solver_;
};

/// The places after a share of a step.
[[nodiscard]] PlaceVector moved(const PlaceVector& places,
                                const Eigen::VectorXd& step,
                                double share);

/// The sum of squares, under Huber's loss where `outlier_sigmas` is not 0.
[[nodiscard]] double cost_of(const PlaceVector& places,
                             const std::vector<TravelResidual>& travels,
                             double outlier_sigmas);

}  // namespace cairn
