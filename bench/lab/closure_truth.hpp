#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "geometry/pose2.hpp"

namespace cairn::lab {

/// Where the robot was by another account: the truth of a simulation, or another system's map.
struct ReferencePose {
  double time_s = 0.0;
  Pose2 T_reference_robot;
};

/// Lines `time x y theta`; `#` starts a comment. In the order of time. Throws
/// clients::Failure(kBadData) with the line that is not so, and where there is none.
[[nodiscard]] std::vector<ReferencePose> read_reference(const std::filesystem::path& file);

/// Between the two poses around a time, in proportion. None where the reference does not reach.
/// @pre in the order of time
[[nodiscard]] std::optional<Pose2> reference_at(const std::vector<ReferencePose>& reference,
                                                double time_s);

/// One visit: the place that a map says it was to, and where that place is by the reference.
struct JudgedVisit {
  int place = -1;  ///< Places are numbered as they were first met.
  std::optional<Vector2d> p_reference;
};

/// A visit that the map took for something else than the reference does.
struct WrongVisit {
  std::size_t visit = 0;
  std::size_t other = 0;    ///< The visit that it was wrongly taken for, or not recognised as.
  double distance_m = 0.0;  ///< Between the two, by the reference.
};

/// How the places of a map agree with where they are by the reference.
struct ClosureReport {
  std::size_t visits = 0;
  std::size_t places = 0;
  std::size_t unknown = 0;         ///< Visits that the reference does not reach; not judged.
  std::size_t revisits = 0;        ///< Rightly taken for a known place.
  std::size_t closures = 0;        ///< Of them by a way not travelled before: loops closed.
  std::vector<WrongVisit> merged;  ///< Wrongly taken for a known place: false closures.
  std::vector<WrongVisit> missed;  ///< Taken for a new place where a known one is.

  /// Of all visits to known places, the share that was recognised; 1 where there are none.
  [[nodiscard]] double found_share() const;
};

/// Two visits were to the same place if by the reference their places lie within `same_m`.
[[nodiscard]] ClosureReport judge_closures(const std::vector<JudgedVisit>& visits, double same_m);

}  // namespace cairn::lab
