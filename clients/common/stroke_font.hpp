#pragma once

#include <string_view>

namespace cairn::clients {

/// The strokes of a character, for a font drawn with a pen: polylines apart by spaces, each a row
/// of points "xy" with x from 0 to 4 to the right and y up: 2 is the base line, 6 the top of small
/// letters, 8 that of capitals. Empty for a blank; '?' for every character that is not known.
[[nodiscard]] std::string_view glyph(char character);

inline constexpr int kGlyphBase = 2;          ///< Of the base line, in units of the strokes.
inline constexpr double kGlyphHeight = 6.0;   ///< Of a capital.
inline constexpr double kGlyphAdvance = 5.6;  ///< From one character to the next.

}  // namespace cairn::clients
