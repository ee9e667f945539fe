#include "exact_search/observed_walk.hpp"

#include <algorithm>
#include <map>

namespace cairn {
namespace {

StarFacts facts_of(const StarCatalogue& stars, StarId id) {
  const Star& star = stars.star(id);
  StarFacts facts;
  facts.gateway_count = stars.gateway_count(id);
  facts.fragment_count = stars.fragment_count(id);
  facts.terminated_ends = static_cast<int>(star.slots.size()) - facts.gateway_count;
  facts.is_corner = type_name(star) == "L";
  std::map<ViewClassId, int> views;
  for (int gateway = 0; gateway < facts.gateway_count; ++gateway) {
    const int next = (gateway + 1) % facts.gateway_count;
    const bool is_one_fragment = stars.through(id, gateway) == next;
    facts.corners_after.push_back(is_one_fragment ? 0 : 1);
    facts.corner_count += facts.corners_after.back();
    ++views[stars.view_class(id, gateway)];
  }
  facts.views.assign(views.begin(), views.end());
  return facts;
}

}  // namespace

ObservedWalk::ObservedWalk(const Exploration& exploration)
    : start_(learn(exploration.start)), start_gateway_(exploration.start_gateway) {
  steps_.reserve(exploration.steps.size());
  StarId from = start_;
  int reference = start_gateway_;
  for (const ExplorationStep& step : exploration.steps) {
    const int departure = (reference + step.turn) % stars_.gateway_count(from);
    const ViewClassId departure_view = stars_.view_class(from, departure);
    from = learn(step.star);
    reference = step.arrival_gateway;
    steps_.push_back(
        {step.turn, from, reference, departure_view, stars_.view_class(from, reference)});
  }
}

StarId ObservedWalk::learn(const Star& star) {
  const StarId id = stars_.add(star);
  if (id.index() == facts_.size()) {
    facts_.push_back(facts_of(stars_, id));
  }
  return id;
}

}  // namespace cairn
