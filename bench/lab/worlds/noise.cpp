#include "bench/lab/worlds/noise.hpp"

#include <cmath>
#include <numbers>
#include <optional>

#include "base/check.hpp"
#include "base/validator.hpp"
#include "bench/lab/worlds/random_world.hpp"
#include "star/isomorphism.hpp"

namespace cairn::lab {
namespace {

using Index = std::size_t;

/// A visit as it is seen; gateways in the numbering of its star.
struct Seen {
  Star star;
  int arrival = 0;
  std::optional<int> departure;  ///< None at the last visit.
  TrueVisit truth;
};

/// In place of a gateway's number while slots are edited: one that is not there.
constexpr int kInvented = -2;

/// Takes slots whose gateways have their old numbers, and numbers them anew.
void adopt(std::vector<StarSlot> slots, Seen* seen) {
  std::vector<int> true_gateways;
  int arrival = seen->arrival;
  std::optional<int> departure = seen->departure;
  for (StarSlot& slot : slots) {
    slot.law = slot.gateway == -1 ? ControlLaw::kDeadEnd : ControlLaw::kMidline;
    if (slot.gateway == -1) {
      continue;
    }
    const int number = static_cast<int>(true_gateways.size());
    if (slot.gateway == seen->arrival) {
      arrival = number;
    }
    if (slot.gateway == seen->departure) {
      departure = number;
    }
    true_gateways.push_back(
        slot.gateway == kInvented ? -1 : seen->truth.gateways[static_cast<Index>(slot.gateway)]);
    slot.gateway = number;
  }
  seen->star.slots = std::move(slots);
  seen->arrival = arrival;
  seen->departure = departure;
  seen->truth.gateways = std::move(true_gateways);
}

void erase_slot(std::vector<StarSlot>* slots, Index position) {
  slots->erase(slots->begin() + static_cast<std::ptrdiff_t>(position));
  for (StarSlot& slot : *slots) {
    slot.partner -= slot.partner > position ? 1 : 0;
  }
}

void insert_slot(std::vector<StarSlot>* slots, Index position, int gateway) {
  for (StarSlot& slot : *slots) {
    slot.partner += slot.partner >= position ? 1 : 0;
  }
  slots->insert(slots->begin() + static_cast<std::ptrdiff_t>(position),
                {gateway, 0, ControlLaw::kMidline});
}

void miss_a_gateway(Seen* seen, RandomSource& random) {
  std::vector<Index> candidates;
  std::vector<StarSlot> slots = seen->star.slots;
  for (Index slot = 0; slot < slots.size(); ++slot) {
    const int gateway = slots[slot].gateway;
    if (gateway >= 0 && gateway != seen->arrival && gateway != seen->departure) {
      candidates.push_back(slot);
    }
  }
  if (candidates.empty()) {
    return;
  }
  const Index missed =
      candidates[static_cast<Index>(random.below(static_cast<int>(candidates.size())))];
  const Index partner = slots[missed].partner;
  slots[missed].gateway = -1;
  if (slots[partner].gateway == -1) {
    erase_slot(&slots, std::max(missed, partner));
    erase_slot(&slots, std::min(missed, partner));
  }
  adopt(std::move(slots), seen);
  ++seen->truth.missed;
}

void invent_a_gateway(Seen* seen, RandomSource& random) {
  std::vector<StarSlot> slots = seen->star.slots;
  std::vector<Index> ends;
  for (Index slot = 0; slot < slots.size(); ++slot) {
    if (slots[slot].gateway == -1) {
      ends.push_back(slot);
    }
  }
  if (!ends.empty() && random.chance(0.5)) {
    slots[ends[static_cast<Index>(random.below(static_cast<int>(ends.size())))]].gateway =
        kInvented;
  } else {
    Index leaving = static_cast<Index>(random.below(static_cast<int>(slots.size()) + 1));
    insert_slot(&slots, leaving, kInvented);
    const Index end = static_cast<Index>(random.below(static_cast<int>(slots.size()) + 1));
    insert_slot(&slots, end, -1);
    leaving += leaving >= end ? 1 : 0;
    slots[leaving].partner = end;
    slots[end].partner = leaving;
  }
  adopt(std::move(slots), seen);
  ++seen->truth.invented;
}

/// Gateways keep their order, and so their numbers.
void misread(Seen* seen, RandomSource& random) {
  // There is one kind with one gateway, and few with many.
  constexpr int kMostDraws = 2000;
  for (int draw = 0; draw < kMostDraws; ++draw) {
    const Star other = random_star(random);
    if (gateway_count(other) == gateway_count(seen->star) &&
        type_name(other) != type_name(seen->star)) {
      seen->star = other;
      seen->truth.is_misread = true;
      return;
    }
  }
}

Seen disturbed(Seen seen, const NoiseOptions& options, RandomSource& random) {
  if (random.chance(options.misread_probability)) {
    misread(&seen, random);
  }
  if (random.chance(options.missed_probability)) {
    miss_a_gateway(&seen, random);
  }
  if (random.chance(options.false_probability)) {
    invent_a_gateway(&seen, random);
  }
  return seen;
}

Seen seen_at(const Walk& walk, Index visit) {
  const Exploration& exploration = walk.exploration;
  Seen seen{exploration.start, exploration.start_gateway, {}, walk.visits[visit]};
  if (visit > 0) {
    seen.star = exploration.steps[visit - 1].star;
    seen.arrival = exploration.steps[visit - 1].arrival_gateway;
  }
  if (visit < exploration.steps.size()) {
    seen.departure = (seen.arrival + exploration.steps[visit].turn) % gateway_count(seen.star);
  }
  return seen;
}

std::uint64_t mixed(std::uint64_t state) {
  // SplitMix64 of Steele, Lea and Flood, OOPSLA 2014.
  state += 0x9e3779b97f4a7c15U;
  state = (state ^ (state >> 30U)) * 0xbf58476d1ce4e5b9U;
  state = (state ^ (state >> 27U)) * 0x94d049bb133111ebU;
  return state ^ (state >> 31U);
}

double normal_of(std::uint64_t key) {
  // In (0, 1), so that the logarithm is finite.
  const auto uniform = [](std::uint64_t bits) {
    return (static_cast<double>(bits >> 11U) + 0.5) * 0x1.0p-53;
  };
  const double radius = std::sqrt(-2.0 * std::log(uniform(mixed(key))));
  return radius * std::cos(2.0 * std::numbers::pi * uniform(mixed(~key)));
}

}  // namespace

Status validate(const NoiseOptions& options) {
  return Validator("noise")
      .within("misread_probability", options.misread_probability, 0.0, 1.0)
      .within("missed_probability", options.missed_probability, 0.0, 1.0)
      .within("false_probability", options.false_probability, 0.0, 1.0)
      .status();
}

Walk with_noise(const Walk& walk, const NoiseOptions& options, std::uint64_t seed) {
  RandomSource random(seed, 2);
  Walk noisy;
  std::optional<Seen> before;
  for (Index visit = 0; visit < walk.visits.size(); ++visit) {
    Seen seen = disturbed(seen_at(walk, visit), options, random);
    if (!before) {
      noisy.exploration.start = seen.star;
      noisy.exploration.start_gateway = seen.arrival;
    } else {
      const int count = gateway_count(before->star);
      const int turn = (*before->departure - before->arrival + count) % count;
      noisy.exploration.steps.push_back({turn, seen.star, seen.arrival});
    }
    noisy.visits.push_back(seen.truth);
    before = std::move(seen);
  }
  return noisy;
}

Status validate(const MatchModel& model) {
  return Validator("match model")
      .within("mean", model.mean, 0.0, 1e6)
      .within("deviation", model.deviation, 0.0, 1e6)
      .status();
}

double match_log_likelihood_ratio(
    const Walk& walk, const MatchModel& model, int earlier, int later, int shift) {
  CAIRN_CHECK(0 <= earlier && earlier < later && later < static_cast<int>(walk.visits.size()));
  const auto count = static_cast<int>(walk.visits[static_cast<Index>(earlier)].gateways.size());
  // The gateway of arrival is always one that is there.
  const int arrival = walk.exploration.steps[static_cast<Index>(later) - 1].arrival_gateway;
  const int known = ((arrival + shift) % count + count) % count;
  return match_log_likelihood_ratio(walk, model, {{earlier}, known}, {{later}, arrival});
}

double match_log_likelihood_ratio(const Walk& walk,
                                  const MatchModel& model,
                                  SeenGateway known,
                                  SeenGateway now) {
  CAIRN_CHECK(known.visit < now.visit && now.visit.index() < walk.visits.size());
  const TrueVisit& first = walk.visits[known.visit.index()];
  const TrueVisit& second = walk.visits[now.visit.index()];
  const int there = first.gateways[static_cast<Index>(known.gateway)];
  const bool is_right = first.place == second.place && there >= 0 &&
                        there == second.gateways[static_cast<Index>(now.gateway)];

  constexpr int kRight = -1;
  const auto count = static_cast<int>(first.gateways.size());
  const int turned = ((known.gateway - now.gateway) % count + count) % count;
  std::uint64_t key = mixed(model.seed);
  for (const int part : {known.visit.value, now.visit.value, is_right ? kRight : turned}) {
    key = mixed(key ^ static_cast<std::uint64_t>(part));
  }
  return (is_right ? model.mean : -model.mean) + model.deviation * normal_of(key);
}

}  // namespace cairn::lab
