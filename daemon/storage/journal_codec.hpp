#pragma once

#include <cstdint>
#include <vector>

#include "base/result.hpp"
#include "service/experience.hpp"

namespace cairn {

/// Rows of the journal: cairn_journal messages, compressed with zstd. Equal values give equal
/// bytes.
[[nodiscard]] std::vector<std::uint8_t> to_row(const PerceivedScan& scan);
[[nodiscard]] std::vector<std::uint8_t> to_row(const Visit& visit);

/// kMalformed for bytes that are no such row, or whose numbers do not fit together.
[[nodiscard]] Result<PerceivedScan> scan_of_row(const std::vector<std::uint8_t>& row);
[[nodiscard]] Result<Visit> visit_of_row(const std::vector<std::uint8_t>& row);

}  // namespace cairn
