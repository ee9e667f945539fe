#include "lpm/global_localiser.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/check.hpp"
#include "base/validator.hpp"

namespace cairn {
namespace {

/// So many key scans must have been searched for: with one of them a rival would have been found.
constexpr int kLeastSearches = 3;
constexpr double kUsualScoreGain = 0.05;  // per key scan

}  // namespace

Status validate(const GlobalLocaliserOptions& options) {
  return Validator("lpm.global_localiser")
      .positive("key_scan_every_m", options.key_scan_every_m)
      .positive("key_scan_every_rad", options.key_scan_every_rad)
      .within("candidates", options.candidates, 2, 100)
      .within("key_scans", options.key_scans, 2, 100)
      .within("accept_travel_m", options.accept_travel_m, 0.0, 1000.0)
      .within("accept_score", options.accept_score, 0.0, 1.0)
      .within("accept_margin", options.accept_margin, 0.0, 1.0)
      .within("confirm_key_scans", options.confirm_key_scans, 1, 100)
      .within("drop_margin", options.drop_margin, 0.0, 1.0)
      .positive("follow_range_m", options.follow_range_m)
      .positive("follow_turn_rad", options.follow_turn_rad)
      .within("doubt_drop", options.doubt_drop, 0.0, 1.0)
      .within("lost_drop", options.lost_drop, 0.0, 1.0)
      .status();
}

std::string_view to_string(Localisation state) {
  switch (state) {
    case Localisation::kSearching:
      return "searching";
    case Localisation::kAccepted:
      return "accepted";
    case Localisation::kTracking:
      return "tracking";
    case Localisation::kLost:
      return "lost";
  }
  return "unknown";
}

GlobalLocaliser::GlobalLocaliser(const GlobalSearch& search, const GlobalLocaliserOptions& options)
    : search_(search), options_(options), candidates_(search, options) {
  CAIRN_CHECK(validate(options).ok());
}

GlobalFix GlobalLocaliser::absorb(const std::vector<SurfacePoint>& points,
                                  const GaussianPose& step,
                                  std::int64_t lookups) {
  if (!candidates_.key_scans().empty()) {
    T_key_robot_ = compounded(T_key_robot_, step);
    travel_m_ += step.mean.translation().norm();
  }
  const bool is_key = is_key_scan();
  if (is_key) {
    add_key_scan(points);
  }
  if (!is_localised_) {
    return search(lookups);
  }
  return is_key ? track() : summary(Localisation::kTracking);
}

GlobalFix GlobalLocaliser::summary(Localisation state) const {
  GlobalFix fix;
  fix.state = state;
  if (!candidates_.all().empty()) {
    const PoseCandidates::Candidate& best = candidates_.all().front();
    fix.score = best.mean_score();
    fix.margin = margin_;
    if (is_localised_) {
      fix.T_map_robot = compounded(best.T_map_last, T_key_robot_);
    }
  }
  return fix;
}

bool GlobalLocaliser::is_key_scan() const {
  return candidates_.key_scans().empty() ||
         T_key_robot_.mean.translation().norm() >= options_.key_scan_every_m ||
         std::abs(T_key_robot_.mean.theta()) >= options_.key_scan_every_rad;
}

void GlobalLocaliser::add_key_scan(const std::vector<SurfacePoint>& points) {
  candidates_.add_key_scan({points, T_key_robot_, travel_m_});
  if (running_) {
    running_->T_then_now = compounded(running_->T_then_now, T_key_robot_);
  }
  T_key_robot_ = {};
  is_rank_due_ = true;
}

/// Candidates are followed first, so that they are up to date when others are found.
GlobalFix GlobalLocaliser::search(std::int64_t lookups) {
  while (lookups > 0) {
    if (!candidates_.is_settled()) {
      lookups -= candidates_.work(lookups);
    } else if (is_rank_due_) {
      is_rank_due_ = false;
      candidates_.rank();
      margin_ = candidates_.margin();
      if (is_confirmed()) {
        return accepted();
      }
    } else if (running_) {
      lookups -= search_on(lookups);
    } else if (is_begun_with_newest()) {
      break;
    } else {
      begin_search();
    }
  }
  return summary(Localisation::kSearching);
}

bool GlobalLocaliser::is_begun_with_newest() const {
  return begun_ == candidates_.newest();
}

void GlobalLocaliser::begin_search() {
  // Who is to rival a pose that is accepted has some key scan with no less than this.
  const double least_score = std::max(options_.accept_score - options_.accept_margin, 0.0);
  running_.emplace(Search{GlobalSearchRun(search_, candidates_.key_scans().back().points,
                                          {options_.candidates, least_score}),
                          {}});
  begun_ = candidates_.newest();
}

std::int64_t GlobalLocaliser::search_on(std::int64_t lookups) {
  const std::int64_t before = running_->run.lookups();
  running_->run.work(lookups);
  const std::int64_t done = std::max<std::int64_t>(running_->run.lookups() - before, 1);
  if (running_->run.is_done()) {
    ++searches_;
    ++searches_since_start_;
    for (const GlobalMatch& match : running_->run.found()) {
      candidates_.put_forward(compounded(match.T_map_robot, running_->T_then_now));
    }
    is_rank_due_ = true;
    running_.reset();
  }
  return done;
}

bool GlobalLocaliser::is_acceptable() const {
  const std::deque<PoseCandidates::KeyScan>& scans = candidates_.key_scans();
  return !candidates_.all().empty() &&
         scans.size() == static_cast<std::size_t>(options_.key_scans) &&
         scans.back().travel_m - scans.front().travel_m >= options_.accept_travel_m &&
         searches_since_start_ >= kLeastSearches &&
         candidates_.all().front().mean_score() >= options_.accept_score &&
         margin_ >= options_.accept_margin;
}

/// One lucky scan is soon over: a pose has to stay acceptable.
bool GlobalLocaliser::is_confirmed() {
  if (!is_acceptable()) {
    confirmed_ = {};
    return false;
  }
  const std::int64_t best = candidates_.all().front().id;
  if (confirmed_.candidate != best) {
    confirmed_ = {best, candidates_.newest(), 0};
  }
  if (confirmed_.times == 0 || confirmed_.key_scan != candidates_.newest()) {
    ++confirmed_.times;
    confirmed_.key_scan = candidates_.newest();
  }
  return confirmed_.times >= options_.confirm_key_scans;
}

GlobalFix GlobalLocaliser::accepted() {
  confirmed_ = {};
  is_localised_ = true;
  usual_score_ = candidates_.all().front().mean_score();
  candidates_.keep_best();
  running_.reset();
  return summary(Localisation::kAccepted);
}

GlobalFix GlobalLocaliser::track() {
  while (!candidates_.is_settled()) {
    candidates_.work(std::numeric_limits<std::int64_t>::max());
  }
  if (!candidates_.all().empty() && is_still_there()) {
    return summary(Localisation::kTracking);
  }
  is_localised_ = false;
  const GlobalFix fix = summary(Localisation::kLost);
  candidates_.clear();
  searches_since_start_ = 0;
  T_key_robot_ = {};
  return fix;
}

/// Whether the key scans of late still speak for where the robot is said to be.
bool GlobalLocaliser::is_still_there() {
  const std::deque<double>& scores = candidates_.all().front().scores;
  const std::size_t late = std::max<std::size_t>(scores.size() / 3, 1);
  const double late_score =
      std::accumulate(scores.end() - static_cast<std::ptrdiff_t>(late), scores.end(), 0.0) /
      static_cast<double>(late);
  if (late_score < usual_score_ - options_.lost_drop) {
    return false;
  }
  if (late_score < usual_score_ - options_.doubt_drop) {
    return !has_better(late, late_score + options_.doubt_drop);
  }
  usual_score_ += kUsualScoreGain * (late_score - usual_score_);
  return true;
}

bool GlobalLocaliser::has_better(std::size_t late, double score) {
  ++searches_;
  const std::vector<GlobalMatch> matches =
      search_.find(candidates_.key_scans().back().points, {options_.candidates});
  return std::any_of(matches.begin(), matches.end(), [&](const GlobalMatch& match) {
    return candidates_.mean_score_of(match, late) > score;
  });
}

}  // namespace cairn
