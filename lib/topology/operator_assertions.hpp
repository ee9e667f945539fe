#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/result.hpp"
#include "topology/extend_report.hpp"
#include "topology/ids.hpp"

namespace cairn {

/// What a person said about two visits. Visits, not places: hypotheses number places differently.
struct OperatorAssertion {
  int number = 0;  ///< 1, 2, ... in the order in which they were made.
  VisitId a;
  VisitId b;
  bool is_same = true;  ///< Both were to the same place; false: to different ones.
  std::string who;
  int made_after_visits = 0;
  std::optional<int> retracted_after_visits;
  std::string retracted_by;
};

/// A visit that the best hypothesis now puts at another place.
struct MovedVisit {
  VisitId visit;
  VisitId place_before;  ///< Named by the visit that made it known.
  VisitId place_after;
};

/// What an assertion, or taking it back, did to the tree.
struct AssertionReport {
  int assertion = 0;
  std::vector<MovedVisit> moved;  ///< In the best hypothesis.
  HypothesisId best;
  double log_posterior_before = 0.0;  ///< Of the best hypothesis.
  double log_posterior_after = 0.0;
  std::optional<Repair> repair;  ///< The last one that growing the tree anew needed.
  std::string sentence;
};

/// All that operators said, those taken back included: the audit trail.
class OperatorAssertions {
 public:
  /// Takes it up under the next number. An error if it contradicts those in force: visits that are
  /// the same place as others by assertion cannot be told different, nor the other way round.
  Result<int> add(OperatorAssertion assertion);
  /// Whether add() would take it up. @param assertion its number is not looked at
  [[nodiscard]] Status check(OperatorAssertion assertion) const;
  /// Whether retract() would take it back.
  [[nodiscard]] Status check_retraction(int number) const;
  Status retract(int number, int after_visits, std::string who);

  [[nodiscard]] const std::vector<OperatorAssertion>& all() const { return all_; }
  /// In force.
  [[nodiscard]] bool names(VisitId visit) const;
  /// Visits that are to the same place by the assertions in force, chains included; without
  /// `visit`.
  [[nodiscard]] std::vector<VisitId> same_as(VisitId visit) const;
  /// Visits that are to other places by the assertions in force, chains included.
  [[nodiscard]] std::vector<VisitId> different_from(VisitId visit) const;
  [[nodiscard]] bool is_any_in_force() const;

 private:
  [[nodiscard]] Status check_against_others(const OperatorAssertion& assertion) const;

  std::vector<OperatorAssertion> all_;
};

}  // namespace cairn
