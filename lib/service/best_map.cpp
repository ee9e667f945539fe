#include "service/best_map.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "base/check.hpp"
#include "layout/trajectory.hpp"
#include "star/large_scale_star.hpp"
#include "topology/paths.hpp"

namespace cairn {
namespace {

std::vector<Pose2> local_poses(const std::vector<PerceivedScan>& scans,
                               std::size_t first,
                               std::size_t last) {
  std::vector<Pose2> poses;
  for (std::size_t i = first; i <= last; ++i) {
    poses.push_back(scans[i].fix.T_lpm_robot);
  }
  return poses;
}

/// H(x): rigid before the first visit and after the last, interpolated between.
void add_trajectory(const Experience& experience, MetricalMap* map) {
  const std::vector<PerceivedScan>& scans = experience.scans();
  const std::vector<Visit>& visits = experience.visits();
  const auto T_global_anchor = [&](std::size_t visit) {
    const Visit& at = visits[visit];
    return map->T_global_visit[visit] * at.perceived.T_lpm_place.inverse() *
           scans[at.anchor_scan].fix.T_lpm_robot;
  };
  const Pose2 T_global_first_lpm =
      map->T_global_visit.front() * visits.front().perceived.T_lpm_place.inverse();
  for (std::size_t i = 0; i < visits.front().anchor_scan; ++i) {
    map->trajectory.push_back(T_global_first_lpm * scans[i].fix.T_lpm_robot);
  }
  for (std::size_t v = 0; v + 1 < map->T_global_visit.size(); ++v) {
    const std::vector<Pose2> bent =
        interpolate_travel(local_poses(scans, visits[v].anchor_scan, visits[v + 1].anchor_scan),
                           T_global_anchor(v), T_global_anchor(v + 1));
    map->trajectory.insert(map->trajectory.end(), bent.begin(), bent.end() - 1);
  }
  map->T_global_lpm = map->T_global_visit.back() * visits.back().perceived.T_lpm_place.inverse();
  for (std::size_t i = visits.back().anchor_scan; i < scans.size(); ++i) {
    map->trajectory.push_back(map->T_global_lpm * scans[i].fix.T_lpm_robot);
  }
}

/// Outward bearings of a visit's gateway in the place frame.
std::vector<int> path_of_gateway(const TopologicalMap& map,
                                 const std::vector<Path>& paths,
                                 PlaceId place) {
  std::vector<int> path_of(static_cast<std::size_t>(map.gateway_count(place)), -1);
  for (std::size_t p = 0; p < paths.size(); ++p) {
    for (const PathStop& stop : paths[p].stops) {
      if (stop.place != place) {
        continue;
      }
      for (const std::size_t slot : {stop.forward_slot, stop.backward_slot}) {
        const int gateway = map.star(place).slots[slot].gateway;
        if (gateway >= 0) {
          path_of[static_cast<std::size_t>(gateway)] = static_cast<int>(p);
        }
      }
    }
  }
  return path_of;
}

GatewayRef gateway_of_place(const TopologicalMap& map, VisitId visit, int gateway) {
  return {map.at_visit(visit).place, map.gateway_at(visit, gateway)};
}

/// By place and gateway, as the first visit that noticed it saw it, in the place frame.
std::vector<std::vector<Gateway>> seen_gateways(const TopologicalMap& map,
                                                const Experience& experience,
                                                const MetricalMap& metrical) {
  std::vector<std::vector<Gateway>> seen;
  std::vector<std::vector<bool>> is_seen;
  for (PlaceId place{0}; place.value < map.place_count(); ++place.value) {
    const auto count = static_cast<std::size_t>(map.gateway_count(place));
    seen.emplace_back(count);
    is_seen.emplace_back(count, false);
  }
  for (VisitId visit{0}; visit.value < map.visit_count(); ++visit.value) {
    const std::size_t place = map.at_visit(visit).place.index();
    const std::vector<Gateway>& gateways =
        experience.visits()[visit.index()].perceived.neighbourhood.gateways;
    const Pose2 T_place_visit =
        metrical.layout.T_global_place[place].inverse() * metrical.T_global_visit[visit.index()];
    for (std::size_t j = 0; j < gateways.size(); ++j) {
      const int gateway = map.gateway_at(visit, static_cast<int>(j));
      if (gateway >= 0 && !is_seen[place][static_cast<std::size_t>(gateway)]) {
        is_seen[place][static_cast<std::size_t>(gateway)] = true;
        seen[place][static_cast<std::size_t>(gateway)] =
            visit == map.first_visit(map.at_visit(visit).place)
                ? gateways[j]
                : transformed(T_place_visit, gateways[j]);
      }
    }
  }
  return seen;
}

}  // namespace

Result<MetricalMap> metrical_map(const TopologicalMap& map,
                                 const Experience& experience,
                                 const VisitMatcher& matcher,
                                 const LayoutOptions& options) {
  CAIRN_CHECK(map.visit_count() > 0);
  LayoutOptions with_covariances = options;
  with_covariances.covariances = true;
  Result<PlaceLayout> layout =
      solve_layout(map.place_count(), matcher.constraints(map), with_covariances);
  if (!layout) {
    return layout.error();
  }
  MetricalMap metrical;
  metrical.layout = *std::move(layout);
  const Pose2 T_global_first = experience.visits().front().perceived.T_lpm_place;
  for (Pose2& T_global_place : metrical.layout.T_global_place) {
    T_global_place = T_global_first * T_global_place;
  }
  for (int v = 0; v < map.visit_count(); ++v) {
    const std::size_t place = map.at_visit(VisitId{v}).place.index();
    metrical.T_global_visit.push_back(metrical.layout.T_global_place[place] *
                                      matcher.T_place_visit(map, VisitId{v}).mean);
  }
  add_trajectory(experience, &metrical);
  return metrical;
}

std::vector<TimedPose> with_poses_between(const std::vector<PerceivedScan>& scans,
                                          const std::vector<PosedScan>& trajectory) {
  CAIRN_CHECK(scans.size() == trajectory.size());
  std::vector<TimedPose> poses;
  for (std::size_t i = 0; i < scans.size(); ++i) {
    const std::vector<OdometrySample>& between = scans[i].between;
    if (i > 0 && !between.empty()) {
      std::vector<Pose2> T_previous_robot{Pose2()};
      for (const OdometrySample& sample : between) {
        T_previous_robot.push_back(sample.T_odom_robot);
      }
      const std::vector<Pose2> bent = interpolate_travel(
          T_previous_robot, trajectory[i - 1].T_global_robot, trajectory[i].T_global_robot);
      for (std::size_t k = 0; k + 1 < between.size(); ++k) {
        poses.push_back({between[k].time, bent[k + 1], false});
      }
    }
    poses.push_back({scans[i].fix.time, trajectory[i].T_global_robot});
  }
  return poses;
}

std::vector<MappedPlace> mapped_places(const TopologicalMap& map,
                                       const Experience& experience,
                                       const MetricalMap& metrical) {
  const PlaceLayout& layout = metrical.layout;
  const std::vector<std::vector<Gateway>> seen = seen_gateways(map, experience, metrical);
  const std::vector<Path> paths = trace_paths(map);
  std::vector<MappedPlace> places;
  for (int p = 0; p < map.place_count(); ++p) {
    const PlaceId id{p};
    const std::vector<int> path_of = path_of_gateway(map, paths, id);
    MappedPlace place;
    place.id = p;
    place.T_global_place = {layout.T_global_place[id.index()], layout.covariances[id.index()]};
    place.star = large_scale_text(map.star(id), 0);
    place.anchor_scan = experience.visits()[map.first_visit(id).index()].anchor_scan;
    for (int g = 0; g < map.gateway_count(id); ++g) {
      const auto index = static_cast<std::size_t>(g);
      place.gateways.push_back({seen[id.index()][index], map.is_pending({id, g}), path_of[index]});
    }
    places.push_back(std::move(place));
  }
  for (int v = 0; v < map.visit_count(); ++v) {
    ++places[map.at_visit(VisitId{v}).place.index()].visit_count;
  }
  return places;
}

std::vector<MappedSegment> mapped_segments(const TopologicalMap& map,
                                           const Experience& experience,
                                           const PlaceLayout& layout,
                                           const std::vector<TravelConstraint>& constraints) {
  std::vector<MappedSegment> segments;
  std::map<std::pair<GatewayRef, GatewayRef>, std::size_t> known;
  std::size_t travel = 0;
  for (int v = 0; v + 1 < map.visit_count(); ++v) {
    if (map.is_carried(VisitId{v + 1})) {
      continue;
    }
    const SegmentTravel this_travel{v + 1, travel};
    const GaussianPose& travelled = constraints[travel++].T_from_to;
    const PlaceVisit& visit = experience.visits()[static_cast<std::size_t>(v)].perceived;
    const PlaceVisit& next = experience.visits()[static_cast<std::size_t>(v) + 1].perceived;
    GatewayRef from = gateway_of_place(map, VisitId{v}, departure_gateway(visit, next));
    GatewayRef to = gateway_of_place(map, VisitId{v + 1}, std::max(next.arrival_gateway, 0));
    if (from.gateway < 0 || to.gateway < 0) {
      continue;  // The map takes one of them for imagined.
    }
    const bool is_reversed = to < from;
    if (is_reversed) {
      std::swap(from, to);
    }
    const auto [entry, is_new] = known.emplace(std::make_pair(from, to), segments.size());
    if (is_new) {
      MappedSegment segment;
      segment.from_place = from.place.value;
      segment.from_gateway = from.gateway;
      segment.to_place = to.place.value;
      segment.to_gateway = to.gateway;
      segment.is_broken = map.linked_to(from) != to;
      segment.first_scan = experience.visits()[static_cast<std::size_t>(v)].anchor_scan;
      segment.last_scan = experience.visits()[static_cast<std::size_t>(v) + 1].anchor_scan;
      const Matrix3d covariance =
          is_reversed ? inverted(travelled).covariance : travelled.covariance;
      segment.T_from_to = {layout.T_global_place[from.place.index()].inverse() *
                               layout.T_global_place[to.place.index()],
                           covariance};
      segments.push_back(segment);
    }
    MappedSegment& segment = segments[entry->second];
    const double length_m = experience.travels()[static_cast<std::size_t>(v)].length_m;
    segment.length_m = is_new ? length_m : std::min(segment.length_m, length_m);
    segment.travels.push_back(this_travel);
    ++segment.travel_count;
  }
  return segments;
}

std::vector<SamePlace> same_places(const TopologicalMap& map,
                                   const Experience& experience,
                                   const VisitMatcher& matcher) {
  // Frames of places are turned as the lpm frame is.
  const auto T_place_anchor = [&](const Visit& visit) {
    const Pose2& T_lpm_robot = experience.scans()[visit.anchor_scan].fix.T_lpm_robot;
    return GaussianPose{visit.perceived.T_lpm_place.inverse() * T_lpm_robot, Matrix3d::Zero()};
  };
  std::vector<SamePlace> same;
  for (VisitId id{0}; id.value < map.visit_count(); ++id.value) {
    const VisitId first = map.first_visit(map.at_visit(id).place);
    if (first == id) {
      continue;
    }
    const Visit& visit = experience.visits()[id.index()];
    const Visit& known = experience.visits()[first.index()];
    same.push_back(
        {known.anchor_scan, visit.anchor_scan,
         compounded(compounded(inverted(T_place_anchor(known)), matcher.T_place_visit(map, id)),
                    T_place_anchor(visit))});
  }
  return same;
}

std::vector<HypothesisSummary> summaries(const HypothesisTree& tree, std::size_t count) {
  const std::vector<double> probabilities = tree.probabilities();
  const std::vector<Hypothesis> fringe = tree.fringe();
  std::vector<HypothesisSummary> all;
  for (std::size_t i = 0; i < std::min(count, fringe.size()); ++i) {
    const Hypothesis& hypothesis = fringe[i];
    const TopologicalMap map = tree.map(hypothesis.id);
    all.push_back({hypothesis.id.value, hypothesis.parent.value, hypothesis.log_posterior(),
                   probabilities[i], hypothesis.place_count, hypothesis.path_count,
                   map.closure_count(), map.pending_count()});
  }
  return all;
}

int departure_gateway(const PlaceVisit& visit, const PlaceVisit& next) {
  if (visit.departure_gateway >= 0) {
    return visit.departure_gateway;
  }
  const Vector2d p_place_next = visit.T_lpm_place.inverse() * next.T_lpm_place.translation();
  const std::vector<Gateway>& gateways = visit.neighbourhood.gateways;
  const auto alignment = [&](const Gateway& gateway) {
    return gateway.outward().dot(p_place_next - gateway.middle);
  };
  const auto best = std::max_element(
      gateways.begin(), gateways.end(),
      [&](const Gateway& a, const Gateway& b) { return alignment(a) < alignment(b); });
  return static_cast<int>(best - gateways.begin());
}

}  // namespace cairn
