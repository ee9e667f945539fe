#pragma once

#include <array>
#include <functional>
#include <optional>
#include <set>
#include <vector>

#include "topology/evidence.hpp"
#include "topology/experience_log.hpp"
#include "topology/link_regions.hpp"
#include "topology/path_marks.hpp"
#include "topology/step.hpp"
#include "topology/topology_options.hpp"

namespace cairn {

/// A step that was considered, possible or not.
struct Alternative {
  StepKind kind = StepKind::kStart;
  Refutation refuted_by = Refutation::kNone;
  Misreading misreading = Misreading::kNone;
  double log_likelihood = 0.0;  ///< Prior, evidence and penalties of this step; not the layout.
  MapChange amendment;          ///< Carried out first; kNothing for most steps.
  MapChange change;
  GatewayIndex departure = kNoGateway;
  GatewayIndex position = kNoGateway;  ///< The gateway by which the robot came in, after the step.
  /// The visit before missed or imagined a gateway, and only its departure tells which.
  bool is_departure_open = false;
  /// The gateway of arrival for people; no place for a new one.
  GatewayRef target;
};

/// What an operator says about the place of a visit.
struct PlaceOrder {
  std::optional<PlaceId> must_be;
  std::vector<PlaceId> must_not_be;

  [[nodiscard]] bool is_empty() const { return !must_be && must_not_be.empty(); }
  /// @param place none: a new one
  [[nodiscard]] bool allows(std::optional<PlaceId> place) const;
};

/// One hypothesis at the moment of an arrival.
struct Situation {
  GatewayIndex position = kNoGateway;  ///< Where the robot was before.
  VisitId visit;                       ///< The new one.
  PlaceOrder order;
};

/// Lists everything that an arrival may mean to a map, possible or not: Fig. 4, steps 1 to 3 of
/// Kuipers et al., ICRA 2004, with (2c) of Savelli and Kuipers (IROS 2004) when planar. From a
/// known link: that place, if the view agrees. From a pending gateway: every pending gateway,
/// clockwise, then the new place. Where stars may be misread, also the steps that blame an
/// observation.
class Successors {
 public:
  enum class Detail {
    kPossible,  ///< Refuted alternatives are counted only.
    kAll,       ///< They are listed too, those behind other faces as well.
  };

  /// @param map at the hypothesis whose successors are asked for; all of them outlive it
  Successors(const TopologyOptions& options,
             const Evidence& evidence,
             const ExperienceLog& experience,
             StarCatalogue& stars,
             WorkingMap& map)
      : options_(&options),
        evidence_(&evidence),
        experience_(&experience),
        stars_(&stars),
        map_(map),
        is_noisy_(options.noisy_stars),
        departing_path_(map),
        regions_(map) {}

  /// Replaces what `found` held. Leaves the map as it was.
  void list(const Situation& situation, Detail detail, std::vector<Alternative>& found);
  /// From now on the travel to this visit may have gone anywhere, at a penalty.
  void allow_rejoining(VisitId visit) { rejoining_.insert(visit); }
  /// The robot goes on although nothing explains it: at a new place by an unexplained gateway, or,
  /// where an operator says so, at the place that he names.
  [[nodiscard]] Alternative unexplained(const Situation& situation);
  /// The gateway of the map, wherever it is, by which the robot came in if evidence is asked alone.
  struct Recognised {
    GatewayIndex at = kNoGateway;  ///< None looks like the view.
    /// Of visits, star and way; where nothing is known of the way, each gateway that looks like it
    /// being equally likely before.
    double log_likelihood = 0.0;
    /// The most that could be said of any if only those visits had been there that say so.
    double in_favour = 0.0;
  };
  [[nodiscard]] Recognised likeliest_place(VisitId visit) const;

  /// By Refutation; of all that was considered so far.
  [[nodiscard]] const std::array<std::int64_t, kRefutations>& refuted() const { return refuted_; }
  /// Of these, known links whose view differs.
  [[nodiscard]] std::int64_t links_contradicted() const { return links_contradicted_; }
  /// While a repair search goes on, stars may be misread in any case.
  void set_noisy(bool is_noisy) { is_noisy_ = is_noisy; }

 private:
  struct Arrival {
    VisitId visit;
    ReadingMatcher* view = nullptr;
    const PlaceOrder* order = nullptr;
    Detail detail = Detail::kPossible;
    double log_before = 0.0;  ///< Of what happened on the way.
    StepKind on_the_way = StepKind::kStart;
    MapChange amendment = {};  ///< Which the map has taken for the time being.
    bool is_departure_open = false;
  };

  struct Amendment {
    MapChange change;
    int arrival_number = 0;       ///< Of the gateway of arrival in the corrected star.
    double log_likelihood = 0.0;  ///< Of all visits to the place, compared with the star as it was.
    Misreading misreading = Misreading::kNone;  ///< Of this visit, if the star were as it was.
  };

