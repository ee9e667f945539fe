#include "bench/lab/map_layout.hpp"

#include <cmath>
#include <deque>
#include <numbers>

#include <Eigen/Dense>

namespace cairn::lab {
namespace {

using Index = std::size_t;
using Points = Eigen::Matrix<double, Eigen::Dynamic, 2>;

constexpr int kRounds = 300;
/// Of a pair of places at distance 1, against a link's 2; falls with the square of the distance.
constexpr double kStressWeight = 0.05;

Eigen::RowVector2d towards(double direction_rad) {
  return {std::sin(direction_rad), -std::cos(direction_rad)};
}

double direction_of(const Eigen::RowVector2d& v) {
  return std::atan2(v.x(), -v.y());
}

/// A link as seen from one of its places.
struct End {
  int place = 0;
  int gateway = 0;
  int other = 0;
  int other_gateway = 0;
};

class Layout {
 public:
  explicit Layout(const DrawnMap& map)
      : map_(map),
        count_(static_cast<int>(map.places.size())),
        ends_(map.places.size()),
        turned_(map.places.size(), 0.0),
        points_(Points::Zero(count_, 2)) {
    for (const DrawnLink& link : map.links) {
      ends_[static_cast<Index>(link.from_place)].push_back(
          {link.from_place, link.from_gateway, link.to_place, link.to_gateway});
      ends_[static_cast<Index>(link.to_place)].push_back(
          {link.to_place, link.to_gateway, link.from_place, link.from_gateway});
    }
    for (int place = 0; place < count_; ++place) {
      distances_.push_back(distances_from(place));
    }
    place_first();
  }

  std::vector<DrawnPosition> solve() {
    const Eigen::LDLT<Eigen::MatrixXd> laplacian(weights());
    for (int round = 0; round < kRounds; ++round) {
      turn_places();
      points_ = laplacian.solve(pulls());
    }
    straighten();
    std::vector<DrawnPosition> positions;
    for (int place = 0; place < count_; ++place) {
      positions.push_back(
          {points_(place, 0), points_(place, 1), turned_[static_cast<Index>(place)]});
    }
    return positions;
  }

 private:
  [[nodiscard]] double direction(const End& end) const {
    return direction_rad(map_.places[static_cast<Index>(end.place)],
                         turned_[static_cast<Index>(end.place)], end.gateway);
  }

  [[nodiscard]] std::vector<int> distances_from(int first) const {
    std::vector<int> distances(ends_.size(), -1);
    distances[static_cast<Index>(first)] = 0;
    for (std::deque<int> queue{first}; !queue.empty(); queue.pop_front()) {
      for (const End& end : ends_[static_cast<Index>(queue.front())]) {
        int& distance = distances[static_cast<Index>(end.other)];
        if (distance < 0) {
          distance = distances[static_cast<Index>(queue.front())] + 1;
          queue.push_back(end.other);
        }
      }
    }
    return distances;
  }

  /// Each place straight out of the gateway by which it is met first, a little off so that no two
  /// lie on each other.
  void place_first() {
    std::vector<bool> met(ends_.size(), false);
    met[0] = true;
    for (std::deque<int> queue{0}; !queue.empty(); queue.pop_front()) {
      for (const End& end : ends_[static_cast<Index>(queue.front())]) {
        const auto other = static_cast<Index>(end.other);
        if (met[other]) {
          continue;
        }
        met[other] = true;
        const double onward = direction(end);
        turned_[other] =
            onward + std::numbers::pi - direction_rad(map_.places[other], 0.0, end.other_gateway);
        points_.row(end.other) = points_.row(end.place) + towards(onward) +
                                 0.05 * towards(static_cast<double>(end.other));
        queue.push_back(end.other);
      }
    }
  }

  [[nodiscard]] double stress(int a, int b) const {
    const double distance = distances_[static_cast<Index>(a)][static_cast<Index>(b)];
    return kStressWeight / (distance * distance);
  }

  [[nodiscard]] Eigen::MatrixXd weights() const {
    // A breath of a pull to the origin makes the solution unique.
    Eigen::MatrixXd matrix = 1e-9 * Eigen::MatrixXd::Identity(count_, count_);
    const auto join = [&matrix](int a, int b, double weight) {
      matrix(a, a) += weight;
      matrix(b, b) += weight;
      matrix(a, b) -= weight;
      matrix(b, a) -= weight;
    };
    for (const DrawnLink& link : map_.links) {
      join(link.from_place, link.to_place, 2.0);
    }
    for (int a = 0; a < count_; ++a) {
      for (int b = a + 1; b < count_; ++b) {
        join(a, b, stress(a, b));
      }
    }
    return matrix;
  }

  void turn_places() {
    for (int place = 0; place < count_; ++place) {
      Eigen::RowVector2d sum = Eigen::RowVector2d::Zero();
      for (const End& end : ends_[static_cast<Index>(place)]) {
        const Eigen::RowVector2d link = points_.row(end.other) - points_.row(place);
        const double off = direction_of(link) - direction(end);
        sum += link.norm() * towards(off);
      }
      if (sum.norm() > 0.0) {
        turned_[static_cast<Index>(place)] += direction_of(sum);
      }
    }
  }

  [[nodiscard]] Points pulls() const {
    Points result = Points::Zero(count_, 2);
    const auto pull = [&result](int to, int from, const Eigen::RowVector2d& v) {
      result.row(to) += v;
      result.row(from) -= v;
    };
    for (const auto& ends : ends_) {
      for (const End& end : ends) {
        pull(end.other, end.place, towards(direction(end)));
      }
    }
    for (int a = 0; a < count_; ++a) {
      for (int b = a + 1; b < count_; ++b) {
        const Eigen::RowVector2d v = points_.row(b) - points_.row(a);
        const double distance = distances_[static_cast<Index>(a)][static_cast<Index>(b)];
        pull(b, a, stress(a, b) * distance / std::max(v.norm(), 1e-9) * v);
      }
    }
    return result;
  }

  /// Turns the whole drawing so that most links run across or down.
  void straighten() {
    Eigen::RowVector2d sum = Eigen::RowVector2d::Zero();
    for (const DrawnLink& link : map_.links) {
      const Eigen::RowVector2d v = points_.row(link.to_place) - points_.row(link.from_place);
      sum += v.norm() * towards(4.0 * direction_of(v));
    }
    const double turn_rad = -direction_of(sum) / 4.0;
    Eigen::Matrix2d rotation;
    rotation << std::cos(turn_rad), std::sin(turn_rad), -std::sin(turn_rad), std::cos(turn_rad);
    points_ = (points_ * rotation).eval();
    for (double& turned : turned_) {
      turned += turn_rad;
    }
  }

  const DrawnMap& map_;
  int count_;
  std::vector<std::vector<End>> ends_;  // By place.
  std::vector<std::vector<int>> distances_;
  std::vector<double> turned_;
  Points points_;
};

}  // namespace

double direction_rad(const DrawnPlace& place, double turned_rad, int gateway) {
  const int slot = place.slot_of_gateway[static_cast<Index>(gateway)];
  return turned_rad + 2.0 * std::numbers::pi * slot / place.slots;
}

std::vector<DrawnPosition> laid_out(const DrawnMap& map) {
  return Layout(map).solve();
}

}  // namespace cairn::lab
