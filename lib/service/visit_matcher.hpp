#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "layout/place_layout.hpp"
#include "place/recognition.hpp"
#include "service/experience.hpp"
#include "topology/topological_map.hpp"

namespace cairn {

/// Compares visits by their local maps, each pair under each alignment once, and turns a
/// topological map into what the layout needs to know of it.
class VisitMatcher {
 public:
  /// @param experience must outlive this object
  VisitMatcher(const Experience& experience, const MapMatchOptions& options)
      : experience_(experience), options_(options) {}

  /// The two gateways being the same; paired_gateways() tells which others are.
  /// @pre both visits are in the experience and have the gateways
  [[nodiscard]] const Recognition& compare(VisitId known, VisitId visit, GatewayPair pair) const;

  /// Natural log of how much better "the visit was to the known one's place" explains the local
  /// maps of the two visits than "it was elsewhere". Minus infinity where dead reckoning between
  /// them would have to be wrong by more than kRefutedAt_sigmas: then the maps are not compared.
  /// How far off it is below that does not count here: evidence by layout tells that of whole maps,
  /// and would tell it twice.
  [[nodiscard]] double log_likelihood_ratio(VisitId known, VisitId visit, GatewayPair pair) const;

  /// The place frame of a visit in that of an earlier one, by the travels between them.
  /// @pre known <= visit, which is in the experience
  [[nodiscard]] GaussianPose dead_reckoned(VisitId known, VisitId visit) const;

  /// Whether dead reckoning between two visits lets them have been to one place, within
  /// kReach_sigmas and kPlaceReach_m.
  [[nodiscard]] bool is_within_reach(VisitId known, VisitId visit) const;

  /// Log of how densely dead reckoning expects the visit's place where the known one's is (1/m²).
  [[nodiscard]] double log_density(VisitId known, VisitId visit) const;

  /// Evidence::log_prior_same: the log of that density where it is highest, compared with one place
  /// in kPlaceArea_m2; in [kLeastLogPrior, 0].
  [[nodiscard]] double log_prior_same(VisitId known, VisitId visit) const;

  /// The place frame of a visit in the frame of the place it was to: that of the place's first
  /// visit. By dead reckoning where no gateway was seen at both.
  [[nodiscard]] GaussianPose T_place_visit(const TopologicalMap& map, VisitId visit) const;

  /// F(lambda) of every travel, between the places that the map says they joined, in their order.
  /// Where the robot was carried nothing is known. Then those of two travels in a row, where the
  /// visit between them cannot be matched with its place.
  [[nodiscard]] std::vector<TravelConstraint> constraints(const TopologicalMap& map) const;

  /// The same in the order of the visits that they lead to: a map that adds visits to another one
  /// has that one's constraints first.
  [[nodiscard]] std::vector<TravelConstraint> constraints_by_visit(const TopologicalMap& map) const;

  /// So much is kept of visits' maps made ready for comparison; beyond it the least recently used
  /// ones are dropped, and worked out anew when they are needed. A map of 8 m x 8 m takes 0.3 MB.
  static constexpr std::size_t kMaxBytesReady = std::size_t{128} << 20U;

  /// What dead reckoning says against the places of visits that cannot be matched with them, since
  /// no gateway was seen at both: the squared Mahalanobis distance from the place, as wide as it
  /// is, summed over these visits. Constraints hold nothing against such a visit.
  [[nodiscard]] double chi2_of_unmatched(const TopologicalMap& map) const;

  /// Dead reckoning is given this many standard deviations before it refutes. Generous: slip and
  /// pushes make it wrong by more than its covariance says.
  static constexpr double kRefutedAt_sigmas = 20.0;
  static constexpr double kReach_sigmas = 3.0;
  static constexpr double kPlaceReach_m = 1.0;   ///< Sigma of where in a place its origin is read.
  static constexpr double kPlaceArea_m2 = 25.0;  ///< Of a building, one place to so much of it.
  static constexpr double kLeastLogPrior = -6.0;

 private:
  [[nodiscard]] std::vector<GatewayPair> pairs(VisitId known,
                                               VisitId visit,
                                               GatewayPair pair) const;
  /// A travel, or two in a row.
  struct Way {
    TravelConstraint constraint;
    bool passes_visit = false;
  };
  [[nodiscard]] std::vector<Way> ways(const TopologicalMap& map) const;
  /// None where no gateway was seen at both visits.
  [[nodiscard]] std::optional<GaussianPose> matched_at_place(const TopologicalMap& map,
                                                             VisitId visit) const;
  /// @return valid until two other maps were asked for
  [[nodiscard]] const MatchableMap& map_of(VisitId visit) const;
  /// Of the visit's place by dead reckoning, as seen from the known one's, which is kPlaceReach_m
  /// wide.
  struct Spread {
    double chi2 = 0.0;                 ///< Of both being one place.
    double log_highest_density = 0.0;  ///< 1/m².
  };
  [[nodiscard]] Spread spread_at_place(VisitId known, VisitId visit) const;

  struct ReadyMap {
    MatchableMap map;
    std::int64_t used = 0;  ///< Greater is later.
  };

  const Experience& experience_;
  MapMatchOptions options_;
  // Memos.
  mutable std::map<VisitId, ReadyMap> ready_;
  mutable std::size_t bytes_ready_ = 0;
  mutable std::int64_t uses_ = 0;
  mutable std::map<std::tuple<VisitId, VisitId, GatewayPair>, Recognition> compared_;
  /// By visit, then earlier visit; of the last kMostReckoned visits asked about.
  mutable std::map<VisitId, std::vector<GaussianPose>> dead_reckoned_;
};

}  // namespace cairn
