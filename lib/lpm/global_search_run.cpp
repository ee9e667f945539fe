#include "lpm/global_search_run.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

namespace cairn {
namespace {

constexpr std::int64_t kWorkOfRefinement = 5'000;  // in lookups, about
constexpr int kBuckets = 1024;
constexpr int kDivesPerPose = 4;

template <typename Block>
bool is_better_block(const Block& a, const Block& b) {
  return std::tie(b.score, a.group, a.low) < std::tie(a.score, b.group, b.low);
}

}  // namespace

GlobalSearchRun::GlobalSearchRun(const GlobalSearch& search,
                                 const std::vector<SurfacePoint>& points,
                                 const GlobalQuery& query)
    : search_(search),
      query_(query),
      points_(search.chosen(points)),
      turned_(
          points_, search.geometry().cell_m, query.window.center.theta(), query.window.turn_rad),
      box_(box_of(query.window)),
      open_(kBuckets + 1),
      cut_(query.min_score) {
  if (!points_.empty() && query.count > 0) {
    choose_top_blocks();
  }
  if (top_cells_.empty() || turned_.angle_count() == 0) {
    phase_ = Phase::kDone;
  }
}

GlobalSearchRun::Box GlobalSearchRun::box_of(const GlobalWindow& window) const {
  const GridGeometry& map = search_.geometry();
  const auto clamped = [&map](double x_m, double y_m) {
    const double x = std::floor((x_m - map.origin_m.x()) / map.cell_m);
    const double y = std::floor((y_m - map.origin_m.y()) / map.cell_m);
    return Cell{static_cast<int>(std::clamp(x, -1.0, 1.0 * map.width)),
                static_cast<int>(std::clamp(y, -1.0, 1.0 * map.height))};
  };
  Box box{clamped(window.center.x() - window.range_m, window.center.y() - window.range_m),
          clamped(window.center.x() + window.range_m, window.center.y() + window.range_m)};
  box.low = {std::max(box.low.x, 0), std::max(box.low.y, 0)};
  box.high = {std::min(box.high.x, map.width - 1), std::min(box.high.y, map.height - 1)};
  return box;
}

void GlobalSearchRun::choose_top_blocks() {
  const int widest = std::max(box_.high.x - box_.low.x, box_.high.y - box_.low.y) + 1;
  while (top_ + 1 < TurnedScans::kLevels && (2 << top_) <= widest) {
    ++top_;
  }
  for (int y = box_.low.y; y <= box_.high.y; y += 1 << top_) {
    for (int x = box_.low.x; x <= box_.high.x; x += 1 << top_) {
      if (is_possible({x, y}, top_)) {
        top_cells_.push_back({x, y});
      }
    }
  }
}

bool GlobalSearchRun::is_possible(Cell low, int level) const {
  return low.x <= box_.high.x && low.y <= box_.high.y && search_.fits(low, 1 << level);
}

void GlobalSearchRun::work(std::int64_t lookups) {
  const std::int64_t before = this->lookups();
  while (phase_ != Phase::kDone && this->lookups() - before < lookups) {
    switch (phase_) {
      case Phase::kOpening:
        open_next();
        break;
      case Phase::kDiving:
        dive_next();
        break;
      default:
        search_on();
    }
  }
}

/// Opens a few blocks of the highest level.
void GlobalSearchRun::open_next() {
  if (next_group_ == turned_.group_count(top_)) {
    choose_dives();
    phase_ = Phase::kDiving;
    return;
  }
  Blocks blocks{top_, static_cast<std::int32_t>(next_group_), 0, {}};
  while (blocks.count < kAtOnce && next_top_ < top_cells_.size()) {
    blocks.lows[blocks.count++] = top_cells_[next_top_++];
  }
  if (next_top_ == top_cells_.size()) {
    next_top_ = 0;
    ++next_group_;
  }
  parts_.clear();
  open(blocks, 1.0, &parts_);
  std::for_each(parts_.begin(), parts_.end(), [this](const Block& part) { push(part); });
}

/// The most promising blocks: a good pose found early saves looking for worse ones.
void GlobalSearchRun::choose_dives() {
  const auto most = static_cast<std::size_t>(query_.count * kDivesPerPose);
  for (std::size_t bucket = open_.size(); bucket-- > 0 && dives_.size() < most;) {
    for (std::size_t i = 0; i < open_[bucket].size() && dives_.size() < most; ++i) {
      dives_.push_back(open_[bucket][i]);
    }
  }
  std::reverse(dives_.begin(), dives_.end());
}

/// From a block by the best of its parts down to a pose.
void GlobalSearchRun::dive_next() {
  if (dives_.empty()) {
    phase_ = Phase::kSearching;
    return;
  }
  Block best = dives_.back();
  dives_.pop_back();
  while (best.level > 0) {
    open_parts(best, &parts_);
    if (parts_.empty()) {
      return;
    }
    best = *std::max_element(parts_.begin(), parts_.end(),
                             [](const Block& a, const Block& b) { return a.score < b.score; });
  }
  raise_cut(best);
}

/// Takes one of the most promising blocks.
void GlobalSearchRun::search_on() {
  while (highest_ > 0 && open_[highest_].empty()) {
    --highest_;
  }
  std::vector<Block>& best = open_[highest_];
  if (best.empty()) {
    phase_ = Phase::kDone;
    return;
  }
  const auto whole =
      std::find_if(best.rbegin(), best.rend(), [](const Block& block) { return block.level > 0; });
  if (whole != best.rend()) {
    const Block block = *whole;
    *whole = best.back();
    best.pop_back();
    open_parts(block, &parts_);
    std::for_each(parts_.begin(), parts_.end(), [this](const Block& part) { push(part); });
    return;
  }
  // Poses alone: none that is to come is as good.
  std::vector<Block> leaves;
  leaves.swap(best);
  std::sort(leaves.begin(), leaves.end(), is_better_block<Block>);
  for (std::size_t i = 0; i < leaves.size() && phase_ != Phase::kDone; ++i) {
    take_up(leaves[i]);
  }
}

void GlobalSearchRun::open_parts(const Block& whole, std::vector<Block>* parts) {
  parts->clear();
  const int level = whole.level - 1;
  const auto narrower =
      static_cast<std::int32_t>(turned_.group_size(whole.level) / turned_.group_size(level));
  const int half = 1 << level;
  for (std::int32_t i = 0; i < narrower; ++i) {
    const std::int32_t group = whole.group * narrower + i;
    if (static_cast<std::size_t>(group) < turned_.group_count(level)) {
      Blocks blocks{level, group, 0, {}};
      for (const Cell& by : {Cell{0, 0}, Cell{half, 0}, Cell{0, half}, Cell{half, half}}) {
        const Cell low{whole.low.x + by.x, whole.low.y + by.y};
        if (is_possible(low, level)) {
          blocks.lows[blocks.count++] = low;
        }
      }
      open(blocks, whole.score, parts);
    }
  }
}

/// Keeps those that may hold a pose that is found.
void GlobalSearchRun::open(Blocks blocks, double may_be, std::vector<Block>* opened) {
  if (blocks.count == 0) {
    return;
  }
  std::fill(blocks.lows.begin() + static_cast<std::ptrdiff_t>(blocks.count), blocks.lows.end(),
            blocks.lows.front());
  const Scores scores = bounds_of(blocks);
  for (std::size_t k = 0; k < blocks.count; ++k) {
    const double score = std::min(scores[k], may_be);
    if (score >= cut_) {
      opened->push_back({score, blocks.level, blocks.group, blocks.lows[k]});
    }
  }
}

void GlobalSearchRun::push(const Block& block) {
  const auto bucket = static_cast<std::size_t>(block.score * kBuckets);
  open_[bucket].push_back(block);
  highest_ = std::max(highest_, bucket);
  if (block.level == 0) {
    raise_cut(block);
  }
}

Pose2 GlobalSearchRun::pose_of(const Block& leaf) const {
  return {search_.geometry().center_of(leaf.low),
          turned_.angle_rad(static_cast<std::size_t>(leaf.group))};
}

/// A pose that is found is no neighbour of two that are two neighbourhoods apart. So of so many
/// poses apart from each other, each is found, or has its own better one that is.
void GlobalSearchRun::raise_cut(const Block& leaf) {
  const Pose2 pose = pose_of(leaf);
  const auto is_near = [&](const Block& other) {
    return search_.is_near(pose, pose_of(other), 2.0);
  };
  const auto near = std::find_if(apart_.begin(), apart_.end(), is_near);
  if (near == apart_.end()) {
    apart_.push_back(leaf);
  } else if (near->score < leaf.score &&
             std::find_if(near + 1, apart_.end(), is_near) == apart_.end()) {
    *near = leaf;
  } else {
    return;
  }
  std::sort(apart_.begin(), apart_.end(), is_better_block<Block>);
  const auto count = static_cast<std::size_t>(query_.count);
  if (apart_.size() >= count) {
    apart_.resize(count);
    cut_ = std::max(cut_, apart_.back().score - kRounding);
  }
}

void GlobalSearchRun::take_up(const Block& leaf) {
  const Pose2 pose = pose_of(leaf);
  const bool is_new = std::none_of(found_.begin(), found_.end(), [&](const GlobalMatch& better) {
    return search_.is_near(pose, better.raster_pose, 1.0);
  });
  if (is_new) {
    found_.push_back(search_.refined(points_, pose, leaf.score));
    lookups_ += kWorkOfRefinement;
    if (found_.size() >= static_cast<std::size_t>(query_.count)) {
      phase_ = Phase::kDone;
    }
  }
}

}  // namespace cairn
