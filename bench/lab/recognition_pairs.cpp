#include "bench/lab/recognition_pairs.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "clients/common/progress.hpp"
#include "geometry/angle.hpp"
#include "topology/reading_match.hpp"

namespace cairn::lab {
namespace {

constexpr int kTravels = 16;
constexpr double kSameWay_rad = 0.8;  // between the bearings of one gateway

/// The gateways of the earlier visit that the later one's gateway of arrival may be.
std::vector<GatewayPair> alignments(const PlaceVisit& known, const PlaceVisit& visit) {
  static constexpr MisreadingCosts kAnyMisreading{1.0, 1.0, 1.0};
  const int arrival = std::max(visit.arrival_gateway, 0);
  const View view{visit.neighbourhood.star, arrival, VisitId{1}};
  std::vector<GatewayPair> pairs;
  for (int g = 0; g < static_cast<int>(known.neighbourhood.gateways.size()); ++g) {
    if (match_reading(view, known.neighbourhood.star, g, kAnyMisreading).is_possible()) {
      pairs.push_back({g, arrival});
    }
  }
  return pairs;
}

double world_bearing_rad(const SimulatedVisit& visit, int gateway) {
  return visit.T_world_place.theta() +
         visit.perceived.neighbourhood.gateways[static_cast<std::size_t>(gateway)]
             .outward_bearing_rad;
}

bool are_true(const SimulatedVisit& known,
              const SimulatedVisit& visit,
              const std::vector<GatewayPair>& pairs) {
  return std::all_of(pairs.begin(), pairs.end(), [&](const GatewayPair& pair) {
    return std::abs(turn_between(world_bearing_rad(known, pair.known),
                                 world_bearing_rad(visit, pair.visit))) < kSameWay_rad;
  });
}

JudgedPair judged(const SimulatedVisit& known,
                  const SimulatedVisit& visit,
                  const std::vector<GatewayPair>& pairs,
                  const MapMatch& match) {
  JudgedPair pair;
  pair.is_same_junction = known.junction == visit.junction;
  pair.is_same = pair.is_same_junction && are_true(known, visit, pairs);
  pair.is_other_session = known.session != visit.session;
  pair.match = match;
  if (pair.is_same) {
    pair.chi2 = squared_mahalanobis(match.T_reference_other.mean,
                                    known.T_world_place.inverse() * visit.T_world_place,
                                    match.T_reference_other.covariance);
  }
  return pair;
}

}  // namespace

std::vector<SimulatedVisit> visits_at_junctions(const Building& building,
                                                std::uint64_t seed,
                                                int session,
                                                int travels) {
  std::vector<SimulatedVisit> visits = drive_building(building, seed, session, travels);
  visits.erase(
      std::remove_if(visits.begin(), visits.end(),
                     [](const SimulatedVisit& visit) { return !visit.junction.has_value(); }),
      visits.end());
  return visits;
}

std::vector<JudgedPair> judged_pairs(const std::vector<SimulatedVisit>& visits,
                                     const MapMatchOptions& options) {
  std::vector<MatchableMap> maps;
  maps.reserve(visits.size());
  for (const SimulatedVisit& visit : visits) {
    maps.emplace_back(visit.perceived.lpm, options);
  }
  std::vector<JudgedPair> all;
  for (std::size_t later = 1; later < visits.size(); ++later) {
    for (std::size_t earlier = 0; earlier < later; ++earlier) {
      const SimulatedVisit& known = visits[earlier];
      const SimulatedVisit& visit = visits[later];
      for (const GatewayPair& pair : alignments(known.perceived, visit.perceived)) {
        const std::vector<GatewayPair> pairs = paired_gateways(
            known.perceived.neighbourhood.gateways, visit.perceived.neighbourhood.gateways, pair);
        const Pose2 guess = aligned_by_gateways(known.perceived, visit.perceived, pairs);
        all.push_back(
            judged(known, visit, pairs, match_maps(maps[earlier], maps[later], guess, options)));
      }
    }
  }
  return all;
}

std::vector<JudgedPair> judged_buildings(std::uint64_t first_seed, int count) {
  std::vector<JudgedPair> all;
  clients::Progress progress("buildings");
  for (int i = 0; i < count; ++i) {
    const std::uint64_t seed = first_seed + static_cast<std::uint64_t>(i);
    const Building building(seed);
    std::vector<SimulatedVisit> visits;
    for (const int session : {0, 1}) {
      for (SimulatedVisit& visit : visits_at_junctions(building, seed, session, kTravels)) {
        visits.push_back(std::move(visit));
      }
    }
    for (JudgedPair& pair : judged_pairs(visits, MapMatchOptions())) {
      pair.seed = seed;
      pair.repeats_itself = building.repeats_itself();
      all.push_back(std::move(pair));
    }
    progress.show(i + 1, count);
  }
  return all;
}

}  // namespace cairn::lab
