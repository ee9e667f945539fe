#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

#include <gtest/gtest.h>

namespace cairn::test {

/// Where the recorded logs, maps and vectors lie: CAIRN_DATA, or ../shared/data beside the project.
inline std::filesystem::path recorded_data(const std::string& file) {
  const char* const chosen = std::getenv("CAIRN_DATA");  // NOLINT(concurrency-mt-unsafe)
  return std::filesystem::path(chosen != nullptr ? chosen : CAIRN_DEFAULT_DATA) / file;
}

}  // namespace cairn::test

/// Reports a test as skipped where a recorded file is absent.
#define CAIRN_NEED_DATA(file)                                         \
  if (!std::filesystem::exists(::cairn::test::recorded_data(file))) { \
    GTEST_SKIP() << "no " << ::cairn::test::recorded_data(file);      \
  }                                                                   \
  static_assert(true)
