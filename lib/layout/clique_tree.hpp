#pragma once

#include <cstdint>
#include <vector>

#include "layout/clique.hpp"

namespace cairn {

/// Changes of a step that are not worth following, by place.
struct StepTolerance {
  double m = 0.0;
  double rad = 0.0;
};

/// The normal equations of a layout, factored, and changed in proportion to what changes: the
/// cliques above are made anew, the trees below are kept. Copies share their cliques. Part of the
/// place layout; not for other layers.
///
/// Source: Kaess et al., iSAM2, IJRR 2012: the Bayes tree (Sec. 3), its update (Alg. 4), fluid
/// relinearisation (Alg. 5) and partial state updates (Alg. 7).
class CliqueTree {
 public:
  /// Takes up new travels between places: those above them are ordered and eliminated anew.
  /// @param touched the places of the new travels, those that are not in the tree yet included;
  ///     never place 0
  /// @return false where the curvature is not positive definite: the tree is then of no use
  [[nodiscard]] bool take_up(const std::vector<int>& touched,
                             const LinearisedTravels& travels,
                             CliqueMaker* maker);

  /// The same after some places were linearised anew.
  /// @param moved these places; never place 0
  [[nodiscard]] bool relinearise(const std::vector<int>& moved,
                                 const LinearisedTravels& travels,
                                 CliqueMaker* maker);

  /// Solves for the steps where they change by more than the tolerance, in what was made anew since
  /// the last time and below it.
  /// @param tolerances by place
  /// @param steps by place, of (x, y, theta) from where its travels were linearised
  /// @return the places whose steps changed
  [[nodiscard]] std::vector<int> solve(const std::vector<StepTolerance>& tolerances,
                                       PlaceVector* steps);

  /// Takes all places out.
  void clear();

  /// How many places the cliques made anew eliminate, all calls together: the work done.
  [[nodiscard]] std::int64_t eliminated_count() const { return eliminated_count_; }

 private:
  /// A clique to be made, with what becomes its child and is there already.
  struct Task {
    std::vector<int> places;
    int eliminated = 0;
    int parent = -1;  ///< Among the tasks.
    std::vector<CliquePtr> children;
  };

  void make_room(std::size_t place_count);
  [[nodiscard]] bool is_known(int place) const;
  void mark_up(int place);
  void mark_down(const std::vector<int>& moved);
  [[nodiscard]] std::vector<CliquePtr> take_marked();
  [[nodiscard]] std::vector<Task> plan(const std::vector<CliquePtr>& marked,
                                       const std::vector<int>& touched,
                                       const TravelGraph& graph) const;
  void hang_below(std::vector<CliquePtr> below, std::vector<Task>* tasks) const;
  [[nodiscard]] std::vector<Task> same_again(const std::vector<CliquePtr>& marked) const;
  [[nodiscard]] bool carry_out(std::vector<Task> tasks,
                               const LinearisedTravels& travels,
                               CliqueMaker* maker);

  std::vector<CliquePtr> roots_;
  std::vector<int> head_of_;              ///< By place: the first place of its clique, or -1.
  std::vector<const Clique*> clique_of_;  ///< By first place of a clique.
  std::vector<int> parent_of_;            ///< By first place: that of the parent, or -1.
  std::vector<char> is_marked_;           ///< By first place: to be made anew, else 0.
  std::vector<char> is_fresh_;            ///< By first place: made since the last solution.
  std::int64_t eliminated_count_ = 0;
};

}  // namespace cairn
