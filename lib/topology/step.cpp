#include "topology/step.hpp"

namespace cairn {

std::string_view name_of(StepKind kind) {
  switch (kind) {
    case StepKind::kStart:
      return "start";
    case StepKind::kKnownLink:
      return "known link";
    case StepKind::kClosure:
      return "closure";
    case StepKind::kNewPlace:
      return "new place";
    case StepKind::kMisread:
      return "misread star";
    case StepKind::kAmended:
      return "corrected star";
    case StepKind::kUnnoticed:
      return "passing without notice";
    case StepKind::kInserted:
      return "place noticed late";
    case StepKind::kRejoin:
      return "rejoining";
    case StepKind::kBranch:
      return "branching off";
    case StepKind::kContradiction:
      return "break";
    case StepKind::kRelocated:
      return "waking up";
    case StepKind::kElsewhere:
      return "waking up elsewhere";
  }
  return "";
}

std::string_view reason_of(Refutation refutation) {
  switch (refutation) {
    case Refutation::kNone:
      return "nothing";
    case Refutation::kOtherView:
      return "the star looks different from there";
    case Refutation::kOtherFace:
      return "the link would cross a path segment (another face)";
    case Refutation::kPlaceTwiceOnPath:
      return "a place would be twice on a path (axiom)";
    case Refutation::kRegions:
      return "a place would be on both sides of a path, or on it and beside it";
    case Refutation::kEvidence:
      return "evidence excludes it";
    case Refutation::kTooManyPlaces:
      return "the map would have more than max_places places";
    case Refutation::kOperator:
      return "an operator says otherwise";
  }
  return "";
}

}  // namespace cairn
