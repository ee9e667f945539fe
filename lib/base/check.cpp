#include "base/check.hpp"

#include <cstdio>
#include <cstdlib>

namespace cairn {

void fail_check(const char* condition, const char* file, int line) {
  // The one print of lib/: the process is about to die and nobody else can say why.
  static_cast<void>(
      std::fprintf(stderr, "CAIRN_CHECK failed: %s (%s:%d)\n", condition, file, line));
  std::abort();
}

}  // namespace cairn
