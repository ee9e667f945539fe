#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <utility>
#include <vector>

#include "topology/experience.hpp"
#include "topology/reading_match.hpp"
#include "topology/working_map.hpp"

namespace cairn {

/// All that a tree was told: actions and views, equal views kept once.
class ExperienceLog {
 public:
  /// @param stars outlives the log; the stars of the views are added to it
  ExperienceLog(StarCatalogue& stars, const MisreadingCosts& costs)
      : stars_(&stars), costs_(costs) {}

  /// @param is_carried the robot did not travel here; `action` is nothing then
  /// @pre the view is valid and its visit the next one
  void add(Action action, const View& view, bool is_carried);

  [[nodiscard]] int size() const { return static_cast<int>(entries_.size()); }
  /// The view, except for the number of its visit.
  [[nodiscard]] const View& view(VisitId visit) const { return of(visit).matcher->view(); }
  [[nodiscard]] ReadingMatcher& matcher(VisitId visit) const { return *of(visit).matcher; }
  /// By which the robot came to the visit.
  [[nodiscard]] Action action(VisitId visit) const { return {of(visit).turn}; }
  [[nodiscard]] bool is_carried(VisitId visit) const { return of(visit).is_carried; }

  /// The gateway through which the robot left for the next visit, in the numbers of this visit's
  /// first reading.
  [[nodiscard]] int departing_number(VisitId visit, Action action) const;
  /// The same gateway in a map in which the robot came to this visit by `position`; kNoGateway
  /// where the place's star lacks it. Where a gateway was missed or imagined, the first choice is
  /// taken.
  [[nodiscard]] GatewayIndex departure(const WorkingMap& map,
                                       GatewayIndex position,
                                       VisitId visit,
                                       Action action) const;
  struct Departure {
    GatewayIndex by = kNoGateway;
    double log_likelihood = 0.0;  ///< Of the visit, compared with the first choice.
  };
  /// All that it may be, the first choice first; each once.
  [[nodiscard]] std::vector<Departure> departures(const WorkingMap& map,
                                                  GatewayIndex position,
                                                  VisitId visit,
                                                  Action action) const;
  /// For each gateway of the visit's first reading its number at the place; -1: none.
  /// @param number of the gateway of arrival at the place
  /// @param left_by number of the gateway of departure at the place, to choose between missed or
  /// imagined gateways; -1: not known
  [[nodiscard]] std::vector<int> gateways_at(VisitId visit,
                                             StarId star,
                                             int number,
                                             int left_by) const;

  [[nodiscard]] std::size_t bytes() const;

 private:
  struct Entry {
    ReadingMatcher* matcher = nullptr;
    std::int32_t turn = 0;
    bool is_carried = false;
  };
  [[nodiscard]] const Entry& of(VisitId visit) const { return entries_[visit.index()]; }
  ReadingMatcher* matcher_of(const View& view);

  StarCatalogue* stars_;
  MisreadingCosts costs_;
  std::vector<Entry> entries_;
  std::deque<View> views_;               // Distinct ones; they stay where they are.
  std::deque<ReadingMatcher> matchers_;  // One for each.
  std::map<std::pair<StarId, int>, ReadingMatcher*> plain_;  // Of a single, certain reading.
};

}  // namespace cairn
