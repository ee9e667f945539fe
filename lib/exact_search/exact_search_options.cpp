#include <algorithm>

#include "base/validator.hpp"
#include "exact_search/exact_search.hpp"
#include "star/isomorphism.hpp"

namespace cairn {
namespace {

template <typename Predicate>
bool all_stars(const Exploration& exploration, Predicate holds) {
  return holds(exploration.start) &&
         std::all_of(exploration.steps.begin(), exploration.steps.end(),
                     [&](const ExplorationStep& step) { return holds(step.star); });
}

bool has_four_slots(const Star& star) {
  return star.slots.size() == 4;
}

bool suits_corner_bound(const Star& star) {
  const std::string type = type_name(star);
  return type == "L" || type == "T" || type == "+" || type == "I";
}

}  // namespace

Status validate(const ExactSearchOptions& options, const Exploration& exploration) {
  if (Status status = validate(exploration); !status) {
    return status;
  }
  const bool has_headings = options.compass || options.straight_corridors;
  const bool has_bound = options.max_corners.has_value();
  return Validator("exact search")
      .require("max_places", options.max_places.value_or(1) >= 1, "be at least 1")
      .require("look_ahead_by_face",
               !options.look_ahead_by_face || (options.planar && options.look_ahead),
               "come with planar and look_ahead")
      .require("max_corners", options.max_corners.value_or(0) >= 0, "be at least 0")
      .require("max_corners", !has_bound || (options.planar && options.perpendicular),
               "come with planar and perpendicular")
      .require("max_corners", !has_bound || all_stars(exploration, suits_corner_bound),
               "come with stars L, T, + and I only")
      .require(options.compass ? "compass" : "straight_corridors",
               !has_headings || all_stars(exploration, has_four_slots),
               "come with stars of four slots only")
      .require("max_nodes", options.max_nodes >= 0, "be at least 0")
      .require("max_codes", options.max_codes >= 0, "be at least 0")
      .status();
}

Status validate(const ExactSearchOptions& options,
                const Exploration& exploration,
                SearchOrder order) {
  if (Status status = validate(options, exploration); !status) {
    return status;
  }
  const bool counts_corners =
      order == SearchOrder::kCorners || order == SearchOrder::kPathsWithCorners;
  return Validator("exact search")
      .require("order", !counts_corners || (options.planar && options.perpendicular),
               "not count corners without planar and perpendicular")
      .require("order", !counts_corners || all_stars(exploration, suits_corner_bound),
               "not count corners of stars other than L, T, + and I")
      .status();
}

}  // namespace cairn
