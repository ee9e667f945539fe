#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace cairn {

/// The first position from `from` on, before `end`, whose byte is not `value`; `end` if there is
/// none. Looks at eight bytes at a time.
[[nodiscard]] inline std::size_t end_of_run(const std::uint8_t* bytes,
                                            std::size_t from,
                                            std::size_t end,
                                            std::uint8_t value) {
  const std::uint64_t eight = 0x0101010101010101U * value;
  while (from + sizeof(eight) <= end) {
    std::uint64_t here = 0;
    std::memcpy(&here, bytes + from, sizeof(here));
    if (here != eight) {
      break;
    }
    from += sizeof(eight);
  }
  while (from < end && bytes[from] == value) {
    ++from;
  }
  return from;
}

/// Calls visit(first, last) for every run of set bytes (1, all others being 0) of a part of a row,
/// `last` being the position behind the run.
template <typename Visit>
void for_each_run(const std::uint8_t* bytes, std::size_t from, std::size_t end, Visit visit) {
  for (std::size_t first = end_of_run(bytes, from, end, 0); first < end;) {
    const std::size_t last = end_of_run(bytes, first, end, 1);
    visit(first, last);
    first = end_of_run(bytes, last, end, 0);
  }
}

}  // namespace cairn
