#include "grid/axis_update.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "grid/axis_graph.hpp"
#include "grid/cell_runs.hpp"

namespace cairn {
namespace {

/// To follow a change costs so many times as much by cell as to start anew.
constexpr std::size_t kCostOfFollowing = 30;

bool is_wider(CellOffset a, CellOffset b, std::int64_t dot, double max_cosine) {
  return static_cast<double>(dot) <
         max_cosine * Vector2d(a.dx, a.dy).norm() * Vector2d(b.dx, b.dy).norm();
}

/// Whether the angle between the basis points of two neighbours, each seen from its own cell, is
/// larger than that of the cosine.
inline bool look_apart(CellOffset a, CellOffset b, double max_cosine) {
  const std::int64_t dot = std::int64_t{a.dx} * b.dx + std::int64_t{a.dy} * b.dy;
  // Most neighbours look to the same wall: no roots needed.
  return (dot < 0 || max_cosine > 0.0) && is_wider(a, b, dot, max_cosine);
}

/// Appends the positions of the bytes that are set, ascending.
void list_cells(const std::uint8_t* bytes, std::size_t size, std::vector<std::uint32_t>* cells) {
  for_each_run(bytes, 0, size, [&](std::size_t first, std::size_t last) {
    for (std::size_t at = first; at < last; ++at) {
      cells->push_back(static_cast<std::uint32_t>(at));
    }
  });
}

}  // namespace

MedialAxis AxisUpdate::first(const DistanceTransform& distances,
                             Cell start,
                             const MedialAxisOptions& options) {
  options_ = options;
  max_cosine_ = std::cos(options.min_basis_angle_rad);
  find_component(distances, start);
  begin(distances);
  return traced(distances);
}

MedialAxis AxisUpdate::next(const DistanceTransform& distances,
                            const std::vector<std::uint32_t>& changed,
                            Cell moved,
                            Cell start,
                            const MedialAxisOptions& options) {
  const GridWindow& window = distances.window();
  if (options != options_ || !thinning_.is_of_size(window.width, window.height)) {
    return first(distances, start, options);
  }
  find_component(distances, start);
  const bool has_moved = moved != Cell{};
  note_changes(changed, has_moved, static_cast<std::uint32_t>(window.width));
  if (seeds_.size() * kCostOfFollowing > member_count_) {
    begin(distances);
  } else {
    if (has_moved) {
      thinning_.shift(moved);
    }
    follow(distances);
  }
  return traced(distances);
}

/// Members of the component about which something is new.
void AxisUpdate::note_changes(const std::vector<std::uint32_t>& changed,
                              bool has_moved,
                              std::uint32_t width) {
  noted_.resize(members_.size(), 0);
  for (const std::uint32_t at : changed) {
    const std::uint32_t padded = at + (width + 2) + 1 + 2 * (at / width);
    noted_[padded] = members_.has(padded) ? 1 : 0;
  }
  if (has_moved) {
    note_border();
  }
  seeds_.clear();
  list_cells(noted_.data(), noted_.size(), &seeds_);
  for (const std::uint32_t at : seeds_) {
    noted_[at] = 0;
  }
}

void AxisUpdate::find_component(const DistanceTransform& distances, Cell start) {
  component_.find(distances, start, options_.min_clearance_m);
  members_.clear(distances.window().width, distances.window().height);
  member_count_ = 0;
  for (const CellRun& run : component_.runs()) {
    std::uint8_t* const row =
        members_.data() + members_.index_of(0, static_cast<std::size_t>(run.y));
    std::fill(row + run.first, row + run.last, std::uint8_t{1});
    member_count_ += static_cast<std::size_t>(run.last - run.first);
  }
}

void AxisUpdate::begin(const DistanceTransform& distances) {
  const GridWindow& window = distances.window();
  thinning_.clear(window.width, window.height);
  thinning_.set = members_;
  for (const CellRun& run : component_.runs()) {
    const auto y = static_cast<std::size_t>(run.y);
    const std::size_t row = y * static_cast<std::size_t>(window.width);
    const std::size_t padded_row = members_.index_of(0, y);
    for (auto x = static_cast<std::size_t>(run.first); x < static_cast<std::size_t>(run.last);
         ++x) {
      thinning_.squared[padded_row + x] = distances.squared_clearances_cells()[row + x];
      if (is_ridge(distances, row + x, padded_row + x)) {
        thinning_.kept.add(padded_row + x);
      }
    }
  }
  sort_by_clearance(members_);
  thinning_.thin(order_);
}

void AxisUpdate::follow(const DistanceTransform& distances) {
  note_members();
  const auto stride = static_cast<std::uint32_t>(members_.stride());
  const std::size_t count = seeds_.size();
  const auto index_of = [stride](std::uint32_t padded) {
    return padded - stride - 1 - 2 * (padded / stride - 1);
  };
  for (std::size_t i = 0; i < count; ++i) {
    if (members_.has(seeds_[i])) {
      thinning_.squared[seeds_[i]] = distances.squared_clearances_cells()[index_of(seeds_[i])];
    }
  }
  const auto renew = [&](std::uint32_t at) {
    const bool is_kept = members_.has(at) && is_ridge(distances, index_of(at), at);
    if (is_kept != thinning_.kept.has(at)) {
      thinning_.kept.put(at, is_kept);
      seeds_.push_back(at);
    }
  };
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t at = seeds_[i];
    for (const std::uint32_t near : {at, at - 1, at + 1, at - stride, at + stride}) {
      renew(near);
    }
  }
  thinning_.update(seeds_);
}

