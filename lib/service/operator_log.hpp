#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sensing/time.hpp"
#include "topology/operator_assertions.hpp"

namespace cairn {

/// Who says something, and when.
struct Operator {
  std::string who;
  TimePoint when;  ///< By the clock of whoever took it down.
};

/// An assertion with everything that an audit asks for.
struct AuditedAssertion {
  OperatorAssertion said;
  TimePoint made;
  std::string effect;  ///< On the best map, one sentence.
  std::optional<TimePoint> retracted;
  std::string retraction_effect;
};

/// When assertions were made and taken back, and what each did: what the tree does not know.
class OperatorLog {
 public:
  void made(const AssertionReport& report, TimePoint when) {
    entries_.push_back({when, report.sentence, std::nullopt, {}});
  }
  /// @pre the assertion has been made
  void retracted(const AssertionReport& report, TimePoint when) {
    Entry& entry = entries_[static_cast<std::size_t>(report.assertion) - 1];
    entry.retracted = when;
    entry.retraction_effect = report.sentence;
  }

  /// @param all what the tree holds, in order
  [[nodiscard]] std::vector<AuditedAssertion> audited(
      const std::vector<OperatorAssertion>& all) const {
    std::vector<AuditedAssertion> audit;
    for (const OperatorAssertion& said : all) {
      const Entry& entry = entries_[static_cast<std::size_t>(said.number) - 1];
      audit.push_back({said, entry.made, entry.effect, entry.retracted, entry.retraction_effect});
    }
    return audit;
  }

 private:
  struct Entry {
    TimePoint made;
    std::string effect;
    std::optional<TimePoint> retracted;
    std::string retraction_effect;
  };
  std::vector<Entry> entries_;  // By number.
};

}  // namespace cairn
