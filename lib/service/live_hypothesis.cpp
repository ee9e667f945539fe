#include "service/live_hypothesis.hpp"

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

namespace cairn {
namespace {

/// "3, 7, 12 and 5 more".
std::string numbers_of(const std::vector<Hypothesis>& fringe) {
  constexpr std::size_t kMostNamed = 10;
  std::string text;
  for (std::size_t i = 0; i < std::min(fringe.size(), kMostNamed); ++i) {
    text += (i == 0 ? "" : ", ") + std::to_string(fringe[i].id.value);
  }
  return fringe.size() <= kMostNamed
             ? text
             : text + " and " + std::to_string(fringe.size() - kMostNamed) + " more";
}

bool was_made(const HypothesisTree& tree, std::int64_t number) {
  return number >= 0 && number <= std::numeric_limits<std::int32_t>::max() &&
         tree.is_known(HypothesisId{static_cast<std::int32_t>(number)});
}

}  // namespace

Result<LiveHypothesis> live_hypothesis(const HypothesisTree& tree, std::int64_t number) {
  if (!tree.is_started()) {
    return Error{ErrorCode::kNotFound, "there is no map yet"};
  }
  const std::vector<Hypothesis> fringe = tree.fringe();
  for (std::size_t i = 0; i < fringe.size(); ++i) {
    if (fringe[i].id.value == number) {
      return LiveHypothesis{fringe[i].id, tree.probabilities()[i]};
    }
  }
  const std::string why = was_made(tree, number)
                              ? "not live any more: others have grown from it, or are better"
                              : "not live: refuted, given up, or never there";
  return Error{ErrorCode::kNotFound, "hypothesis " + std::to_string(number) + " is " + why +
                                         "; expected one of " + numbers_of(fringe)};
}

}  // namespace cairn
