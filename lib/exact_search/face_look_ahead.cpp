#include "exact_search/face_look_ahead.hpp"

#include <algorithm>
#include <numeric>

namespace cairn {
namespace {

constexpr std::uint64_t kAllGroups = ~std::uint64_t{0};
constexpr std::size_t kMostViewsOfQuadrangles = 7;  // Of L, T, + and I.

}  // namespace

FaceLookAhead::FaceLookAhead(const WorkingMap& map,
                             const ObservedWalk& walk,
                             const LookAhead& look_ahead,
                             const CornerBound& bound)
    : map_(&map), walk_(&walk), look_ahead_(&look_ahead), bound_(&bound) {
  group_views();
  list_links();
  list_kinds();
}

void FaceLookAhead::group_views() {
  group_.resize(look_ahead_->view_count());
  std::iota(group_.begin(), group_.end(), std::size_t{0});
  const auto root_of = [&](std::size_t view) {
    while (group_[view] != view) {
      view = group_[view] = group_[group_[view]];
    }
    return view;
  };
  for (int number = 0; number < walk_->step_count(); ++number) {
    const ObservedStep& step = walk_->step(number);
    group_[root_of(step.departure_view.index())] = root_of(step.arrival_view.index());
  }
  for (std::size_t view = 0; view < group_.size(); ++view) {
    group_[view] = root_of(view);
  }
}

/// Only quadrangles ask for links, and maps of quadrangles have few views.
void FaceLookAhead::list_links() {
  const std::size_t views = group_.size();
  if (views > kMostViewsOfQuadrangles) {
    return;
  }
  links_.assign(views * views, false);
  for (int number = 0; number < walk_->step_count(); ++number) {
    const std::size_t from = walk_->step(number).departure_view.index();
    const std::size_t to = walk_->step(number).arrival_view.index();
    links_[from * views + to] = links_[to * views + from] = true;
  }
}

void FaceLookAhead::list_kinds() {
  const StarCatalogue& stars = walk_->stars();
  for (StarId star{0}; star.value < walk_->star_count(); ++star.value) {
    const auto& views = walk_->facts(star).views;
    const bool is_known = std::any_of(kinds_.begin(), kinds_.end(), [&](const Kind& kind) {
      return walk_->facts(kind.star).views == views;
    });
    if (is_known) {
      continue;
    }
    Kind kind;
    kind.star = star;
    for (int gateway = 0; gateway < stars.gateway_count(star); ++gateway) {
      const Groups group = bit(stars.view_class(star, gateway));
      const int onward = stars.through(star, gateway);
      kind.groups |= group;
      kind.odd ^= group;
      if (onward < 0 || bit(stars.view_class(star, onward)) != group) {
        kind.begins |= group;
      }
    }
    kinds_.push_back(kind);
  }
}

bool FaceLookAhead::allows(int corners_left, bool quadrangles) {
  find_room(corners_left);
  demands_.clear();
  ++now_;
  seen_.resize(std::max(seen_.size(), static_cast<std::size_t>(map_->end_gateway())), 0);
  for (GatewayIndex at = 0; at < map_->end_gateway(); ++at) {
    if (map_->is_pending(at) && seen_[static_cast<std::size_t>(at)] != now_ &&
        !allows_face(at, quadrangles)) {
      return false;
    }
  }
  return true;
}

void FaceLookAhead::find_room(int corners_left) {
  for (Kind& kind : kinds_) {
    const StarFacts& facts = walk_->facts(kind.star);
    kind.room = facts.is_corner ? corners_left : walk_->step_count();
    for (const auto& [view, count] : facts.views) {
      kind.room = std::min(kind.room, look_ahead_->slack(view) / count);
    }
  }
}

bool FaceLookAhead::allows_face(GatewayIndex first, bool quadrangles) {
  ring_.views.clear();
  ring_.stretches.clear();
  Groups present = 0;
  Groups odd = 0;
  GatewayIndex at = first;
  do {
    seen_[static_cast<std::size_t>(at)] = now_;
    ring_.views.push_back(map_->view_class(at));
    present |= bit(ring_.views.back());
    odd ^= bit(ring_.views.back());
    if (quadrangles) {
      ring_.stretches.push_back(bound_->corners_after(at));
    }
    at = map_->next_in_ring(at);
  } while (at != first);
  const bool can_do_without =
      odd == 0 &&
      (!quadrangles || quadrangulation_.may_exist(
                           ring_, [&](ViewClassId a, ViewClassId b) { return can_link(a, b); }));
  return can_do_without || (meets_demand(present, odd != 0) && meets_demand(kAllGroups, odd != 0));
}

/// Notes that one more face of such groups, or of any, needs a place.
bool FaceLookAhead::meets_demand(Groups present, bool is_odd) {
  auto demand = std::find_if(demands_.begin(), demands_.end(),
                             [&](const Demand& known) { return known.present == present; });
  if (demand == demands_.end()) {
    demand = demands_.insert(demand, {present, 0, 0});
    for (const Kind& kind : kinds_) {
      // What begins a group that the face lacks makes room for any kind, on one face.
      const bool fits = (kind.groups & ~present) == 0;
      const bool begins = (kind.begins & ~present) != 0;
      demand->places_left += fits || begins ? kind.room : 0;
      demand->odd_places_left += (fits && kind.odd != 0) || begins ? kind.room : 0;
    }
  }
  demand->places_left -= 1;
  demand->odd_places_left -= is_odd ? 1 : 0;
  return demand->places_left >= 0 && demand->odd_places_left >= 0;
}

}  // namespace cairn
