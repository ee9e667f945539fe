#include "topology/extend_report.hpp"

#include <numeric>
#include <string>

namespace cairn {

std::int64_t ExtendReport::nodes_added() const {
  return std::accumulate(steps.begin(), steps.end(), std::int64_t{0});
}

std::string to_text(const std::vector<Blame>& blamed) {
  std::string text;
  for (const Blame& one : blamed) {
    text += (text.empty() ? "visit " : "; visit ") + std::to_string(one.visit.value) + ": " +
            std::string(name_of(one.kind));
  }
  return text;
}

}  // namespace cairn
