#include "topology/operator_assertions.hpp"

#include <algorithm>
#include <map>
#include <set>

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

std::vector<VisitId> OperatorAssertions::same_as(VisitId visit) const {
  std::set<VisitId> same = {visit};
  for (bool grows = true; grows;) {
    grows = false;
    for (const OperatorAssertion& one : all_) {
      if (is_in_force(one) && one.is_same && (same.count(one.a) != same.count(one.b))) {
        same.insert(one.a);
        same.insert(one.b);
        grows = true;
      }
    }
  }
  same.erase(visit);
  return {same.begin(), same.end()};
}

std::vector<VisitId> OperatorAssertions::different_from(VisitId visit) const {
  std::set<VisitId> different;
  std::vector<VisitId> here = same_as(visit);
  here.push_back(visit);
  for (const VisitId one : here) {
    for (const OperatorAssertion& assertion : all_) {
      if (is_in_force(assertion) && !assertion.is_same &&
          (assertion.a == one || assertion.b == one)) {
        const VisitId other = assertion.a == one ? assertion.b : assertion.a;
        const std::vector<VisitId> there = same_as(other);
        different.insert(other);
        different.insert(there.begin(), there.end());
      }
    }
  }
  return {different.begin(), different.end()};
}

bool OperatorAssertions::is_any_in_force() const {
  return std::any_of(all_.begin(), all_.end(), is_in_force);
}

}  // namespace cairn
