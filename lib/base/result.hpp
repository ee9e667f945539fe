#pragma once

#include <string>
#include <utility>
#include <variant>

#include "base/check.hpp"

namespace cairn {

/// What went wrong with data or a resource from outside. A caller may branch on it.
enum class ErrorCode {
  kInvalidValue,   ///< Well-formed, but outside its documented range.
  kMalformed,      ///< Bytes or text that cannot be decoded.
  kOutOfOrder,     ///< Older than data that has already been absorbed.
  kContradiction,  ///< No hypothesis can explain it.
  kNotFound,       ///< Names a place, path or file that does not exist.
  kNotConverged,   ///< A solver stopped short of its tolerance.
  kUnavailable,    ///< A file, the bus or the clock cannot be used now.
};

struct Error {
  ErrorCode code = ErrorCode::kInvalidValue;
  std::string message;  ///< One line for an operator: expected what, got what, in which units.
};

/// Either a value or the reason why there is none. Must be looked at.
///
///     Result<LaserScan> scan = to_domain(message);
///     if (!scan) return scan.error();
///     joiner.add(*scan);
template <typename T>
class [[nodiscard]] Result {
 public:
  Result(T value) : state_(std::move(value)) {}      // NOLINT(google-explicit-constructor)
  Result(Error error) : state_(std::move(error)) {}  // NOLINT(google-explicit-constructor)

  [[nodiscard]] bool ok() const { return state_.index() == 0; }
  explicit operator bool() const { return ok(); }

  [[nodiscard]] T& operator*() & {
    CAIRN_CHECK(ok());
    return std::get<0>(state_);
  }
  [[nodiscard]] const T& operator*() const& {
    CAIRN_CHECK(ok());
    return std::get<0>(state_);
  }
  [[nodiscard]] T&& operator*() && {
    CAIRN_CHECK(ok());
    return std::move(std::get<0>(state_));
  }
  [[nodiscard]] T* operator->() { return &**this; }
  [[nodiscard]] const T* operator->() const { return &**this; }

  /// @pre !ok()
  [[nodiscard]] const Error& error() const {
    CAIRN_CHECK(!ok());
    return std::get<1>(state_);
  }

 private:
  std::variant<T, Error> state_;
};

/// A result without a value: done, or the reason why not.
class [[nodiscard]] Status {
 public:
  Status() = default;
  Status(Error error)
      : failed_(true), error_(std::move(error)) {}  // NOLINT(google-explicit-constructor)

  [[nodiscard]] bool ok() const { return !failed_; }
  explicit operator bool() const { return ok(); }
  /// @pre !ok()
  [[nodiscard]] const Error& error() const {
    CAIRN_CHECK(failed_);
    return error_;
  }

 private:
  bool failed_ = false;
  Error error_;
};

}  // namespace cairn
