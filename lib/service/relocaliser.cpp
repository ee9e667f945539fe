#include "service/relocaliser.hpp"

#include <array>
#include <cmath>
#include <cstdio>

#include "base/check.hpp"
#include "base/validator.hpp"
#include "lpm/surface_points.hpp"

namespace cairn {
namespace {

constexpr double kPointSpacing_m = 0.05;
constexpr double kMaxRange_m = 15.0;
constexpr std::size_t kLeastPoints = 20;  // fewer say nothing of where the robot is

// In lookups of the search, about.
constexpr double kWorkPerDrawnCell = 4.0;
constexpr std::int64_t kWorkPerCopiedCell = 8;
constexpr std::int64_t kWorkPerPreparedCell = 2;

GlobalMapOptions drawing(const RelocalisationOptions& options) {
  GlobalMapOptions drawing;
  drawing.cell_m = options.cell_m;
  return drawing;
}

/// Scans after some travel each: more of them would only cost time.
std::vector<PosedScan> thinned(const std::vector<PosedScan>& seen, double every_m) {
  std::vector<PosedScan> chosen;
  for (const PosedScan& scan : seen) {
    if (!scan.is_trusted) {
      continue;
    }
    const bool is_due =
        chosen.empty() ||
        (scan.T_global_robot.translation() - chosen.back().T_global_robot.translation()).norm() >=
            every_m;
    if (is_due) {
      chosen.push_back(scan);
    }
  }
  return chosen;
}

}  // namespace

Status validate(const RelocalisationOptions& options) {
  return Validator("relocalisation")
      .within("cell_m", options.cell_m, 0.05, 1.0)
      .within("max_cells", options.max_cells, 1000, 20'000'000)
      .within("draw_every_m", options.draw_every_m, 0.0, 10.0)
      .within("lookups_per_scan", options.lookups_per_scan, 10'000, 1'000'000'000)
      .within("max_searches", options.max_searches, 1, 100'000)
      .within("accept_travel_m", options.accept_travel_m, 0.0, 1000.0)
      .within("accept_score", options.accept_score, 0.0, 1.0)
      .within("accept_margin", options.accept_margin, 0.0, 1.0)
      .status();
}

std::string to_text(const Relocalisation& found) {
  const auto sigma = [&found](int i) { return std::sqrt(found.T_global_robot.covariance(i, i)); };
  const Pose2& pose = found.T_global_robot.mean;
  std::array<char, 256> text{};
  static_cast<void>(std::snprintf(
      text.data(), text.size(),
      "relocalised %.1f m from place %d, at (%.2f, %.2f) m and %.2f rad of the global map, "
      "give or take %.2f m, %.2f m and %.3f rad; score %.2f, margin %.2f, after %.1f m of travel",
      found.distance_m, found.place, pose.x(), pose.y(), pose.theta(), sigma(0), sigma(1), sigma(2),
      found.score, found.margin, found.travel_m));
  return text.data();
}

Relocaliser::Relocaliser(const RelocalisationOptions& options)
    : options_(options), map_(drawing(options)) {
  CAIRN_CHECK(validate(options).ok());
}

void Relocaliser::start(const std::vector<PosedScan>& seen) {
  stop();
  if (options_.looks && !seen.empty()) {
    seen_ = thinned(seen, options_.draw_every_m);
    stage_ = Stage::kDrawing;
  }
}

void Relocaliser::stop() {
  const RelocalisationOptions options = options_;
  localiser_.reset();  // before what it refers to
  *this = Relocaliser(options);
}

std::optional<Relocalisation> Relocaliser::absorb(const LaserScan& scan,
                                                  const GaussianPose& motion) {
  if (!is_searching()) {
    return std::nullopt;
  }
  motion_ = compounded(motion_, motion);
  travel_m_ += motion.mean.translation().norm();
  std::int64_t lookups = options_.lookups_per_scan;
  if (stage_ == Stage::kDrawing) {
    lookups = draw(lookups);
  }
  if (stage_ == Stage::kCopying) {
    lookups = copy(lookups);
  }
  if (stage_ == Stage::kPreparing) {
    lookups = prepare(lookups);
  }
  return stage_ == Stage::kSearching ? search(scan, lookups) : std::nullopt;
}

std::int64_t Relocaliser::draw(std::int64_t lookups) {
  while (!seen_.empty() && lookups > 0) {
    const auto beams = static_cast<double>(seen_.back().scan->ranges_m.size());
    const double cells_per_beam = map_.options().draw_range_m / options_.cell_m;
    lookups -= static_cast<std::int64_t>(beams * cells_per_beam * kWorkPerDrawnCell);
    drawn_.push_back(std::move(seen_.back()));
    seen_.pop_back();
  }
  static_cast<void>(map_.draw(drawn_));
  if (!seen_.empty()) {
    return 0;
  }
  Result<OccupancyGrid> grid = map_.empty_grid(static_cast<std::size_t>(options_.max_cells));
  if (!grid) {
    stop();
    return 0;
  }
  grid_ = *std::move(grid);
  tiles_ = map_.tiles();
  stage_ = Stage::kCopying;
  return lookups;
}

std::int64_t Relocaliser::copy(std::int64_t lookups) {
  const int side = map_.options().tile_cells;
  while (!tiles_.empty() && lookups > 0) {
    map_.copy_tile(tiles_.back(), &grid_);
    tiles_.pop_back();
    lookups -= static_cast<std::int64_t>(side) * side * kWorkPerCopiedCell;
  }
  if (tiles_.empty()) {
    search_ = std::make_unique<GlobalSearch>(grid_.geometry(), GlobalSearchOptions());
    stage_ = Stage::kPreparing;
  }
  return lookups;
}

std::int64_t Relocaliser::prepare(std::int64_t lookups) {
  if (lookups > 0) {
    search_->take(grid_, lookups / kWorkPerPreparedCell);
  }
  if (!search_->is_taken()) {
    return 0;
  }
  map_ = GlobalMap(drawing(options_));  // neither is needed any more
  drawn_.clear();
  grid_ = {};
  GlobalLocaliserOptions localiser;
  localiser.accept_travel_m = options_.accept_travel_m;
  localiser.accept_score = options_.accept_score;
  localiser.accept_margin = options_.accept_margin;
  localiser_ = std::make_unique<GlobalLocaliser>(*search_, localiser);
  stage_ = Stage::kSearching;
  return 0;
}

std::optional<Relocalisation> Relocaliser::search(const LaserScan& scan, std::int64_t lookups) {
  const std::vector<SurfacePoint> points = surface_points_of(scan, kPointSpacing_m, kMaxRange_m);
  if (points.size() < kLeastPoints) {
    return std::nullopt;
  }
  const GlobalFix fix = localiser_->absorb(points, motion_, lookups);
  motion_ = {};
  if (fix.state == Localisation::kAccepted && fix.T_map_robot) {
    Relocalisation found;
    found.time = scan.time;
    found.T_global_robot = *fix.T_map_robot;
    found.score = fix.score;
    found.margin = fix.margin;
    found.travel_m = travel_m_;
    stop();
    return found;
  }
  if (localiser_->searches() >= options_.max_searches) {
    stop();
  }
  return std::nullopt;
}

}  // namespace cairn
