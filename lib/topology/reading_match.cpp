#include "topology/reading_match.hpp"

#include <algorithm>
#include <utility>

#include "base/check.hpp"
#include "star/isomorphism.hpp"
#include "star/star_edits.hpp"

namespace cairn {
namespace {

/// How the star of one reading and that of a place agree.
struct Agreement {
  Misreading misreading = Misreading::kNone;
  /// The missed one of the place, or the false one of the reading: any of these. First those
  /// without which all else is alike; for the others the fragments were misread, too.
  std::vector<int> odd_gateways = {};
  int alike = 0;              ///< How many leave all else alike.
  int odd_gateway = -1;       ///< The one that is taken.
  bool is_misjoined = false;  ///< Without it, the fragments differ.

  void choose(int choice) {
    odd_gateway = odd_gateways.empty() ? -1 : odd_gateways[static_cast<std::size_t>(choice)];
    is_misjoined = odd_gateway >= 0 && choice >= alike;
  }
};

/// A star and the gateway by which it is entered.
struct Entered {
  const Star& star;
  int by = 0;
  int gateways = gateway_count(star);

  [[nodiscard]] int steps_clockwise_to(int gateway) const {
    return (gateway - by + gateways) % gateways;
  }
};

Entered entered(const View& view, int reading) {
  return {star_of(view, reading), arrival_gateway_of(view, reading)};
}

/// The gateways without which the one star looks like the other, then all others but the arrival.
std::optional<Agreement> agreement_but_for_one(const Entered& more,
                                               const Entered& less,
                                               Misreading misreading) {
  const ViewCode wanted = view_code(less.star, less.by);
  Agreement found{misreading};
  std::vector<int> others;
  for (int step = 1; step < more.gateways; ++step) {
    const int odd = (more.by + step) % more.gateways;
    const std::optional<Star> rest = without_gateway(more.star, odd);
    const bool is_alike = rest && view_code(*rest, odd < more.by ? more.by - 1 : more.by) == wanted;
    (is_alike ? found.odd_gateways : others).push_back(odd);
  }
  found.alike = static_cast<int>(found.odd_gateways.size());
  found.odd_gateways.insert(found.odd_gateways.end(), others.begin(), others.end());
  found.choose(0);
  return found;
}

std::optional<Agreement> agreement(const Entered& seen, const Entered& place) {
  switch (seen.gateways - place.gateways) {
    case 0:
      return Agreement{are_alike(seen.star, seen.by, place.star, place.by)
                           ? Misreading::kNone
                           : Misreading::kFragments};
    case -1:
      return agreement_but_for_one(place, seen, Misreading::kMissedGateway);
    case 1:
      return agreement_but_for_one(seen, place, Misreading::kFalseGateway);
    default:
      return std::nullopt;
  }
}

double cost_of(const Agreement& how, const MisreadingCosts& costs) {
  const double of_fragments = how.is_misjoined ? costs.log_penalty_misread : 0.0;
  switch (how.misreading) {
    case Misreading::kNone:
      return 0.0;
    case Misreading::kFragments:
      return costs.log_penalty_misread;
    case Misreading::kMissedGateway:
      return costs.log_penalty_missed_gateway + of_fragments;
    case Misreading::kFalseGateway:
      return costs.log_penalty_false_gateway + of_fragments;
  }
  CAIRN_CHECK(!"a misreading outside of its enumeration");
  return 0.0;
}

/// What the numbers of gateways alone make inevitable.
double least_cost(int additional_gateways, const MisreadingCosts& costs) {
  switch (additional_gateways) {
    case 0:
      return 0.0;
    case -1:
      return costs.log_penalty_missed_gateway;
    case 1:
      return costs.log_penalty_false_gateway;
    default:
      return std::numeric_limits<double>::infinity();
  }
}

/// For each gateway of the reading that of the place; -1: a false one.
std::vector<int> gateways_at_place(const Entered& seen,
                                   const Entered& place,
                                   const Agreement& how) {
  std::vector<int> at_place;
  for (int gateway = 0; gateway < seen.gateways; ++gateway) {
    int step = seen.steps_clockwise_to(gateway);
    if (how.misreading == Misreading::kFalseGateway) {
      step -= step > seen.steps_clockwise_to(how.odd_gateway) ? 1 : 0;
    } else if (how.misreading == Misreading::kMissedGateway) {
      step += step >= place.steps_clockwise_to(how.odd_gateway) ? 1 : 0;
    }
    const bool is_false = how.misreading == Misreading::kFalseGateway && gateway == how.odd_gateway;
    at_place.push_back(is_false ? -1 : (place.by + step) % place.gateways);
  }
  return at_place;
}

/// Numbers told by gateway of a reading, told by gateway of the first reading.
std::vector<int> by_gateway_of_first(const View& view,
                                     int reading,
                                     const std::vector<int>& by_gateway) {
  if (reading == 0) {
    return by_gateway;
  }
  std::vector<int> result(static_cast<std::size_t>(gateway_count(view.star)), -1);
  for (std::size_t gateway = 0; gateway < by_gateway.size(); ++gateway) {
    const int first = gateway_of_first(view, reading, static_cast<int>(gateway));
    if (first >= 0) {
      result[static_cast<std::size_t>(first)] = by_gateway[gateway];
    }
  }
  return result;
}

/// The recalled reading that looks exactly like the place. Its gateways were told apart by where
/// they are; of a star that had to be misread, only their order is known.
std::optional<int> recalled_like(const View& view, const Entered& place) {
  for (int reading = 0; reading < reading_count(view); ++reading) {
    const Entered seen = entered(view, reading);
    if (is_recalled(view, reading) && are_alike(seen.star, seen.by, place.star, place.by)) {
      return reading;
    }
  }
  return std::nullopt;
}

int likeliest_reading(const View& view) {
  int likeliest = 0;
  for (int reading = 1; reading < reading_count(view); ++reading) {
    if (log_likelihood_of(view, reading) > log_likelihood_of(view, likeliest)) {
      likeliest = reading;
    }
  }
  return likeliest;
}

}  // namespace

int choice_count(const View& view, const ReadingMatch& match) {
  const int gateways = gateway_count(star_of(view, match.reading));
  switch (match.misreading) {
    case Misreading::kMissedGateway:
      return gateways;  // The place has one more, but that of arrival was seen.
    case Misreading::kFalseGateway:
      return gateways - 1;
    default:
      return 1;
  }
}

ReadingMatch match_reading(const View& view,
                           const Star& place_star,
                           int arrival_gateway_of_place,
                           const MisreadingCosts& costs,
                           int choice) {
  const Entered place{place_star, arrival_gateway_of_place};
  ReadingMatch best;
  Agreement best_agreement;
  for (int reading = 0; reading < reading_count(view); ++reading) {
    const Entered seen = entered(view, reading);
    const double own = log_likelihood_of(view, reading);
    if (own - least_cost(seen.gateways - place.gateways, costs) <= best.log_likelihood) {
      continue;  // Also where nothing is possible.
    }
    const std::optional<Agreement> how = agreement(seen, place);
    if (how && own - cost_of(*how, costs) > best.log_likelihood) {
      best.log_likelihood = own - cost_of(*how, costs);
      best.reading = reading;
      best_agreement = *how;
    }
  }
  if (!best.is_possible() || best_agreement.misreading != Misreading::kNone) {
    if (const std::optional<int> recalled = recalled_like(view, place)) {
      best.log_likelihood = log_likelihood_of(view, *recalled);
      best.reading = *recalled;
      best_agreement = {};
    }
  }
  if (best.is_possible()) {
    best.misreading = best_agreement.misreading;
    best.alternatives = best_agreement.alike;
    best.log_likelihood += cost_of(best_agreement, costs);
    best_agreement.choose(choice);
    best.log_likelihood -= cost_of(best_agreement, costs);
    best.gateway_of_view = by_gateway_of_first(
        view, best.reading, gateways_at_place(entered(view, best.reading), place, best_agreement));
  }
  return best;
}

std::optional<AmendedStar> amended(const View& view,
                                   int reading,
                                   const Star& place_star,
                                   int arrival_gateway_of_place,
                                   int choice) {
  const Entered seen = entered(view, reading);
  const Entered place{place_star, arrival_gateway_of_place};
  std::optional<Agreement> how = agreement(seen, place);
  if (!how || how->misreading == Misreading::kNone) {
    return std::nullopt;
  }
  how->choose(choice);
  // The numbers begin at the lowest gateway of the place that stays, so that none before it is new.
  const std::vector<int> at_place = gateways_at_place(seen, place, *how);
  int first = arrival_gateway_of(view, reading);
  for (int gateway = 0; gateway < seen.gateways; ++gateway) {
    const int number = at_place[static_cast<std::size_t>(gateway)];
    first = number >= 0 && number < at_place[static_cast<std::size_t>(first)] ? gateway : first;
  }
  const Entered renumbered{seen.star, first};
  std::vector<int> numbers;
  numbers.reserve(at_place.size());
  for (int gateway = 0; gateway < seen.gateways; ++gateway) {
    numbers.push_back(renumbered.steps_clockwise_to(gateway));
  }
  AmendedStar result{rotated_to(seen.star, first), how->odd_gateway,
                     by_gateway_of_first(view, reading, numbers)};
  if (how->misreading == Misreading::kFalseGateway) {
    result.changed_gateway = numbers[static_cast<std::size_t>(how->odd_gateway)];
  }
  return result;
}

ReadingMatcher::ReadingMatcher(const View& view,
                               const StarCatalogue& stars,
                               const MisreadingCosts& costs)
    : view_(&view), stars_(&stars), costs_(costs) {
  const int likeliest = likeliest_reading(view);
  const Entered seen = entered(view, likeliest);
  for (int reading = 0; reading < reading_count(view); ++reading) {
    const std::optional<StarId> star = stars.find(star_of(view, reading));
    CAIRN_CHECK(star.has_value());
    star_ids_.push_back(*star);
  }
  likeliest_class_ = stars.view_class(star_id(likeliest), seen.by);
  // Stars that look the same have as many gateways, so the gateway of arrival tells all others.
  for (int gateway = 0; gateway < seen.gateways; ++gateway) {
    const std::vector<int> at_place = gateways_at_place(seen, {seen.star, gateway}, {});
    exact_.push_back({log_likelihood_of(view, likeliest), Misreading::kNone, likeliest, 0,
                      by_gateway_of_first(view, likeliest, at_place)});
  }
  const double least = std::min({costs.log_penalty_misread, costs.log_penalty_missed_gateway,
                                 costs.log_penalty_false_gateway});
  is_strict_ = view.others.empty() && least == std::numeric_limits<double>::infinity();
}

const ReadingMatch& ReadingMatcher::remembered(StarId star, int gateway, int choice) {
  if (static_cast<std::size_t>(choice) >= memo_.size()) {
    memo_.resize(static_cast<std::size_t>(choice) + 1);
  }
  auto& memo = memo_[static_cast<std::size_t>(choice)];
  if (star.index() >= memo.size()) {
    memo.resize(star.index() + 1);
  }
  std::vector<std::optional<ReadingMatch>>& of_star = memo[star.index()];
  if (of_star.empty()) {
    of_star.resize(static_cast<std::size_t>(stars_->gateway_count(star)));
  }
  std::optional<ReadingMatch>& answer = of_star[static_cast<std::size_t>(gateway)];
  if (!answer) {
    answer = match_reading(*view_, stars_->star(star), gateway, costs_, choice);
  }
  return *answer;
}

}  // namespace cairn