/// Takes the component over; cells that joined or left it have changed.
void AxisUpdate::note_members() {
  const std::uint8_t* const now = members_.data();
  const std::uint8_t* const was = thinning_.set.data();
  for (std::size_t at = 0; at < members_.size(); at += members_.stride()) {
    if (std::memcmp(now + at, was + at, members_.stride()) == 0) {
      continue;
    }
    for (std::size_t i = at; i < at + members_.stride(); ++i) {
      if (now[i] != was[i]) {
        seeds_.push_back(static_cast<std::uint32_t>(i));
      }
    }
  }
  thinning_.set = members_;
}

/// Cells at the border may have had neighbours beyond it.
void AxisUpdate::note_border() {
  const auto stride = static_cast<std::uint32_t>(members_.stride());
  const auto size = static_cast<std::uint32_t>(members_.size());
  const auto note = [&](std::uint32_t at) {
    if (members_.has(at)) {
      noted_[at] = 1;
    }
  };
  for (std::uint32_t x = 1; x + 1 < stride; ++x) {
    note(stride + x);
    note(size - 2 * stride + x);
  }
  for (std::uint32_t row = stride; row + stride < size; row += stride) {
    note(row + 1);
    note(row + stride - 2);
  }
}

/// Where two neighbours look to different walls, the one with the larger clearance is on the ridge;
/// of equals the left or lower one.
bool AxisUpdate::is_ridge(const DistanceTransform& distances,
                          std::size_t at,
                          std::size_t padded) const {
  const std::size_t stride = members_.stride();
  const std::size_t width = stride - 2;
  const CellOffset* const to_basis = distances.basis_offsets().data();
  const std::int32_t* const squared = distances.squared_clearances_cells().data();
  const auto is_above_before = [&](std::size_t beside, std::size_t beside_padded) {
    return members_.has(beside_padded) && squared[beside] < squared[at] &&
           look_apart(to_basis[beside], to_basis[at], max_cosine_);
  };
  const auto is_above_next = [&](std::size_t beside, std::size_t beside_padded) {
    return members_.has(beside_padded) && squared[at] >= squared[beside] &&
           look_apart(to_basis[at], to_basis[beside], max_cosine_);
  };
  return is_above_next(at + 1, padded + 1) || is_above_next(at + width, padded + stride) ||
         is_above_before(at - 1, padded - 1) || is_above_before(at - width, padded - stride);
}

/// Puts the cells of a set in order, the least clearance first; of equals the lowest index. A
/// counting sort; what nothing bounds comes last, in a bucket of its own.
void AxisUpdate::sort_by_clearance(const PaddedCells& set) {
  cells_.clear();
  list_cells(set.data(), set.size(), &cells_);
  const std::int32_t* const squared = thinning_.squared.data();
  std::int32_t most = 0;
  for (const std::uint32_t at : cells_) {
    most = squared[at] == DistanceTransform::kUnbounded ? most : std::max(most, squared[at]);
  }
  const auto bucket_of = [=](std::uint32_t at) {
    return static_cast<std::size_t>(std::min(squared[at], most + 1));
  };
  bucket_.assign(static_cast<std::size_t>(most) + 3, 0);
  for (const std::uint32_t at : cells_) {
    ++bucket_[bucket_of(at) + 1];
  }
  for (std::size_t i = 1; i < bucket_.size(); ++i) {
    bucket_[i] += bucket_[i - 1];
  }
  order_.resize(cells_.size());
  for (const std::uint32_t at : cells_) {
    order_[bucket_[bucket_of(at)]++] = at;
  }
}

/// Thins what is left to lines, and reads these as a graph.
MedialAxis AxisUpdate::traced(const DistanceTransform& distances) {
  skeleton_ = thinning_.left();
  sort_by_clearance(skeleton_);
  thin_lines(&order_, &skeleton_);
  if (order_.empty()) {
    return {};
  }
  return pruned(traced_axis(skeleton_, order_, distances), options_.coastal_distance_m, distances);
}

}  // namespace cairn