  /// One gateway in the numbers of two visits.
  struct GatewayPair {
    int known = 0;
    int now = 0;
  };

  void at_known_link(GatewayIndex departure, const Arrival& arrival);
  void at_pending_gateway(GatewayIndex departure, const Arrival& arrival);
  void woken_up(const Arrival& arrival);
  void consider_closing(GatewayIndex departure,
                        GatewayIndex target,
                        double penalty,
                        const Arrival& arrival);
  [[nodiscard]] double log_prior_of_closing(PlaceId place, VisitId visit) const;
  void list_other_faces(GatewayIndex departure, const Arrival& arrival);
  void consider_new_places(GatewayIndex departure, const Arrival& arrival);
  [[nodiscard]] Refutation refutation_of_link(GatewayIndex departure, GatewayIndex target);

  // Steps that blame an observation: noisy_successors.cpp, star_corrections.cpp.
  void consider_misreading(GatewayIndex departure,
                           GatewayIndex target,
                           const ReadingMatch& match,
                           const Arrival& arrival);
  [[nodiscard]] bool is_worth_blaming(double log_likelihood, PlaceId place, VisitId visit) const;
  [[nodiscard]] double penalty_of_paths(GatewayIndex departure, GatewayIndex target);
  [[nodiscard]] double penalty_around(PlaceId place) const;
  [[nodiscard]] double penalty_of_link(GatewayIndex departure, GatewayIndex target);
  [[nodiscard]] double penalty_of_amending(const Alternative& amended,
                                           GatewayIndex departure,
                                           GatewayIndex target);
  void consider_amendments(GatewayIndex departure,
                           GatewayIndex target,
                           const ReadingMatch& match,
                           const Arrival& arrival);
  void consider_amending(GatewayIndex departure,
                         GatewayIndex target,
                         const Amendment& amendment,
                         const Arrival& arrival);
  [[nodiscard]] std::optional<Amendment> amendment_of(PlaceId place,
                                                      GatewayIndex target,
                                                      const ReadingMatch& match,
                                                      int choice,
                                                      const Arrival& arrival);
  [[nodiscard]] bool was_used(GatewayIndex at) const;
  void consider_unnoticed(GatewayIndex departure, const Arrival& arrival);
  void consider_inserting(GatewayIndex departure, const Arrival& arrival);
  void consider_branching(GatewayIndex departure, const Arrival& arrival);
  void consider_unexplained(GatewayIndex departure, const Arrival& arrival);
  void consider_rejoining(GatewayIndex departure, const Arrival& arrival);
  [[nodiscard]] bool is_recognised() const;
  void consider_unseen_gateways(GatewayIndex departure, const Arrival& arrival);
  void consider_unseen_gateways_of(GatewayIndex departure, int reading, const Arrival& arrival);
  void consider_unseen_gateway(
      GatewayIndex departure, GatewayIndex known, int beside, int reading, const Arrival& arrival);

  [[nodiscard]] GatewayIndex likeliest_gateway(PlaceId place,
                                               GatewayIndex departure,
                                               VisitId visit) const;
  void from_unseen_gateway(GatewayIndex position, const Arrival& arrival);
  void depart_after_amending(PlaceId place,
                             const Amendment& amendment,
                             double charged,
                             const Arrival& arrival);

  [[nodiscard]] double asked(SeenGateway known, SeenGateway now) const;
  [[nodiscard]] double recognition(GatewayIndex target,
                                   const ReadingMatch& match,
                                   VisitId visit) const;
  struct Answers {
    double all = 0.0;
    double in_favour = 0.0;  ///< Of those that say "the same place".
  };
  [[nodiscard]] Answers answers(PlaceId place,
                                const std::vector<int>& gateway_of_view,
                                VisitId visit) const;
  [[nodiscard]] std::optional<GatewayPair> common_gateway(const VisitRecord& known,
                                                          StarId star,
                                                          const std::vector<int>& gateway_of_view,
                                                          VisitId visit) const;
  [[nodiscard]] int support(PlaceId place) const;
  void add(Alternative alternative, const Arrival& arrival);
  void refute(Refutation reason, Alternative alternative, const Arrival& arrival);

  const TopologyOptions* options_;
  const Evidence* evidence_;
  const ExperienceLog* experience_;
  StarCatalogue* stars_;
  WorkingMap& map_;
  bool is_noisy_;
  std::set<VisitId> rejoining_;
  std::vector<Alternative>* found_ = nullptr;
  Action action_;
  PathMarks departing_path_;
  LinkRegions regions_;
  std::array<std::int64_t, kRefutations> refuted_{};
  std::int64_t links_contradicted_ = 0;
};

}  // namespace cairn
