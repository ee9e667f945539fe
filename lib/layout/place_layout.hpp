#pragma once

#include <vector>

#include "base/result.hpp"
#include "geometry/gaussian_pose.hpp"

namespace cairn {

/// What one travel says of the layout: the displacement lambda between two places.
struct TravelConstraint {
  int from = 0;            ///< Place of departure, 0 .. place_count - 1.
  int to = 0;              ///< Place of arrival; may equal `from` where a loop path was travelled.
  GaussianPose T_from_to;  ///< Covariance of (x, y, theta) in the frame of `from`.
};

/// Tuning of the place layout. In the configuration file: the object "layout".
struct LayoutOptions {
  int max_iterations = 100;  ///< Of the non-linear solver. [1, 10000]
  /// Travels whose residual is longer than this many standard deviations count less (Huber). 0 is
  /// plain least squares. [0, 1000]
  double outlier_sigmas = 0.0;
  bool covariances = false;  ///< Whether to compute the covariance of every place.
};

/// Names every field that is out of range, with its value.
[[nodiscard]] Status validate(const LayoutOptions& options);

/// Where the places lie in the global frame: the mode of G(chi). The frame is that of place 0.
struct PlaceLayout {
  std::vector<Pose2> T_global_place;  ///< chi, by place.
  /// Sum of the squared Mahalanobis lengths of all travels' residuals, without the outlier loss.
  double chi2 = 0.0;
  /// Logarithm of the density of all displacements at this layout:
  ///
  ///     -chi2 / 2  -  sum over travels of log det(2 pi covariance) / 2
  ///
  /// Comparable between layouts of the same travels, whatever their places. It is the likelihood at
  /// the mode: it is not integrated over the layouts.
  double log_likelihood = 0.0;
  std::vector<double> chi2_of_travel;  ///< In the order of the constraints; 3 degrees of freedom.
  /// Of (x, y, theta) of each place in the global frame, relative to place 0, whose own is zero.
  /// Empty unless asked for.
  std::vector<Matrix3d> covariances;
  int iterations = 0;  ///< Of the non-linear solver.
};

/// The most likely layout of places under the displacements of all travels.
///
/// Modayil et al. climb a hill from corrected odometry and name the EKF; here the mode is found by
/// sparse non-linear least squares, which needs no approximation of large heading errors. Residuals
/// are whitened by the square root of the information, headings live on the circle, place 0 is the
/// origin of the global frame. The start is linear: all headings from the chordal relaxation, then
/// all positions; so no drift leads astray. Gauss-Newton steps follow, and Ceres where these do not
/// descend. Deterministic, one thread.
///
/// @param previous an earlier layout of the first places, as the start instead: for adding travels
///     to a map. Ignored where it is null, has no or more places, or is not finite. Places beyond
///     it are chained on.
///
/// Errors: kInvalidValue for options, indices or covariances out of range; kContradiction where a
/// place cannot be reached from place 0 through the travels (names the place); kNotConverged.
///
/// Source: Modayil, Beeson and Kuipers, IROS 2004, Sec. IV-D, Eq. (15): G(chi).
[[nodiscard]] Result<PlaceLayout> solve_layout(int place_count,
                                               const std::vector<TravelConstraint>& travels,
                                               const LayoutOptions& options = {},
                                               const PlaceLayout* previous = nullptr);

}  // namespace cairn
