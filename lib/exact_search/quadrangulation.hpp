#pragma once

#include <functional>
#include <vector>

#include "topology/star_catalogue.hpp"

namespace cairn {

/// The pending gateways of one face in clockwise order, each with the corners between it and the
/// next one (see CornerBound).
struct FaceRing {
  std::vector<ViewClassId> views;
  std::vector<int> stretches;
};

/// Whether links alone may cut a face into faces of four corners each; false is certain.
///
/// Without new places the last link cuts off a stretch of four corners, so one must be there. Where
/// neither end of it can be passed straight on along stretches without corners, the two ends must
/// be linked, and the rest of the face is judged in the same way.
class Quadrangulation {
 public:
  using CanLink = std::function<bool(ViewClassId, ViewClassId)>;

  [[nodiscard]] bool may_exist(const FaceRing& ring, const CanLink& can_link);

 private:
  [[nodiscard]] bool is_forced(int first, const FaceRing& ring, const CanLink& can_link) const;
  [[nodiscard]] bool cut_off(int first, const FaceRing& ring, const CanLink& can_link);

  std::vector<int> stretch_;
  std::vector<int> next_;
  std::vector<int> previous_;
};

}  // namespace cairn
