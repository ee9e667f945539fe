#include "place/path_fragments.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cairn {
namespace {

/// What a gateway's inbound traveller can go on through.
struct Continuation {
  int best = -1;         ///< The only clear one.
  bool has_any = false;  ///< Whether any gateway lies about ahead.
};

/// The largest of the turns on the way in through one gateway, straight to another, and out there,
/// and of the turn in all.
double turn_through(const Gateway& in, const Gateway& out) {
  const double inbound_rad = in.outward_bearing_rad + kPi;
  const Vector2d across = out.middle - in.middle;
  const double across_rad = std::atan2(across.y(), across.x());
  return std::max({std::abs(turn_between(inbound_rad, out.outward_bearing_rad)),
                   std::abs(turn_between(inbound_rad, across_rad)),
                   std::abs(turn_between(across_rad, out.outward_bearing_rad))});
}

/// Whether the straight way inward ends at a wall rather than at another gateway.
bool is_blocked_ahead(std::size_t inbound, const std::vector<Gateway>& gateways) {
  constexpr double kFar_m = 100.0;
  const Gateway& in = gateways[inbound];
  const Vector2d far = in.middle - kFar_m * in.outward();
  for (std::size_t i = 0; i < gateways.size(); ++i) {
    if (i != inbound && crossing(gateways[i], in.middle, far, 0.0) > 0) {
      return false;
    }
  }
  return true;
}

/// The only clear continuation after arrival at a gateway, or -1.
int continuation_of(std::size_t inbound,
                    const std::vector<Gateway>& gateways,
                    const ContinuationOptions& options) {
  int best = -1;
  double least = std::numeric_limits<double>::infinity();
  double second = least;
  for (std::size_t i = 0; i < gateways.size(); ++i) {
    if (i == inbound) {
      continue;
    }
    const double turn = turn_through(gateways[inbound], gateways[i]);
    if (turn < least) {
      second = least;
      least = turn;
      best = static_cast<int>(i);
    } else {
      second = std::min(second, turn);
    }
  }
  const bool is_clear = least < options.max_turn_rad;
  return is_clear && second - least >= options.rival_margin_rad ? best : -1;
}

}  // namespace

std::vector<PathFragment> mutual_straight_continuations(const std::vector<Gateway>& gateways,
                                                        const ContinuationOptions& options) {
  std::vector<int> next;
  for (std::size_t i = 0; i < gateways.size(); ++i) {
    next.push_back(continuation_of(i, gateways, options));
  }
  std::vector<PathFragment> fragments;
  for (std::size_t i = 0; i < gateways.size(); ++i) {
    const int self = static_cast<int>(i);
    const int other = next[i];
    const bool passes = other >= 0 && next[static_cast<std::size_t>(other)] == self;
    if (passes && other > self) {
      fragments.push_back({self, other, false});
    } else if (!passes) {
      fragments.push_back({self, -1, is_blocked_ahead(i, gateways)});
    }
  }
  return fragments;
}

}  // namespace cairn
