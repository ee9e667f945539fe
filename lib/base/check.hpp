#pragma once

namespace cairn {

/// Says where and what, then aborts. For broken preconditions and impossible states only: our own
/// bugs. systemd restarts the daemon, which goes on from its journal.
[[noreturn]] void fail_check(const char* condition, const char* file, int line);

}  // namespace cairn

/// On in every build.
#define CAIRN_CHECK(condition) \
  (static_cast<bool>(condition) ? void(0) : ::cairn::fail_check(#condition, __FILE__, __LINE__))
