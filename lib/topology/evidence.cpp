#include "topology/evidence.hpp"

#include <algorithm>
#include <string>

namespace cairn {

Result<std::vector<EvidenceName>> evidence_named(std::string_view names) {
  std::vector<EvidenceName> found;
  while (!names.empty()) {
    const std::size_t end = std::min(names.find(' '), names.size());
    const std::string_view name = names.substr(0, end);
    names.remove_prefix(std::min(end + 1, names.size()));
    if (name.empty()) {
      continue;
    }
    if (name != "place_match" && name != "layout") {
      return Error{ErrorCode::kInvalidValue,
                   "evidence: expected place_match or layout, got \"" + std::string(name) + "\""};
    }
    const EvidenceName known = name == "layout" ? EvidenceName::kLayout : EvidenceName::kPlaceMatch;
    if (std::find(found.begin(), found.end(), known) != found.end()) {
      return Error{ErrorCode::kInvalidValue,
                   "evidence: \"" + std::string(name) + "\" is named twice"};
    }
    found.push_back(known);
  }
  return found;
}

}  // namespace cairn
