#include "bench/lab/truth.hpp"

#include <vector>

#include "bench/lab/worlds/random_exploration.hpp"
#include "support/obvious_tree.hpp"

namespace cairn::lab {

std::string code_of_truth(const Walk& walk) {
  std::vector<test::ObviousGateway> visits;
  for (const TrueStep& step : truth_of(walk)) {
    visits.push_back({step.place, step.gateway});
  }
  return test::obvious_code(test::obvious_map(walk.exploration, visits));
}

}  // namespace cairn::lab
