#pragma once

#include <cstdint>
#include <vector>

#include "layout/clique_tree.hpp"
#include "layout/place_layout.hpp"

namespace cairn {

/// A place layout that grows travel by travel and stays the most likely one: what `solve_layout`
/// gives for all travels so far, to about 1e-6 of chi2, for less.
///
///     IncrementalLayout layout;                  // place 0 alone
///     if (const Status added = layout.add_place(to_a_new_place); !added) return added;
///     if (const Status closed = layout.add_travel(between_known_places); !closed) return closed;
///     const Pose2 T_global_place = layout.T_global_place(place);
///
/// A new place is where its travel puts it: nothing is solved, no other place moves. A further
/// travel between known places solves anew what it changes: the cliques of the elimination tree
/// above the two, then those whose linearisation the movement has made stale, until none is. Where
/// that comes to no rest, or to one far off where the travel still contradicts the others, all is
/// solved from the linear start as well, which is what `solve_layout` does.
///
/// Plain least squares. Deterministic: the same travels in the same order give the same bits.
/// A copy takes a few plain arrays of the size of the map (a tenth of a millisecond for 3,500
/// places) and shares the factorisation, so hypotheses with a common past pay for it once.
///
/// Source: Modayil, Beeson and Kuipers, IROS 2004, Sec. IV-D, Eq. (15), solved as by iSAM2 of
/// Kaess et al., IJRR 2012.
class IncrementalLayout {
 public:
  /// Place 0 alone, at the origin.
  IncrementalLayout();

  [[nodiscard]] int place_count() const { return graph_.place_count(); }
  [[nodiscard]] const std::vector<TravelConstraint>& travels() const { return travels_; }
  /// @pre place is in [0, place_count())
  [[nodiscard]] Pose2 T_global_place(int place) const;
  /// All of them, by place.
  [[nodiscard]] std::vector<Pose2> T_global_place() const;
  /// Sum of the squared Mahalanobis lengths of all travels' residuals. Cost: linear in the travels.
  [[nodiscard]] double chi2() const;
  /// What was done so far: places eliminated, and solutions from the linear start.
  [[nodiscard]] std::int64_t eliminated_count() const { return tree_.eliminated_count(); }
  [[nodiscard]] int restart_count() const { return restart_count_; }

  /// Adds place number place_count() by the first travel to it, or from it.
  /// Errors: kInvalidValue where it does not join a known place and that one, is no sound
  /// displacement, or would be place 1,000,000; nothing is added then.
  [[nodiscard]] Status add_place(const TravelConstraint& travel);

  /// Adds a travel between known places; one from a place to itself counts and moves nothing.
  /// Errors: kInvalidValue as above for places that are not known; kNotConverged. Nothing is added
  /// then, and the places lie as before.
  [[nodiscard]] Status add_travel(const TravelConstraint& travel);

 private:
  /// What a travel changes, and is brought back where it cannot be laid out.
  struct State {
    CliqueTree tree;
    PlaceVector global_places;
    PlaceVector linearised;
    PlaceVector steps;
    std::vector<char> is_active;
  };
  /// Where a solution has come to rest; far off, it may be in the wrong valley.
  enum class Rest { kNearBy, kFarOff, kNone };

  [[nodiscard]] Status check(const TravelConstraint& travel, int place_count) const;
  void append(const TravelConstraint& travel);
  void activate_way_to(int place, std::vector<int>* touched);
  [[nodiscard]] double chi2_of(const PlaceVector& places, int travel_count) const;
  [[nodiscard]] Rest relax(const std::vector<int>& touched);
  [[nodiscard]] Status start_anew(bool is_at_rest);
  [[nodiscard]] bool linearise_all();
  [[nodiscard]] double greatest_turn_rad(const std::vector<int>& changed) const;
  void take_steps(const std::vector<int>& changed);
  void carry_along(const std::vector<int>& changed);
  [[nodiscard]] LinearisedTravels equations() const { return {graph_, linearised_, is_active_}; }

  std::vector<TravelConstraint> travels_;
  TravelGraph graph_;
  std::vector<int> first_travel_;  ///< By place: the travel that added it.
  CliqueTree tree_;
  PlaceVector global_places_;  ///< By place, as are the following.
  PlaceVector linearised_;     ///< Where its travels were expanded.
  PlaceVector steps_;          ///< From there to where it is.
  std::vector<StepTolerance> tolerances_;
  std::vector<char> is_active_;  ///< Whether it is in the tree; else it hangs on its first travel.
  CliqueMaker maker_;
  int restart_count_ = 0;
};

}  // namespace cairn
