#pragma once

#include <memory>
#include <string>

#include "base/result.hpp"

namespace cairn {

/// Holds a file for this process alone among those that ask: two daemons must not write one map.
/// Readers that do not ask are not disturbed. Gone with the process, however it ends.
class FileLock {
 public:
  FileLock() = default;
  /// kUnavailable where another process holds the file, or it cannot be opened; creates it.
  [[nodiscard]] static Result<FileLock> hold(const std::string& file);

 private:
  struct Closer {
    void operator()(const int* descriptor) const;
  };
  std::unique_ptr<int, Closer> descriptor_;
};

}  // namespace cairn
