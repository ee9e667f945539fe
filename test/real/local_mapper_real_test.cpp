#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "lpm/local_mapper.hpp"
#include "support/carmen_scans.hpp"
#include "support/recorded_data.hpp"

namespace cairn {
namespace {

struct Track {
  std::map<double, Pose2> T_lpm_robot;  // by stamp in seconds
  std::map<double, double> travel_m;
  std::size_t scans = 0;
  std::size_t refused = 0;
  std::int64_t restarts = 0;
  double scan_lag_s = 0.0;
};

Track track_of(const std::string& log) {
  ScanJoiner joiner;
  LocalMapper mapper;
  Track track;
  Pose2 last;
  double travel_m = 0.0;
  const auto drain = [&] {
    while (const auto joined = joiner.next()) {
      const LocalFix fix = mapper.absorb(*joined);
      EXPECT_TRUE(is_positive_definite(fix.motion.covariance));
      const double stamp_s = static_cast<double>(utime_of(fix.time)) * 1e-6;
      travel_m += (fix.T_lpm_robot.translation() - last.translation()).norm();
      last = fix.T_lpm_robot;
      track.T_lpm_robot[stamp_s] = fix.T_lpm_robot;
      track.travel_m[stamp_s] = travel_m;
      ++track.scans;
      track.refused += fix.is_matched ? 0 : 1;
    }
  };
  for (const test::CarmenMessage& message : test::read_carmen(test::recorded_data(log))) {
    if (const auto* scan = std::get_if<LaserScan>(&message)) {
      EXPECT_TRUE(validate(*scan).ok());
      joiner.add(*scan);
    } else {
      joiner.add(std::get<OdometrySample>(message));
    }
    drain();
  }
  joiner.flush();
  drain();
  track.restarts = mapper.restarts();
  track.scan_lag_s = mapper.scan_lag_s();
  return track;
}

std::vector<std::vector<double>> rows_of(const std::string& file) {
  std::vector<std::vector<double>> rows;
  std::ifstream lines(test::recorded_data(file));
  std::string line;
  while (std::getline(lines, line)) {
    std::istringstream words(line.substr(0, line.find('#')));
    std::vector<double> row;
    for (double value = 0.0; words >> value;) {
      row.push_back(value);
    }
    if (!row.empty()) {
      rows.push_back(row);
    }
  }
  return rows;
}

/// The stamp of the fix nearest to a time, if there is one within 30 ms.
std::optional<double> stamp_near(const Track& track, double stamp_s) {
  constexpr double kTolerance_s = 0.03;
  const auto after = track.T_lpm_robot.lower_bound(stamp_s - kTolerance_s);
  std::optional<double> nearest;
  for (auto it = after; it != track.T_lpm_robot.end() && it->first <= stamp_s + kTolerance_s;
       ++it) {
    if (!nearest || std::abs(it->first - stamp_s) < std::abs(*nearest - stamp_s)) {
      nearest = it->first;
    }
  }
  return nearest;
}

struct Error {
  double translation_m = 0.0;
  double travel_m = 0.0;  // between both ends
};

std::optional<Error> error_of(const Track& track, double from_s, double to_s, const Pose2& truth) {
  const auto from = stamp_near(track, from_s);
  const auto to = stamp_near(track, to_s);
  if (!from || !to) {
    return std::nullopt;
  }
  const Pose2 found = track.T_lpm_robot.at(*from).inverse() * track.T_lpm_robot.at(*to);
  return Error{(truth.inverse() * found).translation().norm(),
               std::abs(track.travel_m.at(*to) - track.travel_m.at(*from))};
}

std::vector<Error> relation_errors(const Track& track, const std::string& file) {
  std::vector<Error> errors;
  for (const std::vector<double>& row : rows_of(file)) {
    if (const auto error = error_of(track, row[0], row[1], Pose2(row[2], row[3], row[7]))) {
      errors.push_back(*error);
    }
  }
  return errors;
}

/// Errors over stretches of a reference trajectory that are about so long.
std::vector<Error> stretch_errors(const Track& track, const std::string& file, double length_m) {
  const std::vector<std::vector<double>> rows = rows_of(file);
  std::vector<double> along_m(rows.size(), 0.0);
  for (std::size_t i = 1; i < rows.size(); ++i) {
    along_m[i] =
        along_m[i - 1] + std::hypot(rows[i][1] - rows[i - 1][1], rows[i][2] - rows[i - 1][2]);
  }
  std::vector<Error> errors;
  for (std::size_t i = 0, j = 0; i < rows.size(); ++i) {
    while (j < rows.size() && along_m[j] - along_m[i] < length_m) {
      ++j;
    }
    if (j == rows.size()) {
      break;
    }
    const Pose2 truth = Pose2(rows[i][1], rows[i][2], rows[i][3]).inverse() *
                        Pose2(rows[j][1], rows[j][2], rows[j][3]);
    if (const auto error = error_of(track, rows[i][0], rows[j][0], truth)) {
      errors.push_back(*error);
    }
  }
  return errors;
}

double mean_m(const std::vector<Error>& errors) {
  double sum_m = 0.0;
  for (const Error& error : errors) {
    sum_m += error.translation_m;
  }
  return sum_m / static_cast<double>(errors.size());
}

std::vector<Error> within_travel(std::vector<Error> errors, double travel_m) {
  errors.erase(std::remove_if(errors.begin(), errors.end(),
                              [&](const Error& error) { return error.travel_m > travel_m; }),
               errors.end());
  return errors;
}

TEST(LocalMapperOnIntel, StaysTrueOverShortTravelsAndLosesNoScan) {
  CAIRN_NEED_DATA("carmen/intel/intel.relations");
  const Track track = track_of("carmen/intel/intel.clf");
  EXPECT_EQ(track.scans, 4'518U);
  EXPECT_LT(track.refused, 45U);
  const std::vector<Error> errors = relation_errors(track, "carmen/intel/intel.relations");
  ASSERT_GT(errors.size(), 1'000U);
  EXPECT_LT(mean_m(within_travel(errors, 20.0)), 0.12);
  EXPECT_LT(mean_m(errors), 0.6) << "without any loop closed";
}

TEST(LocalMapperOnFr079, StaysTrueOverShortTravels) {
  CAIRN_NEED_DATA("carmen/fr079/fr079.relations");
  const Track track = track_of("carmen/fr079/fr079.clf");
  EXPECT_EQ(track.scans, 4'791U);
  EXPECT_LT(track.refused, 48U);
  const std::vector<Error> errors = relation_errors(track, "carmen/fr079/fr079.relations");
  ASSERT_GT(errors.size(), 1'500U);
  EXPECT_LT(mean_m(within_travel(errors, 20.0)), 0.08);
  EXPECT_LT(mean_m(errors), 0.15);
}

TEST(LocalMapperOnAces, KeepsTrackOfSparseKeyFrames) {
  CAIRN_NEED_DATA("carmen/aces/aces.ref.txt");
  const Track track = track_of("carmen/aces/aces.clf");
  EXPECT_EQ(track.scans, 440U);
  EXPECT_LT(track.refused, 5U);
  const std::vector<Error> errors = stretch_errors(track, "carmen/aces/aces.ref.txt", 5.0);
  ASSERT_GT(errors.size(), 300U);
  EXPECT_LT(mean_m(errors), 0.15);
}

// Turns of 2 rad/s among legs of tables, by scans that are stamped more than a sweep too late.
TEST(LocalMapperInTheMines, FindsTheLagOfTheScansAndNeverLosesTheWay) {
  CAIRN_NEED_DATA("laser/mines/exp1.clf");
  const Track track = track_of("laser/mines/exp1.clf");
  EXPECT_EQ(track.scans, 756U);
  EXPECT_EQ(track.restarts, 0);
  EXPECT_LT(track.refused, 46U);
  EXPECT_GT(track.scan_lag_s, 0.08);
  EXPECT_LT(track.scan_lag_s, 0.22);
}

TEST(LocalMapperOnADukeCorridor, RefusesNoScan) {
  CAIRN_NEED_DATA("laser/duke_loop5/loop5.clf");
  const Track track = track_of("laser/duke_loop5/loop5.clf");
  EXPECT_EQ(track.refused, 1U) << "the first, which has nothing to be matched with";
  EXPECT_EQ(track.restarts, 0);
}

}  // namespace
}  // namespace cairn
