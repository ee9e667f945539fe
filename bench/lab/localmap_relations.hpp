#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "bench/lab/localmap_run.hpp"

namespace cairn::lab {

/// The true pose at one time in the frame of the pose at another.
struct Relation {
  double from_s = 0.0;
  double to_s = 0.0;
  Pose2 T_from_to;
};

/// Lines `t1 t2 x y z roll pitch yaw`; `#` starts a comment. Throws clients::Failure(kBadData) with
/// the line that is not so.
[[nodiscard]] std::vector<Relation> read_relations(const std::filesystem::path& file);

/// Of one relation.
struct RelationError {
  double translation_m = 0.0;
  double rotation_deg = 0.0;
  double travel_m = 0.0;  ///< Between its ends.
  bool is_sure = true;    ///< Both ends bear stamps that no other pose bears.
};

/// By relation; none where an end has no pose within 30 ms.
[[nodiscard]] std::vector<std::optional<RelationError>> errors_over(
    const std::vector<Relation>& relations, std::vector<TrackedPose> track);

struct ErrorMoments {
  double mean = 0.0;
  double deviation = 0.0;
  double max = 0.0;
};

struct RelationErrors {
  static constexpr double kDrifting_m = 1.0;
  std::int64_t relations = 0;
  ErrorMoments translation_m;
  ErrorMoments rotation_deg;
  /// Sum of translational errors by sum of travel between, of relations at least kDrifting_m long:
  /// between poses at one spot there is nothing to drift.
  double drift_per_travel = 0.0;
};

/// Over all relations, over those whose ends lie within `near_m` of travel, and over those of them
/// whose ends bear stamps that no other pose bears: only there it is sure which pose is meant.
struct RelationReport {
  std::int64_t missing = 0;  ///< An end has no pose within 30 ms.
  double near_m = 20.0;
  RelationErrors all;
  RelationErrors near;
  RelationErrors near_and_sure;
};

/// Source: Kuemmerle et al., "On measuring the accuracy of SLAM algorithms", Autonomous Robots
/// 2009.
[[nodiscard]] RelationReport judge(const std::vector<Relation>& relations,
                                   std::vector<TrackedPose> track);

}  // namespace cairn::lab
