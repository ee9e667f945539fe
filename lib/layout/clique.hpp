#pragma once

#include <memory>
#include <vector>

#include <Eigen/Core>

#include "layout/travel_graph.hpp"

namespace cairn {

struct Clique;
/// Cliques never change once made, so that layouts with a common past share them.
using CliquePtr = std::shared_ptr<const Clique>;

/// Places eliminated together from the normal equations of a layout: a node of the tree of partial
/// factorisations. Part of the place layout; not for other layers.
///
/// Source: the Bayes tree of Kaess et al., iSAM2, IJRR 2012, Sec. 3; as a multifrontal Cholesky
/// factorisation that keeps its update matrices.
struct Clique {
  std::vector<int> places;  ///< Those eliminated, in their order, then those left over.
  int eliminated = 0;
  std::vector<CliquePtr> children;  ///< Eliminated before; what they left over is part of this.
  /// Numbers of all three below, in one piece.
  std::unique_ptr<double[]> numbers;  // NOLINT(*-avoid-c-arrays)

  using Matrix = Eigen::Map<Eigen::MatrixXd>;
  using Vector = Eigen::Map<Eigen::VectorXd>;

  Clique() = default;
  Clique(const Clique&) = delete;
  Clique& operator=(const Clique&) = delete;
  ~Clique();  ///< Without recursion, as trees may be deep.

  /// Rows, and columns, of the places that are eliminated and of all.
  [[nodiscard]] Eigen::Index gone() const { return 3 * Eigen::Index{eliminated}; }
  [[nodiscard]] Eigen::Index size() const { return 3 * static_cast<Eigen::Index>(places.size()); }
  /// Lower triangular above, full below: a column for each of the eliminated, a row for all.
  [[nodiscard]] Matrix factor() const { return {numbers.get(), size(), gone()}; }
  /// Solved for the eliminated places; what is left of it for the others.
  [[nodiscard]] Vector right() const { return {numbers.get() + size() * gone(), size()}; }
  /// What is left of the curvature for the others; lower triangle.
  [[nodiscard]] Matrix rest() const {
    return {numbers.get() + size() * (gone() + 1), size() - gone(), size() - gone()};
  }
};

/// What the travels say about the places, to second order about where these are linearised.
struct LinearisedTravels {
  const TravelGraph& graph;
  const PlaceVector& about;            ///< By place.
  const std::vector<char>& is_active;  ///< By place: whether it is part of the equations.
};

/// Makes cliques; keeps its memory from one to the next. A copy begins with none of its own.
class CliqueMaker {
 public:
  CliqueMaker() = default;
  CliqueMaker(const CliqueMaker& /*other*/) {}
  CliqueMaker& operator=(const CliqueMaker& /*other*/) { return *this; }
  ~CliqueMaker() = default;

  /// Adds up the travels of the places to eliminate, and what the children left over, and
  /// eliminates.
  /// @return null where the curvature is not positive definite
  [[nodiscard]] CliquePtr make(std::vector<int> places,
                               int eliminated,
                               std::vector<CliquePtr> children,
                               const LinearisedTravels& travels);

 private:
  void add_travels(const Clique& clique, const LinearisedTravels& travels);
  void add_travel(const TravelResidual& travel, const PlaceVector& about);
  void add_block(int row, int column, const Matrix3d& block);
  void add_rest(const Clique& child);
  [[nodiscard]] bool eliminate(Eigen::Index size, Eigen::Index eliminated);
  [[nodiscard]] int slot_of(int place) const { return slots_[static_cast<std::size_t>(place)]; }

  std::vector<int> slots_;  ///< By place: where in the clique that is made, or -1.
  Eigen::MatrixXd front_;   ///< Lower triangle.
  Eigen::VectorXd right_;
};

/// The steps of the eliminated places, given those of the others.
/// @param steps by place, of (x, y, theta) from where the travels were linearised
/// @param solved receives three numbers by place, those that are eliminated first
void back_substitute(const Clique& clique, const PlaceVector& steps, Eigen::VectorXd* solved);

}  // namespace cairn
