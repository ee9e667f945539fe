#include "place/path_fragments.hpp"

#include <cmath>
#include <limits>

namespace cairn {
namespace {

/// What a gateway's inbound traveller can go on through.
struct Continuation {
  int best = -1;         ///< The only clear one.
  bool has_any = false;  ///< Whether any gateway lies about ahead.
};

/// Heading change between entering through one gateway and leaving through another.
double turn_through(const Gateway& in, const Gateway& out) {
  return std::abs(turn_between(in.outward_bearing_rad + kPi, out.outward_bearing_rad));
}

Continuation continuation_of(std::size_t inbound,
                             const std::vector<Gateway>& gateways,
                             const ContinuationOptions& options) {
  double least = std::numeric_limits<double>::infinity();
  double second = least;
  Continuation result;
  for (std::size_t i = 0; i < gateways.size(); ++i) {
    if (i == inbound) {
      continue;
    }
    const double turn = turn_through(gateways[inbound], gateways[i]);
    if (turn < least) {
      second = least;
      least = turn;
      result.best = static_cast<int>(i);
    } else {
      second = std::min(second, turn);
    }
  }
  result.has_any = least < options.max_turn_rad;
  if (!result.has_any || second - least < options.rival_margin_rad) {
    result.best = -1;
  }
  return result;
}

}  // namespace

std::vector<PathFragment> mutual_straight_continuations(const std::vector<Gateway>& gateways,
                                                        const ContinuationOptions& options) {
  std::vector<Continuation> next;
  for (std::size_t i = 0; i < gateways.size(); ++i) {
    next.push_back(continuation_of(i, gateways, options));
  }
  std::vector<PathFragment> fragments;
  for (std::size_t i = 0; i < gateways.size(); ++i) {
    const int self = static_cast<int>(i);
    const int other = next[i].best;
    const bool passes = other >= 0 && next[static_cast<std::size_t>(other)].best == self;
    if (passes && other > self) {
      fragments.push_back({self, other, false});
    } else if (!passes) {
      fragments.push_back({self, -1, !next[i].has_any});
    }
  }
  return fragments;
}

}  // namespace cairn
