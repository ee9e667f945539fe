#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "exact_search/corner_bound.hpp"
#include "exact_search/exact_search.hpp"
#include "exact_search/face_look_ahead.hpp"
#include "exact_search/headings.hpp"
#include "exact_search/look_ahead.hpp"
#include "exact_search/observed_walk.hpp"
#include "topology/link_regions.hpp"
#include "topology/path_marks.hpp"
#include "topology/working_map.hpp"

namespace cairn {

/// What a search knows of a map without looking into it, and where the robot is.
struct MapSummary {
  GatewayIndex arrival = kNoGateway;  ///< By which the robot came in.
  std::int32_t places = 1;
  std::int32_t paths = 0;
  std::int32_t pending = 0;
  std::int32_t lone_paths = 0;       ///< Known from one place only.
  std::int32_t terminated_ends = 0;  ///< Of path fragments: twice the paths of a closed map.
  std::int32_t corners = 0;          ///< Places of type L.
  std::int32_t corners_needed = 0;   ///< Further ones, by CornerBound; 0 where it is not in use.
  bool region_consistent = true;
  bool perpendicular = true;
};

/// A child of a node of the tree of maps.
struct Successor {
  /// kNothing, kPlace or kLink.
  MapChange change;
  MapSummary summary;
};

/// The one working state of a search, moved along the edges of the tree of maps.
class ExactSearchState {
 public:
  struct Needs {
    bool regions = false;  ///< Keep MapSummary's last two fields even where nothing prunes by them.
    bool corner_bound = false;
  };

  /// @pre the options suit the exploration; the walk outlives the state
  ExactSearchState(const ObservedWalk& walk, const ExactSearchOptions& options, Needs needs);
  ExactSearchState(const ExactSearchState&) = delete;
  ExactSearchState& operator=(const ExactSearchState&) = delete;

  [[nodiscard]] const MapSummary& start() const { return start_; }
  /// False: no map that this experience leads to can be without pending gateways, and only such
  /// maps are asked for.
  [[nodiscard]] bool allows_start() const;

  /// Appends what is consistent with a step, closures first, then the new place.
  /// @pre the map is the node's
  void expand(const MapSummary& node, int step, std::vector<Successor>* successors);
  /// Leaves that expand() dropped since a known link led to another view.
  [[nodiscard]] std::int64_t view_mismatches() const { return view_mismatches_; }

  void apply(const MapChange& change, int step);
  void undo(const MapChange& change, int step);
  /// The change by which a successor was made, from the gateway that it leads to.
  [[nodiscard]] GatewayIndex departure(const MapSummary& node, int step) const;
  /// The summary without lone_paths, corners_needed and the last two fields, which are the
  /// parent's.
  [[nodiscard]] MapSummary outline(const MapSummary& node, const MapChange& change) const;

 private:
  void follow(const MapSummary& node, int step, GatewayIndex departure, std::vector<Successor>*);
  void add_links(const MapSummary& node, int step, GatewayIndex departure, std::vector<Successor>*);
  void add_place(const MapSummary& node, int step, GatewayIndex departure, std::vector<Successor>*);
  [[nodiscard]] bool suits_headings(GatewayIndex a, GatewayIndex b) const;
  [[nodiscard]] bool suits_paths(GatewayIndex departure, GatewayIndex target, MapSummary*);
  [[nodiscard]] bool suits_bound(const MapSummary& summary, int step) const;
  [[nodiscard]] bool suits_faces(const MapSummary& node);
  [[nodiscard]] bool is_lone(GatewayIndex pending) const;

  const ObservedWalk* walk_;
  ExactSearchOptions options_;
  Needs needs_;
  WorkingMap map_;
  PathMarks marks_;
  LinkRegions regions_;
  CornerBound bound_;
  Headings headings_;
  LookAhead look_ahead_;
  std::optional<FaceLookAhead> faces_;  // Where it is asked for.
  MapSummary start_;
  std::int64_t view_mismatches_ = 0;
};

}  // namespace cairn
