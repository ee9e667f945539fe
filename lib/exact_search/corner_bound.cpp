#include "exact_search/corner_bound.hpp"

#include <algorithm>

namespace cairn {
namespace {

int above_four(int corners) {
  return std::max(0, corners - 4);
}

}  // namespace

int CornerBound::Ring::need() const {
  return std::max(0, (excess + 4 + 2 * pending - corners + 1) / 2);
}

void CornerBound::start() {
  const std::vector<std::int32_t>& gaps = walk_->facts(walk_->start()).corners_after;
  corners_.assign(gaps.begin(), gaps.end());
}

int CornerBound::need_at_start() const {
  const StarFacts& facts = walk_->facts(walk_->start());
  return Ring{facts.gateway_count, facts.corner_count, 0}.need();
}

void CornerBound::survey(GatewayIndex departure) {
  ring_ = {};
  stretches_.clear();
  corners_before_.clear();
  excess_before_.clear();
  GatewayIndex at = departure;
  do {
    const int corners = after(at);
    corners_before_.push_back(ring_.corners);
    excess_before_.push_back(ring_.excess);
    stretches_.push_back(corners);
    ring_.corners += corners;
    ring_.excess += above_four(corners);
    ++ring_.pending;
    at = map_->next_in_ring(at);
  } while (at != departure);
}

bool CornerBound::finishes_no_small_face(int position) const {
  return (position > 1 || stretch(0) >= 4) &&
         (position < ring_.pending - 1 || stretch(position) >= 4);
}

/// Of the stretches from position `first` up to `last`, exclusive.
int CornerBound::excess_between(int first, int last) const {
  return excess_before_[static_cast<std::size_t>(last)] -
         excess_before_[static_cast<std::size_t>(first)];
}

// The ring d A b B becomes A, whose last stretch goes on along that of d, and B, whose last one
// goes on along that of b.
int CornerBound::growth_by_link(int position) const {
  const int last = ring_.pending - 1;
  int growth = -ring_.need();
  const int corners_before_b = corners_before_[static_cast<std::size_t>(position)];
  if (position > 1) {
    const int joint = stretch(position - 1) + stretch(0);
    growth +=
        Ring{position - 1, corners_before_b, excess_between(1, position - 1) + above_four(joint)}
            .need();
  }
  if (position < last) {
    const int joint = stretch(last) + stretch(position);
    growth += Ring{last - position, ring_.corners - corners_before_b,
                   excess_between(position + 1, last) + above_four(joint)}
                  .need();
  }
  return growth;
}

int CornerBound::growth_by_place(StarId star, int arrival_gateway) const {
  const StarFacts& facts = walk_->facts(star);
  const auto gap = [&](int gateway) {
    return facts.corners_after[static_cast<std::size_t>(gateway)];
  };
  const int count = facts.gateway_count;
  const int gap_in = gap(arrival_gateway);
  const int gap_out = gap((arrival_gateway + count - 1) % count);
  Ring grown{ring_.pending + count - 2, ring_.corners + facts.corner_count, ring_.excess};
  const int last = ring_.pending - 1;
  if (last == 0) {
    grown.excess = above_four(gap_out + stretch(0) + gap_in);
  } else {
    grown.excess += above_four(stretch(last) + gap_in) - above_four(stretch(last));
    grown.excess += above_four(stretch(0) + gap_out) - above_four(stretch(0));
  }
  return grown.need() - ring_.need();
}

void CornerBound::apply(const MapChange& change) {
  const GatewayIndex d = change.departure;
  const GatewayIndex before_d = map_->previous_in_ring(d);
  if (change.kind == MapChange::Kind::kPlace) {
    const StarFacts& facts = walk_->facts(change.star);
    const auto first = static_cast<GatewayIndex>(corners_.size());
    corners_.insert(corners_.end(), facts.corners_after.begin(), facts.corners_after.end());
    const int count = facts.gateway_count;
    const GatewayIndex last = first + (change.target + count - 1) % count;
    after(last) += after(d);
    after(before_d == d ? last : before_d) += after(first + change.target);
  } else {
    const GatewayIndex b = change.target;
    const GatewayIndex before_b = map_->previous_in_ring(b);
    if (before_b != d) {
      after(before_b) += after(d);
    }
    if (before_d != b) {
      after(before_d) += after(b);
    }
  }
}

void CornerBound::undo(const MapChange& change) {
  const GatewayIndex d = change.departure;
  const GatewayIndex before_d = map_->previous_in_ring(d);
  if (change.kind == MapChange::Kind::kPlace) {
    const StarFacts& facts = walk_->facts(change.star);
    const std::size_t first = corners_.size() - facts.corners_after.size();
    if (before_d != d) {
      after(before_d) -= facts.corners_after[static_cast<std::size_t>(change.target)];
    }
    corners_.resize(first);
  } else {
    const GatewayIndex b = change.target;
    const GatewayIndex before_b = map_->previous_in_ring(b);
    if (before_d != b) {
      after(before_d) -= after(b);
    }
    if (before_b != d) {
      after(before_b) -= after(d);
    }
  }
}

}  // namespace cairn
