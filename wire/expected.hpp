#pragma once

#include <string>
#include <utility>
#include <variant>

namespace cairn::wire {

/// Either a value or what went wrong. Stands here because clients know no lib/; errors that a
/// person reads are one line of text.
template <class T, class E = std::string>
class [[nodiscard]] Expected {
 public:
  Expected(T value) : state_(std::in_place_index<0>, std::move(value)) {}  // NOLINT
  [[nodiscard]] static Expected failure(E error) {
    return Expected(std::in_place_index<1>, std::move(error));
  }

  [[nodiscard]] bool ok() const { return state_.index() == 0; }
  explicit operator bool() const { return ok(); }

  /// @pre ok(); all four. A breach throws std::bad_variant_access.
  [[nodiscard]] T& operator*() & { return std::get<0>(state_); }
  [[nodiscard]] const T& operator*() const& { return std::get<0>(state_); }
  [[nodiscard]] T&& operator*() && { return std::get<0>(std::move(state_)); }
  [[nodiscard]] T* operator->() { return &std::get<0>(state_); }
  [[nodiscard]] const T* operator->() const { return &std::get<0>(state_); }

  /// @pre !ok()
  [[nodiscard]] const E& error() const { return std::get<1>(state_); }

 private:
  template <std::size_t kIndex, class U>
  Expected(std::in_place_index_t<kIndex> index, U&& state)
      : state_(index, std::forward<U>(state)) {}

  std::variant<T, E> state_;
};

}  // namespace cairn::wire
