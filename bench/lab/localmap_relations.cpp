#include "bench/lab/localmap_relations.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>
#include <tuple>
#include <utility>

#include "clients/common/failure.hpp"

namespace cairn::lab {
namespace {

using clients::ExitCode;
using clients::Failure;

constexpr double kTolerance_s = 0.03;

/// The scan nearest in time, the earlier one of two that are as near.
const TrackedPose* scan_at(const std::vector<TrackedPose>& track, double time_s) {
  const auto later =
      std::upper_bound(track.begin(), track.end(), time_s,
                       [](double time, const TrackedPose& pose) { return time < pose.time_s; });
  const TrackedPose* nearest = nullptr;
  if (later != track.begin()) {
    nearest = &*std::prev(later);
  }
  if (later != track.end() && (nearest == nullptr || std::abs(later->time_s - time_s) <
                                                         std::abs(nearest->time_s - time_s))) {
    nearest = &*later;
  }
  return nearest != nullptr && std::abs(nearest->time_s - time_s) <= kTolerance_s ? nearest
                                                                                  : nullptr;
}

ErrorMoments moments_of(const std::vector<double>& values) {
  ErrorMoments moments;
  for (const double value : values) {
    moments.mean += value / static_cast<double>(values.size());
    moments.max = std::max(moments.max, value);
  }
  double squares = 0.0;
  for (const double value : values) {
    squares += (value - moments.mean) * (value - moments.mean);
  }
  moments.deviation =
      values.empty() ? 0.0 : std::sqrt(squares / static_cast<double>(values.size()));
  return moments;
}

template <typename Predicate>
RelationErrors summed_up(const std::vector<RelationError>& errors, const Predicate& counts) {
  std::vector<double> translations_m;
  std::vector<double> rotations_deg;
  double error_m = 0.0;
  double travel_m = 0.0;
  for (const RelationError& error : errors) {
    if (counts(error)) {
      translations_m.push_back(error.translation_m);
      rotations_deg.push_back(error.rotation_deg);
      const bool drifts = error.travel_m >= RelationErrors::kDrifting_m;
      error_m += drifts ? error.translation_m : 0.0;
      travel_m += drifts ? error.travel_m : 0.0;
    }
  }
  return {static_cast<std::int64_t>(translations_m.size()), moments_of(translations_m),
          moments_of(rotations_deg), travel_m > 0.0 ? error_m / travel_m : 0.0};
}

std::optional<Relation> relation_of(const std::string& line) {
  std::istringstream words(line);
  double z = 0.0;
  double roll = 0.0;
  double pitch = 0.0;
  double x = 0.0;
  double y = 0.0;
  double yaw = 0.0;
  Relation relation;
  words >> relation.from_s >> relation.to_s >> x >> y >> z >> roll >> pitch >> yaw;
  const bool is_finite = std::isfinite(x) && std::isfinite(y) && std::isfinite(yaw);
  if (!words || !is_finite) {
    return std::nullopt;
  }
  relation.T_from_to = Pose2(x, y, yaw);
  return relation;
}

}  // namespace

std::vector<Relation> read_relations(const std::filesystem::path& file) {
  std::ifstream lines(file);
  if (!lines) {
    throw Failure(ExitCode::kBadData, file.string() + ": cannot be read");
  }
  std::vector<Relation> relations;
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    line = line.substr(0, line.find('#'));
    if (line.find_first_not_of(" \t\r") == std::string::npos) {
      continue;
    }
    const std::optional<Relation> relation = relation_of(line);
    if (!relation) {
      throw Failure(ExitCode::kBadData, file.string() + ": line " + std::to_string(number) +
                                            ": expected t1 t2 x y z roll pitch yaw");
    }
    relations.push_back(*relation);
  }
  if (relations.empty()) {
    throw Failure(ExitCode::kBadData,
                  file.string() + ": expected lines t1 t2 x y z roll pitch yaw, has none");
  }
  return relations;
}

std::vector<std::optional<RelationError>> errors_over(const std::vector<Relation>& relations,
                                                      std::vector<TrackedPose> track) {
  // Where stamps repeat after all, it must not depend on their order which pose is taken.
  std::sort(track.begin(), track.end(), [](const TrackedPose& a, const TrackedPose& b) {
    return std::tuple(a.time_s, a.T_lpm_robot.x(), a.T_lpm_robot.y(), a.T_lpm_robot.theta()) <
           std::tuple(b.time_s, b.T_lpm_robot.x(), b.T_lpm_robot.y(), b.T_lpm_robot.theta());
  });
  std::vector<std::optional<RelationError>> errors;
  for (const Relation& relation : relations) {
    const TrackedPose* const from = scan_at(track, relation.from_s);
    const TrackedPose* const to = scan_at(track, relation.to_s);
    if (from == nullptr || to == nullptr) {
      errors.emplace_back();
      continue;
    }
    const Pose2 found = from->T_lpm_robot.inverse() * to->T_lpm_robot;
    const Pose2 off = relation.T_from_to.inverse() * found;
    errors.push_back(RelationError{off.translation().norm(), std::abs(off.theta()) * 180.0 / kPi,
                                   std::abs(to->travel_m - from->travel_m),
                                   from->sharing == 1 && to->sharing == 1});
  }
  return errors;
}

RelationReport judge(const std::vector<Relation>& relations, std::vector<TrackedPose> track) {
  RelationReport report;
  std::vector<RelationError> errors;
  for (const std::optional<RelationError>& error : errors_over(relations, std::move(track))) {
    if (error) {
      errors.push_back(*error);
    }
  }
  report.missing = static_cast<std::int64_t>(relations.size() - errors.size());
  const auto is_near = [&](const RelationError& e) { return e.travel_m <= report.near_m; };
  report.all = summed_up(errors, [](const RelationError&) { return true; });
  report.near = summed_up(errors, is_near);
  report.near_and_sure =
      summed_up(errors, [&](const RelationError& e) { return is_near(e) && e.is_sure; });
  return report;
}

}  // namespace cairn::lab
