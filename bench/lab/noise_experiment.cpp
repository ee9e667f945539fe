#include "bench/lab/noise_experiment.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "base/check.hpp"
#include "bench/lab/resources.hpp"

namespace cairn::lab {
namespace {

using Index = std::size_t;

View view_of(const Walk& walk, Index visit) {
  View view;
  view.visit = VisitId{static_cast<std::int32_t>(visit)};
  view.star = visit == 0 ? walk.exploration.start : walk.exploration.steps[visit - 1].star;
  view.arrival_gateway = visit == 0 ? walk.exploration.start_gateway
                                    : walk.exploration.steps[visit - 1].arrival_gateway;
  return view;
}

/// What the visits to one place say about it.
struct TruePlace {
  std::set<PlaceId> mapped;
  std::set<int> seen;                  ///< Gateways; -1: one that is not there.
  std::set<std::pair<int, int>> used;  ///< Gateways, and what the map takes them for.
};

/// Of arrival and departure, in the numbers of the visit.
std::vector<int> gateways_used(const Walk& walk, Index visit) {
  const View view = view_of(walk, visit);
  std::vector<int> used{view.arrival_gateway};
  if (visit < walk.exploration.steps.size()) {
    used.push_back((view.arrival_gateway + walk.exploration.steps[visit].turn) %
                   gateway_count(view.star));
  }
  return used;
}

bool is_one_to_one(const std::set<std::pair<int, int>>& pairs) {
  std::set<int> first;
  std::set<int> second;
  for (const auto& [a, b] : pairs) {
    if (b < 0 || !first.insert(a).second || !second.insert(b).second) {
      return false;
    }
  }
  return true;
}

/// The truth outweighs everything else: what it adds is a multiple of this.
constexpr double kTold = 1e6;

/// The log-posterior of the true map under the same model, found by a tree that is told.
std::optional<double> told_log_posterior(const Walk& walk, const NoiseExperiment& experiment) {
  Evidence evidence;
  const auto& match = experiment.match;
  evidence.same_place = [&walk, &match](SeenGateway known, SeenGateway now) {
    const TrueVisit& first = walk.visits[known.visit.index()];
    const TrueVisit& second = walk.visits[now.visit.index()];
    const int there = first.gateways[static_cast<Index>(known.gateway)];
    const bool is_right = first.place == second.place && there >= 0 &&
                          there == second.gateways[static_cast<Index>(now.gateway)];
    const double ratio = match ? match_log_likelihood_ratio(walk, *match, known, now) : 0.0;
    return ratio + (is_right ? kTold : -kTold);
  };
  evidence.same_place_bound = [](VisitId) { return 2.0 * kTold; };
  TopologyOptions options = experiment.topology;
  options.max_hypotheses = std::min(options.max_hypotheses, 50);
  EventCosts unused;
  const HypothesisTree tree = grown_tree(walk, options, evidence, &unused);
  const Hypothesis best = tree.best();
  if (places_wrong(tree.map(best.id), walk) > 0) {
    return std::nullopt;
  }
  return best.log_posterior() - kTold * std::round(best.log_posterior() / kTold);
}

}  // namespace

double EventCosts::time_ms(double quantile) const {
  std::vector<double> sorted = times_ms;
  std::sort(sorted.begin(), sorted.end());
  const double last = static_cast<double>(sorted.size()) - 1.0;
  return sorted.empty() ? 0.0 : sorted[static_cast<Index>(std::ceil(quantile * last))];
}

std::int64_t EventCosts::most_memory_bytes() const {
  const auto most = std::max_element(memory_bytes.begin(), memory_bytes.end());
  return most == memory_bytes.end() ? 0 : *most;
}

Walk noisy_walk(const NoiseExperiment& experiment, std::uint64_t seed) {
  const World world = random_world(experiment.world, seed);
  return with_noise(random_walk(world, experiment.walk, seed), experiment.noise, seed);
}

Evidence evidence_of(const Walk& walk, const MatchModel& model) {
  Evidence evidence;
  evidence.same_place = [&walk, model](SeenGateway known, SeenGateway now) {
    return match_log_likelihood_ratio(walk, model, known, now);
  };
  return evidence;
}

HypothesisTree grown_tree(const Walk& walk,
                          const TopologyOptions& options,
                          const Evidence& evidence,
                          EventCosts* costs) {
  HypothesisTree tree(options, evidence);
  const Status started = tree.start(view_of(walk, 0));
  CAIRN_CHECK(started.ok());
  for (Index visit = 1; visit < walk.visits.size(); ++visit) {
    const View view = view_of(walk, visit);
    const double before_s = cpu_time_s();
    const Result<ExtendReport> report = tree.extend({walk.exploration.steps[visit - 1].turn}, view);
    const double after_s = cpu_time_s();
    CAIRN_CHECK(report.ok());
    const HypothesisTree::Memory memory = tree.memory();
    costs->times_ms.push_back(1e3 * (after_s - before_s));
    costs->memory_bytes.push_back(
        static_cast<std::int64_t>(memory.bytes_of_nodes + memory.bytes_of_leaves +
                                  memory.bytes_of_experience + memory.bytes_of_map));
    costs->waiting.push_back(tree.waiting_count());
  }
  return tree;
}

int places_wrong(const TopologicalMap& map, const Walk& walk) {
  std::map<int, TruePlace> places;
  std::map<PlaceId, std::set<int>> true_places;
  for (Index visit = 0; visit < walk.visits.size(); ++visit) {
    const TrueVisit& truth = walk.visits[visit];
    TruePlace& place = places[truth.place];
    const VisitId id{static_cast<std::int32_t>(visit)};
    place.mapped.insert(map.at_visit(id).place);
    true_places[map.at_visit(id).place].insert(truth.place);
    place.seen.insert(truth.gateways.begin(), truth.gateways.end());
    for (const int used : gateways_used(walk, visit)) {
      place.used.insert({truth.gateways[static_cast<Index>(used)], map.gateway_at(id, used)});
    }
  }
  return static_cast<int>(std::count_if(places.begin(), places.end(), [&](const auto& entry) {
    const TruePlace& place = entry.second;
    const PlaceId mapped = *place.mapped.begin();
    const auto real = static_cast<int>(place.seen.size() - place.seen.count(-1));
    const int gateways = map.gateway_count(mapped);
    return place.mapped.size() != 1 || true_places[mapped].size() != 1 ||
           !is_one_to_one(place.used) || gateways < real ||
           (gateways > real && place.seen.count(-1) == 0);
  }));
}

NoisyWorldResult run_noisy_walk(const Walk& walk,
                                const NoiseExperiment& experiment,
                                std::uint64_t seed) {
  NoisyWorldResult result;
  result.seed = seed;
  result.visits = static_cast<int>(walk.visits.size());
  std::set<int> places;
  for (const TrueVisit& visit : walk.visits) {
    places.insert(visit.place);
    result.misread += visit.is_misread || visit.missed > 0 || visit.invented > 0 ? 1 : 0;
  }
  result.places = static_cast<int>(places.size());
  const Evidence evidence = experiment.match ? evidence_of(walk, *experiment.match) : Evidence{};
  const HypothesisTree tree = grown_tree(walk, experiment.topology, evidence, &result.costs);
  const std::vector<Hypothesis> fringe = tree.fringe();
  const std::vector<double> shares = tree.probabilities();
  constexpr Index kRanksLookedAt = 100;
  for (Index rank = 0; rank < std::min(fringe.size(), kRanksLookedAt) && !result.rank; ++rank) {
    const int wrong = places_wrong(tree.map(fringe[rank].id), walk);
    result.places_wrong = rank == 0 ? wrong : result.places_wrong;
    if (wrong == 0) {
      result.rank = static_cast<int>(rank);
      result.share = shares[rank];
    }
  }
  result.is_true_best = result.rank == 0;
  result.contradictions = fringe.front().contradictions;
  result.is_guarantee_kept = !tree.guarantee_given_up().has_value();
  result.log_posterior = fringe.front().log_posterior();
  result.log_posterior_of_truth = told_log_posterior(walk, experiment);
  return result;
}

NoisyWorldResult run_noisy_world(const NoiseExperiment& experiment, std::uint64_t seed) {
  NoiseExperiment own = experiment;
  if (own.match) {
    own.match->seed = seed;
  }
  return run_noisy_walk(noisy_walk(own, seed), own, seed);
}

}  // namespace cairn::lab
