#include "topology/operator_assertions.hpp"

#include <algorithm>
#include <map>

namespace cairn {
namespace {

bool is_in_force(const OperatorAssertion& assertion) {
  return !assertion.retracted_after_visits.has_value();
}

std::string text_of(const OperatorAssertion& assertion) {
  return "assertion " + std::to_string(assertion.number) + ": visits " +
         std::to_string(assertion.a.value) + " and " + std::to_string(assertion.b.value) +
         (assertion.is_same ? " were" : " were not") + " to the same place";
}

/// Visits joined by "same".
class SamePlaces {
 public:
  VisitId root_of(VisitId visit) {
    const auto found = parent_.find(visit);
    return found == parent_.end() || found->second == visit ? visit : root_of(found->second);
  }
  void join(VisitId a, VisitId b) { parent_[root_of(a)] = root_of(b); }

 private:
  std::map<VisitId, VisitId> parent_;
};

}  // namespace

Result<int> OperatorAssertions::add(OperatorAssertion assertion) {
  if (Status status = check(assertion); !status.ok()) {
    return status.error();
  }
  assertion.number = static_cast<int>(all_.size()) + 1;
  all_.push_back(std::move(assertion));
  return all_.back().number;
}

Status OperatorAssertions::check(OperatorAssertion assertion) const {
  assertion.number = static_cast<int>(all_.size()) + 1;
  return check_against_others(assertion);
}

Status OperatorAssertions::check_against_others(const OperatorAssertion& assertion) const {
  SamePlaces same;
  for (const OperatorAssertion& other : all_) {
    if (is_in_force(other) && other.is_same) {
      same.join(other.a, other.b);
    }
  }
  if (!assertion.is_same && same.root_of(assertion.a) == same.root_of(assertion.b)) {
    std::string numbers;
    for (const OperatorAssertion& other : all_) {
      if (is_in_force(other) && other.is_same &&
          same.root_of(other.a) == same.root_of(assertion.a)) {
        numbers += (numbers.empty() ? "" : ", ") + std::to_string(other.number);
      }
    }
    return Error{ErrorCode::kContradiction,
                 text_of(assertion) + ": it contradicts what is in force (" + numbers + ")"};
  }
  if (assertion.is_same) {
    same.join(assertion.a, assertion.b);
  }
  for (const OperatorAssertion& other : all_) {
    if (is_in_force(other) && !other.is_same && same.root_of(other.a) == same.root_of(other.b)) {
      return Error{ErrorCode::kContradiction,
                   text_of(assertion) + ": it contradicts " + text_of(other)};
    }
  }
  return {};
}

Status OperatorAssertions::check_retraction(int number) const {
  if (number < 1 || number > static_cast<int>(all_.size())) {
    return Error{ErrorCode::kNotFound, "assertion " + std::to_string(number) +
                                           ": expected a number in [1, " +
                                           std::to_string(all_.size()) + "]"};
  }
  if (!is_in_force(all_[static_cast<std::size_t>(number) - 1])) {
    return Error{ErrorCode::kNotFound,
                 "assertion " + std::to_string(number) + " has already been taken back"};
  }
  return {};
}

Status OperatorAssertions::retract(int number, int after_visits, std::string who) {
  if (Status status = check_retraction(number); !status.ok()) {
    return status;
  }
  OperatorAssertion& assertion = all_[static_cast<std::size_t>(number) - 1];
  assertion.retracted_after_visits = after_visits;
  assertion.retracted_by = std::move(who);
  return {};
}

bool OperatorAssertions::names(VisitId visit) const {
  return std::any_of(all_.begin(), all_.end(), [&](const OperatorAssertion& one) {
    return is_in_force(one) && (one.a == visit || one.b == visit);
  });
}

std::vector<OperatorAssertion> OperatorAssertions::ending_at(VisitId visit) const {
  std::vector<OperatorAssertion> ending;
  std::copy_if(all_.begin(), all_.end(), std::back_inserter(ending),
               [&](const OperatorAssertion& one) {
                 return is_in_force(one) && std::max(one.a, one.b) == visit;
               });
  return ending;
}

bool OperatorAssertions::is_any_in_force() const {
  return std::any_of(all_.begin(), all_.end(), is_in_force);
}

}  // namespace cairn
