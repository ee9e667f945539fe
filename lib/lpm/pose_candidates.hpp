#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "geometry/gaussian_pose.hpp"
#include "lpm/global_localiser_options.hpp"
#include "lpm/global_search.hpp"
#include "lpm/global_search_run.hpp"

namespace cairn {

/// Poses that a robot may have in a known map, and how well each explains the same key scans.
///
/// A candidate is a trajectory: it is followed from one key scan to the next, and back to those
/// before it was thought of, each time to the best pose near where motion places it. That may be
/// done in slices.
class PoseCandidates {
 public:
  /// A scan that all candidates have to explain.
  struct KeyScan {
    std::vector<SurfacePoint> points;
    GaussianPose T_before_this;  ///< From the key scan before.
    double travel_m = 0.0;
  };
  /// A trajectory through the map.
  struct Candidate {
    GaussianPose T_map_first;   ///< At the first key scan that it was followed to,
    GaussianPose T_map_last;    ///< and at the last.
    std::int64_t last = 0;      ///< The number of that key scan.
    std::int64_t id = 0;        ///< No two of them have the same.
    std::deque<double> scores;  ///< One for each key scan between the two.
    [[nodiscard]] double mean_score() const;
  };

  /// @param search must outlive this object
  PoseCandidates(const GlobalSearch& search, const GlobalLocaliserOptions& options);

  /// The oldest of them goes where there are too many.
  void add_key_scan(KeyScan scan);
  [[nodiscard]] const std::deque<KeyScan>& key_scans() const { return key_scans_; }
  /// Of the newest key scan, counting up from 0.
  [[nodiscard]] std::int64_t newest() const { return newest_; }

  /// A pose that the robot may have had at the newest key scan.
  void put_forward(const GaussianPose& T_map_robot);
  /// Every candidate has been followed to every key scan.
  [[nodiscard]] bool is_settled() const { return !following_ && !due().has_value(); }
  /// Follows candidates until it is settled or so many cells were looked up. Those that can no more
  /// come close to the best one are dropped.
  /// @return how many were looked up
  std::int64_t work(std::int64_t lookups);
  /// Best first; those that are the same, or much worse than the best, go.
  void rank();
  /// The best is the one: it stays whatever comes. @pre there is one
  void keep_best();
  void clear();

  [[nodiscard]] const std::vector<Candidate>& all() const { return candidates_; }
  /// How much better the best is than the next one, >= 0. @pre ranked
  [[nodiscard]] double margin() const;
  /// How well the key scans of late are explained by another pose at the newest one. In one go.
  [[nodiscard]] double mean_score_of(const GlobalMatch& match, std::size_t scans) const;

 private:
  /// What is to be explained next, and by which candidate.
  struct Step {
    std::size_t candidate = 0;
    std::int64_t key_scan = 0;
    bool is_back = false;
  };
  struct Following {
    Step step;
    GaussianPose predicted;
    GlobalSearchRun run;
  };

  [[nodiscard]] std::int64_t oldest() const {
    return newest_ + 1 - static_cast<std::int64_t>(key_scans_.size());
  }
  [[nodiscard]] const KeyScan& key_scan(std::int64_t number) const {
    return key_scans_[static_cast<std::size_t>(number - oldest())];
  }
  [[nodiscard]] std::optional<Step> due() const;
  [[nodiscard]] GaussianPose predicted(const Step& step) const;
  [[nodiscard]] GlobalQuery window_around(const GaussianPose& predicted) const;
  void take(const Following& following);
  [[nodiscard]] bool is_hopeless(const Candidate& candidate) const;

  const GlobalSearch& search_;
  GlobalLocaliserOptions options_;
  std::deque<KeyScan> key_scans_;  // oldest first
  std::int64_t newest_ = -1;
  std::int64_t next_id_ = 0;
  std::vector<Candidate> candidates_;
  std::optional<Following> following_;
  double best_score_ = 0.0;  // as of the last ranking
  bool is_chosen_ = false;
};

}  // namespace cairn
