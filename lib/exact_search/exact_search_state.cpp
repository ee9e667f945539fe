#include "exact_search/exact_search_state.hpp"

namespace cairn {

ExactSearchState::ExactSearchState(const ObservedWalk& walk,
                                   const ExactSearchOptions& options,
                                   Needs needs)
    : walk_(&walk),
      options_(options),
      needs_(needs),
      map_(walk.stars(), options.planar ? WorkingMap::Rings::kFaces : WorkingMap::Rings::kOne),
      marks_(map_),
      regions_(map_),
      bound_(map_, walk),
      headings_(map_),
      look_ahead_(walk) {
  needs_.regions = needs.regions || options.region_consistent || options.perpendicular;
  needs_.corner_bound = needs.corner_bound || options.max_corners.has_value();
  if (options.look_ahead_by_face) {
    faces_.emplace(map_, walk, look_ahead_, bound_);
  }
  map_.start(walk.start(), VisitId{0});
  const StarFacts& facts = walk.facts(walk.start());
  start_.arrival = walk.start_gateway();
  start_.paths = facts.fragment_count;
  start_.pending = facts.gateway_count;
  start_.lone_paths = facts.fragment_count;
  start_.terminated_ends = facts.terminated_ends;
  start_.corners = facts.is_corner ? 1 : 0;
  if (needs_.corner_bound) {
    bound_.start();
    start_.corners_needed = bound_.need_at_start();
  }
  if (options_.compass || options_.straight_corridors) {
    headings_.add_start();
  }
}

bool ExactSearchState::allows_start() const {
  return (!options_.look_ahead || look_ahead_.allows_start()) && suits_bound(start_, -1);
}

GatewayIndex ExactSearchState::departure(const MapSummary& node, int step) const {
  const PlaceId place = map_.place_of(node.arrival);
  const GatewayIndex first = map_.first_gateway(place);
  const int count = map_.gateway_count(place);
  const int number = node.arrival - first + walk_->step(step).turn;
  return first + (number >= count ? number - count : number);
}

void ExactSearchState::expand(const MapSummary& node,
                              int step,
                              std::vector<Successor>* successors) {
  if (faces_ && !suits_faces(node)) {
    return;
  }
  const GatewayIndex from = departure(node, step);
  if (!map_.is_pending(from)) {
    return follow(node, step, from, successors);
  }
  add_links(node, step, from, successors);
  add_place(node, step, from, successors);
}

void ExactSearchState::follow(const MapSummary& node,
                              int step,
                              GatewayIndex departure,
                              std::vector<Successor>* successors) {
  const GatewayIndex arrival = map_.leads_to(departure);
  const ObservedStep& observed = walk_->step(step);
  if (map_.view_class(arrival) != observed.arrival_view) {
    ++view_mismatches_;
    return;
  }
  if ((options_.look_ahead && !look_ahead_.allows_follow(observed)) || !suits_bound(node, step)) {
    return;
  }
  const MapChange change{MapChange::Kind::kNothing, {}, {}, departure, arrival};
  successors->push_back({change, outline(node, change)});
}

void ExactSearchState::add_links(const MapSummary& node,
                                 int step,
                                 GatewayIndex departure,
                                 std::vector<Successor>* successors) {
  const ObservedStep& observed = walk_->step(step);
  if (needs_.corner_bound) {
    bound_.survey(departure);
  }
  const bool departs_alone = is_lone(departure);
  bool is_marked = false;
  int position = 1;
  for (GatewayIndex target = map_.next_in_ring(departure); target != departure;
       target = map_.next_in_ring(target), ++position) {
    if (map_.view_class(target) != observed.arrival_view || !suits_headings(departure, target) ||
        (needs_.corner_bound && !bound_.finishes_no_small_face(position))) {
      continue;
    }
    MapSummary summary = node;
    summary.arrival = target;
    summary.paths -= 1;
    summary.pending -= 2;
    summary.lone_paths -= (departs_alone ? 1 : 0) + (is_lone(target) ? 1 : 0);
    summary.corners_needed += needs_.corner_bound ? bound_.growth_by_link(position) : 0;
    if (!suits_bound(summary, step)) {
      continue;
    }
    if (!is_marked) {
      marks_.depart(departure);
      is_marked = true;
    }
    if (suits_paths(departure, target, &summary)) {
      successors->push_back(
          {{MapChange::Kind::kLink, {}, VisitId{step + 1}, departure, target}, summary});
    }
  }
}

void ExactSearchState::add_place(const MapSummary& node,
                                 int step,
                                 GatewayIndex departure,
                                 std::vector<Successor>* successors) {
  const ObservedStep& observed = walk_->step(step);
  if ((options_.max_places && node.places >= *options_.max_places) ||
      (options_.look_ahead && !look_ahead_.allows_place(observed.star))) {
    return;
  }
  const MapChange change{MapChange::Kind::kPlace, observed.star, VisitId{step + 1}, departure,
                         observed.arrival_gateway};
  MapSummary summary = outline(node, change);
  summary.lone_paths +=
      walk_->facts(observed.star).fragment_count - 1 - (is_lone(departure) ? 1 : 0);
  if (needs_.corner_bound) {
    summary.corners_needed += bound_.growth_by_place(observed.star, observed.arrival_gateway);
  }
  if (suits_bound(summary, step)) {
    successors->push_back({change, summary});
  }
}

MapSummary ExactSearchState::outline(const MapSummary& node, const MapChange& change) const {
  MapSummary summary = node;
  if (change.kind == MapChange::Kind::kLink) {
    summary.arrival = change.target;
    summary.paths -= 1;
    summary.pending -= 2;
  } else if (change.kind == MapChange::Kind::kPlace) {
    const StarFacts& facts = walk_->facts(change.star);
    summary.arrival = map_.end_gateway() + change.target;
    summary.places += 1;
    summary.paths += facts.fragment_count - 1;
    summary.pending += facts.gateway_count - 2;
    summary.terminated_ends += facts.terminated_ends;
    summary.corners += facts.is_corner ? 1 : 0;
  } else {
    summary.arrival = map_.leads_to(change.departure);
  }
  return summary;
}

bool ExactSearchState::suits_headings(GatewayIndex a, GatewayIndex b) const {
  return (!options_.compass || headings_.are_opposite(a, b)) &&
         (!options_.straight_corridors || headings_.are_in_line(a, b));
}

bool ExactSearchState::suits_paths(GatewayIndex departure,
                                   GatewayIndex target,
                                   MapSummary* summary) {
  // Violations never heal, so a map that is not region-consistent need not be looked at further.
  const bool with_crossings = needs_.regions && summary->region_consistent;
  switch (marks_.meeting(target, with_crossings)) {
    case PathMeeting::kSharePlace:
      return false;
    case PathMeeting::kTwice:
      summary->perpendicular = summary->region_consistent = false;
      break;
    case PathMeeting::kTriangle:
      summary->perpendicular = false;
      summary->region_consistent =
          !options_.perpendicular && regions_.stay_consistent(departure, target);
      break;
    case PathMeeting::kApart:
      break;
  }
  return (!options_.perpendicular || summary->perpendicular) &&
         (!options_.region_consistent || summary->region_consistent);
}

bool ExactSearchState::suits_bound(const MapSummary& summary, int step) const {
  if (!options_.max_corners) {
    return true;
  }
  return summary.corners + summary.corners_needed <= *options_.max_corners &&
         (!options_.look_ahead || summary.corners_needed <= look_ahead_.corners_to_come(step + 1));
}

/// A closed map of four corners has four on every face (CornerBound).
bool ExactSearchState::suits_faces(const MapSummary& node) {
  const int max_corners = options_.max_corners.value_or(walk_->step_count() + 1);
  return faces_->allows(max_corners - node.corners, options_.max_corners && max_corners <= 4);
}

/// Whether the path of a pending gateway is known from one place only.
bool ExactSearchState::is_lone(GatewayIndex pending) const {
  const GatewayIndex onward = map_.through(pending);
  return onward == kNoGateway || map_.is_pending(onward);
}

void ExactSearchState::apply(const MapChange& change, int step) {
  if (change.kind == MapChange::Kind::kNothing) {
    look_ahead_.follow(walk_->step(step));
    return;
  }
  if (needs_.corner_bound) {
    bound_.apply(change);
  }
  map_.apply(change);
  if (change.kind == MapChange::Kind::kPlace) {
    look_ahead_.add_place(change.star);
    if (options_.compass || options_.straight_corridors) {
      headings_.add_place(change);
    }
  }
}

void ExactSearchState::undo(const MapChange& change, int step) {
  if (change.kind == MapChange::Kind::kNothing) {
    look_ahead_.undo_follow(walk_->step(step));
    return;
  }
  map_.undo(change);
  if (needs_.corner_bound) {
    bound_.undo(change);
  }
  if (change.kind == MapChange::Kind::kPlace) {
    look_ahead_.remove_place(change.star);
    if (options_.compass || options_.straight_corridors) {
      headings_.remove_place(change);
    }
  }
}

}  // namespace cairn
