#include "topology/extend_report.hpp"

namespace cairn {

void count_refuted(const Alternative& alternative, ExtendReport& report) {
  switch (alternative.refuted_by) {
    case Refutation::kNone:
      break;
    case Refutation::kOtherView:
      ++(alternative.step.kind == StepKind::kKnownLink ? report.links_contradicted
                                                       : report.closures_of_other_view);
      break;
    case Refutation::kOtherFace:
      ++report.closures_of_other_face;
      break;
    case Refutation::kPlaceTwiceOnPath:
      ++report.closures_repeating_a_place;
      break;
    case Refutation::kRegions:
      ++report.closures_against_regions;
      break;
    case Refutation::kEvidence:
      ++report.refuted_by_evidence;
      break;
    case Refutation::kTooManyPlaces:
      ++report.beyond_place_bound;
      break;
  }
}

void count_possible(StepKind kind, ExtendReport& report) {
  ++report.nodes_added;
  switch (kind) {
    case StepKind::kStart:
      break;
    case StepKind::kKnownLink:
      ++report.known_links;
      break;
    case StepKind::kClosure:
      ++report.closures;
      break;
    case StepKind::kNewPlace:
    case StepKind::kContradiction:
      ++report.new_places;
      break;
    case StepKind::kMisread:
      ++report.misreadings;
      break;
    case StepKind::kRejoin:
      ++report.rejoins;
      break;
  }
}

}  // namespace cairn
