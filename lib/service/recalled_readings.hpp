#pragma once

#include <vector>

#include "base/result.hpp"
#include "service/visit_matcher.hpp"
#include "topology/experience.hpp"

namespace cairn {

/// How the star of a place that is seen again is recalled where it looks different. In the
/// configuration file: the object "recall".
struct RecallOptions {
  /// Of the local maps being of one place, for its star to be recalled (nats). [0, 100]
  double least_log_likelihood_ratio = 2.0;
  /// What each gateway that only one of both visits saw takes from the log-likelihood. [0, 100]
  double log_penalty_difference = 1.0;
  /// The earlier visits whose maps are compared with a new one's at most: those that dead reckoning
  /// says are nearest. 0: nothing is recalled. [0, 1000]
  int max_visits = 24;
};

/// Names every field that is out of range, with its value.
[[nodiscard]] Status validate(const RecallOptions& options);

/// The stars of earlier visits as readings of one that saw the same place: where dead reckoning
/// lets both have been there and their local maps lie on each other, what differs between their
/// stars was misread by one of them. Which of them, nobody knows: the reading stands beside the
/// visit's own ones, and the tree weighs it.
///
/// Each reading has the gateways of the earlier visit's star; those of them that this visit saw,
/// too, are named. The gateways by which the robot came and went are added where the earlier visit
/// lacked them: their fragments end at the place.
///
/// Source: Kuipers et al., ICRA 2004, Sec. III-D, the other way round: there, maps are compared
/// where stars agree; here stars are brought to agree where maps do.
/// @param view of the last visit of the experience, with its own readings; it needs no recalling of
///     what looks like one of these
/// @return the likeliest first, as many as a view has room for beside its own
/// @pre validate(options).ok()
[[nodiscard]] std::vector<Reading> recalled_readings(const Experience& experience,
                                                     const VisitMatcher& matcher,
                                                     const View& view,
                                                     const RecallOptions& options);

}  // namespace cairn
