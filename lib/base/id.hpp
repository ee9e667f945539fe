#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>

namespace cairn {

/// A number that names one thing of one kind: ids of different tags do not mix. Default: no thing.
///
///     using PlaceId = Id<struct PlaceTag>;
template <typename Tag>
struct Id {
  std::int32_t value = -1;

  [[nodiscard]] bool is_valid() const { return value >= 0; }
  /// Position in a vector that is filled in the order of the ids.
  /// @pre is_valid()
  [[nodiscard]] std::size_t index() const { return static_cast<std::size_t>(value); }
  friend auto operator<=>(const Id&, const Id&) = default;
};

}  // namespace cairn

template <typename Tag>
struct std::hash<cairn::Id<Tag>> {
  std::size_t operator()(const cairn::Id<Tag>& id) const noexcept {
    return std::hash<std::int32_t>{}(id.value);
  }
};
