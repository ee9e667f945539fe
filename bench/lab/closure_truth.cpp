#include "bench/lab/closure_truth.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <set>
#include <sstream>
#include <utility>

#include "clients/common/failure.hpp"
#include "geometry/angle.hpp"

namespace cairn::lab {
namespace {

using clients::ExitCode;
using clients::Failure;

std::optional<ReferencePose> pose_of(const std::string& line) {
  std::istringstream words(line);
  double x = 0.0;
  double y = 0.0;
  double theta = 0.0;
  ReferencePose pose;
  words >> pose.time_s >> x >> y >> theta;
  if (!words || !std::isfinite(pose.time_s) || !std::isfinite(x) || !std::isfinite(y) ||
      !std::isfinite(theta)) {
    return std::nullopt;
  }
  pose.T_reference_robot = Pose2(x, y, theta);
  return pose;
}

double distance_m(const JudgedVisit& a, const JudgedVisit& b) {
  return (*a.p_reference - *b.p_reference).norm();
}

/// The visit before `end` that lies nearest to it, of those that count.
template <typename Predicate>
std::optional<WrongVisit> nearest_before(const std::vector<JudgedVisit>& visits,
                                         std::size_t end,
                                         const Predicate& counts) {
  std::optional<WrongVisit> nearest;
  for (std::size_t other = 0; other < end; ++other) {
    if (!visits[other].p_reference || !counts(visits[other])) {
      continue;
    }
    const double away_m = distance_m(visits[other], visits[end]);
    if (!nearest || away_m < nearest->distance_m) {
      nearest = WrongVisit{end, other, away_m};
    }
  }
  return nearest;
}

}  // namespace

std::vector<ReferencePose> read_reference(const std::filesystem::path& file) {
  std::ifstream lines(file);
  if (!lines) {
    throw Failure(ExitCode::kBadData, file.string() + ": cannot be read");
  }
  std::vector<ReferencePose> poses;
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    line = line.substr(0, line.find('#'));
    if (line.find_first_not_of(" \t\r") == std::string::npos) {
      continue;
    }
    const std::optional<ReferencePose> pose = pose_of(line);
    if (!pose) {
      throw Failure(ExitCode::kBadData, file.string() + ": line " + std::to_string(number) +
                                            ": expected time x y theta");
    }
    poses.push_back(*pose);
  }
  if (poses.empty()) {
    throw Failure(ExitCode::kBadData, file.string() + ": no pose in it");
  }
  std::stable_sort(poses.begin(), poses.end(), [](const ReferencePose& a, const ReferencePose& b) {
    return a.time_s < b.time_s;
  });
  return poses;
}

std::optional<Pose2> reference_at(const std::vector<ReferencePose>& reference, double time_s) {
  constexpr double kBeyond_s = 2.0;  // before the first and after the last pose
  const auto later =
      std::lower_bound(reference.begin(), reference.end(), time_s,
                       [](const ReferencePose& pose, double time) { return pose.time_s < time; });
  if (later == reference.begin() || later == reference.end()) {
    if (reference.empty()) {
      return std::nullopt;
    }
    const ReferencePose& end = later == reference.end() ? reference.back() : *later;
    return std::abs(end.time_s - time_s) <= kBeyond_s ? std::optional(end.T_reference_robot)
                                                      : std::nullopt;
  }
  const ReferencePose& a = *std::prev(later);
  const ReferencePose& b = *later;
  const double share = (time_s - a.time_s) / (b.time_s - a.time_s);
  const Vector2d p =
      (1.0 - share) * a.T_reference_robot.translation() + share * b.T_reference_robot.translation();
  const double turn_rad = turn_between(a.T_reference_robot.theta(), b.T_reference_robot.theta());
  return Pose2(p, a.T_reference_robot.theta() + share * turn_rad);
}

double ClosureReport::found_share() const {
  const std::size_t all = revisits + missed.size();
  return all > 0 ? static_cast<double>(revisits) / static_cast<double>(all) : 1.0;
}

ClosureReport judge_closures(const std::vector<JudgedVisit>& visits, double same_m) {
  ClosureReport report;
  std::set<int> known;
  std::set<std::pair<int, int>> ways;
  for (std::size_t v = 0; v < visits.size(); ++v) {
    const int place = visits[v].place;
    const bool is_known = !known.insert(place).second;
    const bool is_new_way = v > 0 && ways.insert(std::minmax(visits[v - 1].place, place)).second;
    ++report.visits;
    if (!visits[v].p_reference) {
      ++report.unknown;
      continue;
    }
    const std::optional<WrongVisit> of_place =
        nearest_before(visits, v, [&](const JudgedVisit& other) { return other.place == place; });
    const std::optional<WrongVisit> of_any =
        nearest_before(visits, v, [](const JudgedVisit&) { return true; });
    if (is_known && of_place && of_place->distance_m > same_m) {
      report.merged.push_back(*of_place);
    } else if (is_known && of_place) {
      ++report.revisits;
      report.closures += is_new_way ? 1 : 0;
    } else if (!is_known && of_any && of_any->distance_m <= same_m) {
      report.missed.push_back(*of_any);
    }
  }
  report.places = known.size();
  return report;
}

}  // namespace cairn::lab
