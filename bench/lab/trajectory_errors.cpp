#include "bench/lab/trajectory_errors.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>

namespace cairn::lab {

std::vector<TravelShare> shares_of_travels(const std::vector<Relation>& relations,
                                           const std::vector<TrackedPose>& track,
                                           const std::vector<TravelSpan>& spans) {
  std::vector<TravelShare> shares;
  for (const TravelSpan& span : spans) {
    shares.push_back({span.visit});
  }
  const auto share_at = [&](double time_s) -> TravelShare& {
    const auto after =
        std::upper_bound(spans.begin(), spans.end(), time_s,
                         [](double time, const TravelSpan& span) { return time < span.begin_s; });
    return shares[static_cast<std::size_t>(std::max<std::ptrdiff_t>(after - spans.begin() - 1, 0))];
  };
  double all_m = 0.0;
  const std::vector<std::optional<RelationError>> errors = errors_over(relations, track);
  for (std::size_t i = 0; i < relations.size(); ++i) {
    if (!errors[i]) {
      continue;
    }
    const double error_m = errors[i]->translation_m;
    all_m += error_m;
    for (const double time_s : {relations[i].from_s, relations[i].to_s}) {
      TravelShare& share = share_at(time_s);
      ++share.relations;
      share.mean_m += error_m;
      share.share += 0.5 * error_m;
    }
  }
  for (TravelShare& share : shares) {
    share.mean_m /= static_cast<double>(std::max<std::int64_t>(share.relations, 1));
    share.share = all_m > 0.0 ? share.share / all_m : 0.0;
  }
  std::stable_sort(shares.begin(), shares.end(),
                   [](const TravelShare& a, const TravelShare& b) { return a.share > b.share; });
  return shares;
}

}  // namespace cairn::lab
