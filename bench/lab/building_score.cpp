#include "bench/lab/building_score.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <string>

#include "geometry/angle.hpp"
#include "star/star.hpp"

namespace cairn::lab {
namespace {

constexpr double kSameWay_rad = 0.6;

/// The bearings in which corridors leave a junction.
std::vector<double> ways_of(const Building& building, int junction) {
  std::vector<double> ways;
  for (const Corridor& corridor : building.corridors()) {
    if (corridor.from == junction || corridor.to == junction) {
      const int far = corridor.from == junction ? corridor.to : corridor.from;
      const Vector2d way = building.junctions()[static_cast<std::size_t>(far)] -
                           building.junctions()[static_cast<std::size_t>(junction)];
      ways.push_back(std::atan2(way.y(), way.x()));
    }
  }
  return ways;
}

bool is_straight(double a_rad, double b_rad) {
  return std::abs(turn_between(a_rad + std::numbers::pi, b_rad)) < kSameWay_rad;
}

/// By gateway the way that it leads along; -1 where none is, or another gateway leads along it.
std::vector<int> way_of_gateway(const std::vector<double>& ways, const SimulatedVisit& visit) {
  std::vector<int> found;
  std::vector<bool> is_taken(ways.size(), false);
  for (const Gateway& gateway : visit.perceived.neighbourhood.gateways) {
    const double bearing_rad = visit.T_world_place.theta() + gateway.outward_bearing_rad;
    int way = -1;
    for (std::size_t w = 0; w < ways.size(); ++w) {
      if (!is_taken[w] && std::abs(turn_between(ways[w], bearing_rad)) < kSameWay_rad) {
        way = static_cast<int>(w);
        is_taken[w] = true;
        break;
      }
    }
    found.push_back(way);
  }
  return found;
}

/// Whether every path goes on where the corridors do, and ends where they do.
bool is_continued_as(const std::vector<double>& ways,
                     const std::vector<int>& way_of,
                     const Star& star) {
  for (int gateway = 0; gateway < gateway_count(star); ++gateway) {
    const double way_rad =
        ways[static_cast<std::size_t>(way_of[static_cast<std::size_t>(gateway)])];
    const bool goes_on = std::any_of(ways.begin(), ways.end(), [&](double other_rad) {
      return is_straight(way_rad, other_rad);
    });
    const std::optional<int> partner = through_partner(star, gateway);
    const bool agrees =
        partner ? is_straight(
                      way_rad,
                      ways[static_cast<std::size_t>(way_of[static_cast<std::size_t>(*partner)])])
                : !goes_on;
    if (!agrees) {
      return false;
    }
  }
  return true;
}

/// What of a star can be compared between visits: the ways that gateways lead along and how they
/// go on, in the true directions.
using SeenStar = std::map<int, int>;

SeenStar seen_star(const SimulatedVisit& visit, const std::vector<int>& way_of) {
  constexpr int kEnds = -1;
  constexpr int kFalse = 1000;  // gateways that lead nowhere are told apart by their number
  SeenStar seen;
  const Star& star = visit.perceived.neighbourhood.star;
  const auto name_of_gateway = [&](int gateway) {
    const int way = way_of[static_cast<std::size_t>(gateway)];
    return way >= 0 ? way : kFalse + gateway;
  };
  for (int gateway = 0; gateway < gateway_count(star); ++gateway) {
    const std::optional<int> partner = through_partner(star, gateway);
    seen[name_of_gateway(gateway)] = partner ? name_of_gateway(*partner) : kEnds;
  }
  return seen;
}

/// By visit the position in the walk at which it was made, so that as many as possible are at
/// their own junction, in order; none for the others.
std::vector<std::optional<std::size_t>> laid_along(const std::vector<int>& walk,
                                                   const std::vector<SimulatedVisit>& visits) {
  const std::size_t n = visits.size();
  const std::size_t m = walk.size();
  std::vector<std::vector<std::size_t>> most(n + 1, std::vector<std::size_t>(m + 1, 0));
  for (std::size_t i = n; i-- > 0;) {
    for (std::size_t j = m; j-- > 0;) {
      most[i][j] = std::max(most[i + 1][j], most[i][j + 1]);
      if (visits[i].junction == walk[j]) {
        most[i][j] = std::max(most[i][j], most[i + 1][j + 1] + 1);
      }
    }
  }
  std::vector<std::optional<std::size_t>> position(n);
  for (std::size_t i = 0, j = 0; i < n && j < m;) {
    if (visits[i].junction == walk[j] && most[i][j] == most[i + 1][j + 1] + 1) {
      position[i++] = j++;
    } else if (most[i][j] == most[i + 1][j]) {
      ++i;
    } else {
      ++j;
    }
  }
  return position;
}

}  // namespace

BuildingScore& BuildingScore::operator+=(const BuildingScore& other) {
  passages += other.passages;
  noticed += other.noticed;
  false_places += other.false_places;
  gateways += other.gateways;
  gateways_found += other.gateways_found;
  gateways_false += other.gateways_false;
  stars_true += other.stars_true;
  revisits += other.revisits;
  same_star += other.same_star;
  return *this;
}

bool is_place(const Building& building, int junction) {
  const std::vector<double> ways = ways_of(building, junction);
  return ways.size() != 2 || !is_straight(ways[0], ways[1]);
}

std::vector<int> walk_of(const Building& building, int session, int travels) {
  const sim::World world = building.session(session, travels);
  std::vector<int> walk;
  for (const sim::NamedPoint& point : world.tours.front().waypoints) {
    walk.push_back(std::stoi(point.name));
  }
  return walk;
}

BuildingScore score_of(const Building& building,
                       const std::vector<int>& walk,
                       const std::vector<SimulatedVisit>& visits) {
  std::vector<int> passed;
  std::copy_if(walk.begin(), walk.end(), std::back_inserter(passed),
               [&](int junction) { return is_place(building, junction); });
  const std::vector<std::optional<std::size_t>> position = laid_along(passed, visits);
  BuildingScore score;
  score.passages = passed.size();
  std::map<int, SeenStar> first;
  for (std::size_t i = 0; i < visits.size(); ++i) {
    const SimulatedVisit& visit = visits[i];
    if (!position[i]) {
      const bool is_at_place = visit.junction && is_place(building, *visit.junction);
      score.false_places += is_at_place ? 0 : 1;  // a second visit at one passage is none
      continue;
    }
    const std::vector<double> ways = ways_of(building, *visit.junction);
    const std::vector<int> way_of = way_of_gateway(ways, visit);
    const auto found = static_cast<std::size_t>(
        std::count_if(way_of.begin(), way_of.end(), [](int way) { return way >= 0; }));
    ++score.noticed;
    score.gateways += ways.size();
    score.gateways_found += found;
    score.gateways_false += way_of.size() - found;
    const bool is_whole = found == ways.size() && found == way_of.size();
    score.stars_true +=
        is_whole && is_continued_as(ways, way_of, visit.perceived.neighbourhood.star) ? 1U : 0U;
    const SeenStar seen = seen_star(visit, way_of);
    const auto [known, is_first] = first.emplace(*visit.junction, seen);
    score.revisits += is_first ? 0 : 1;
    score.same_star += !is_first && known->second == seen ? 1U : 0U;
  }
  return score;
}

}  // namespace cairn::lab
