#include "layout/clique.hpp"

#include <cmath>
#include <iterator>
#include <utility>

#include <Eigen/Cholesky>

namespace cairn {
namespace {

std::size_t at(int index) {
  return static_cast<std::size_t>(index);
}

/// Up to this size, three columns at a time are faster than blocks.
constexpr Eigen::Index kSmallFront = 60;

/// Cholesky elimination of the first columns of a lower triangle, three at a time.
bool eliminate_by_columns(Eigen::Ref<Eigen::MatrixXd> front, Eigen::Index eliminated) {
  const Eigen::Index size = front.rows();
  for (Eigen::Index k = 0; k < eliminated; k += 3) {
    for (Eigen::Index c = k; c < k + 3; ++c) {
      for (Eigen::Index b = k; b < c; ++b) {
        front.col(c).tail(size - c) -= front(c, b) * front.col(b).tail(size - c);
      }
      const double pivot = front(c, c);
      if (!(pivot > 0.0)) {
        return false;
      }
      front.col(c).tail(size - c) *= 1.0 / std::sqrt(pivot);
    }
    for (Eigen::Index c = k + 3; c < size; ++c) {
      front.col(c).tail(size - c).noalias() -= front(c, k) * front.col(k).tail(size - c) +
                                               front(c, k + 1) * front.col(k + 1).tail(size - c) +
                                               front(c, k + 2) * front.col(k + 2).tail(size - c);
    }
  }
  return true;
}

bool eliminate_by_blocks(Eigen::Ref<Eigen::MatrixXd> front, Eigen::Index eliminated) {
  const Eigen::Index left = front.rows() - eliminated;
  Eigen::Ref<Eigen::MatrixXd> first = front.topLeftCorner(eliminated, eliminated);
  const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>, Eigen::Lower> cholesky(first);
  if (cholesky.info() != Eigen::Success) {
    return false;
  }
  auto below = front.bottomLeftCorner(left, eliminated);
  first.triangularView<Eigen::Lower>().transpose().solveInPlace<Eigen::OnTheRight>(below);
  front.bottomRightCorner(left, left).selfadjointView<Eigen::Lower>().rankUpdate(below, -1.0);
  return true;
}

}  // namespace

Clique::~Clique() {
  std::vector<CliquePtr> open = std::move(children);
  while (!open.empty()) {
    const CliquePtr child = std::move(open.back());
    open.pop_back();
    if (child.use_count() == 1) {
      // Nobody else sees it: its children are taken from it before it goes.
      auto& below = const_cast<Clique&>(*child).children;  // NOLINT(*-const-cast)
      std::move(below.begin(), below.end(), std::back_inserter(open));
      below.clear();
    }
  }
}

CliquePtr CliqueMaker::make(std::vector<int> places,
                            int eliminated,
                            std::vector<CliquePtr> children,
                            const LinearisedTravels& travels) {
  auto clique = std::make_shared<Clique>();
  clique->places = std::move(places);
  clique->eliminated = eliminated;
  clique->children = std::move(children);
  slots_.resize(travels.about.size(), -1);
  for (std::size_t slot = 0; slot < clique->places.size(); ++slot) {
    slots_[at(clique->places[slot])] = static_cast<int>(slot);
  }
  const Eigen::Index size = clique->size();
  const Eigen::Index gone = clique->gone();
  if (front_.rows() < size) {
    front_.resize(size + size / 2, size + size / 2);
  }
  front_.topLeftCorner(size, size).setZero();
  right_.setZero(size);
  add_travels(*clique, travels);
  for (const CliquePtr& child : clique->children) {
    add_rest(*child);
  }
  for (const int place : clique->places) {
    slots_[at(place)] = -1;
  }
  if (!eliminate(size, gone)) {
    return nullptr;
  }
  const Eigen::Index left = size - gone;
  // Not zeroed: every number is written below.
  clique->numbers.reset(new double[static_cast<std::size_t>(size * (gone + 1) + left * left)]);
  clique->factor() = front_.topLeftCorner(size, gone);
  clique->rest() = front_.block(gone, gone, left, left);
  clique->right() = right_;
  return clique;
}

/// Those of the eliminated places that no child has: their other place goes later, or never.
void CliqueMaker::add_travels(const Clique& clique, const LinearisedTravels& travels) {
  for (int slot = 0; slot < clique.eliminated; ++slot) {
    const int place = clique.places[at(slot)];
    travels.graph.for_each_travel_of(place, [&](int index) {
      const TravelResidual& travel = travels.graph.travel(index);
      const int other = travel.from == place ? travel.to : travel.from;
      const bool is_later = other == 0 || slot_of(other) > slot;
      if (is_later && travels.is_active[at(other)] != 0) {
        add_travel(travel, travels.about);
      }
    });
  }
}

void CliqueMaker::add_travel(const TravelResidual& travel, const PlaceVector& about) {
  Matrix3d by_from;
  Matrix3d by_to;
  const Eigen::Vector3d residual =
      travel.at(about[at(travel.from)], about[at(travel.to)], &by_from, &by_to);
  const int from = slot_of(travel.from);
  const int to = slot_of(travel.to);
  if (from >= 0) {
    add_block(from, from, by_from.transpose() * by_from);
    right_.segment<3>(3 * from).noalias() -= by_from.transpose() * residual;
  }
  if (to >= 0) {
    add_block(to, to, by_to.transpose() * by_to);
    right_.segment<3>(3 * to).noalias() -= by_to.transpose() * residual;
  }
  if (from >= 0 && to >= 0) {
    if (from > to) {
      add_block(from, to, by_from.transpose() * by_to);
    } else {
      add_block(to, from, by_to.transpose() * by_from);
    }
  }
}

void CliqueMaker::add_block(int row, int column, const Matrix3d& block) {
  front_.block<3, 3>(3 * row, 3 * column) += block;
}

void CliqueMaker::add_rest(const Clique& child) {
  const int left = static_cast<int>(child.places.size()) - child.eliminated;
  const Clique::Matrix rest = child.rest();
  const Clique::Vector right = child.right();
  for (int column = 0; column < left; ++column) {
    const int to_column = slot_of(child.places[at(child.eliminated + column)]);
    right_.segment<3>(3 * to_column) += right.segment<3>(3 * (child.eliminated + column));
    for (int row = column; row < left; ++row) {
      const int to_row = slot_of(child.places[at(child.eliminated + row)]);
      const auto block = rest.block<3, 3>(3 * row, 3 * column);
      if (to_row >= to_column) {
        front_.block<3, 3>(3 * to_row, 3 * to_column) += block;
      } else {
        front_.block<3, 3>(3 * to_column, 3 * to_row) += block.transpose();
      }
    }
  }
}

bool CliqueMaker::eliminate(Eigen::Index size, Eigen::Index eliminated) {
  auto front = front_.topLeftCorner(size, size);
  const bool is_definite = size <= kSmallFront ? eliminate_by_columns(front, eliminated)
                                               : eliminate_by_blocks(front, eliminated);
  if (!is_definite) {
    return false;
  }
  for (Eigen::Index c = 0; c < eliminated; ++c) {
    const Eigen::Index below = size - c - 1;
    right_[c] /= front(c, c);
    right_.tail(below).noalias() -= right_[c] * front.col(c).tail(below);
  }
  return true;
}

void back_substitute(const Clique& clique, const PlaceVector& steps, Eigen::VectorXd* solved) {
  const Clique::Matrix factor = clique.factor();
  const Eigen::Index size = clique.size();
  const Eigen::Index gone = clique.gone();
  solved->resize(size);
  solved->head(gone) = clique.right().head(gone);
  for (int slot = clique.eliminated; slot < static_cast<int>(clique.places.size()); ++slot) {
    solved->segment<3>(3 * slot) = steps[at(clique.places[at(slot)])];
  }
  for (Eigen::Index c = gone - 1; c >= 0; --c) {
    const Eigen::Index below = size - c - 1;
    (*solved)[c] =
        ((*solved)[c] - factor.col(c).tail(below).dot(solved->tail(below))) / factor(c, c);
  }
}

}  // namespace cairn
