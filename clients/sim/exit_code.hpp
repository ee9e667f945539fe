#pragma once

namespace cairn::sim {

// As in sysexits.h.
inline constexpr int kExitDone = 0;
inline constexpr int kExitUsage = 64;        ///< The command line.
inline constexpr int kExitBadData = 65;      ///< The world, its tour, or a picture.
inline constexpr int kExitNoService = 69;    ///< The bus.
inline constexpr int kExitCannotWrite = 73;  ///< The log or the truth beside it.

}  // namespace cairn::sim
