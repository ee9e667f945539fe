#pragma once

#include <filesystem>
#include <string>

namespace cairn::sim {

/// The whole of a text file of at most 32 MB.
/// @throws BadWorld
[[nodiscard]] std::string read_text(const std::filesystem::path& file);

/// The word as a finite number.
/// @param where file and line, for the message
/// @throws BadWorld "WHERE: expected MEANING, got 'WORD'"
[[nodiscard]] double number_of(const std::string& word,
                               const std::string& meaning,
                               const std::string& where);

}  // namespace cairn::sim
