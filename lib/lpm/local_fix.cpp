#include "lpm/local_fix.hpp"

namespace cairn {

const char* to_string(FixNote note) {
  switch (note) {
    case FixNote::kMatched:
      return "matched";
    case FixNote::kFirst:
      return "first";
    case FixNote::kSlip:
      return "slip";
    case FixNote::kTeleport:
      return "teleport";
    case FixNote::kBlockedSensor:
      return "blocked sensor";
    case FixNote::kNoOverlap:
      return "no overlap";
    case FixNote::kContradiction:
      return "contradiction";
  }
  return "unknown";
}

bool is_refused(FixNote note) {
  return note == FixNote::kBlockedSensor || note == FixNote::kNoOverlap ||
         note == FixNote::kContradiction;
}

}  // namespace cairn
