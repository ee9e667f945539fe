#include "clients/common/stroke_font.hpp"

#include <array>

namespace cairn::clients {
namespace {

constexpr std::array<std::string_view, 10> kDigits{
    "103041453616050110",          "152620 1030", "05163645440040",
    "0516364544334241301001 1333", "30360242",    "460603334241301001",
    "453616050110304142331302",    "064610",      "13334445361605041302011030414233",
    "011030414536160504133344",
};

constexpr std::array<std::string_view, 26> kLetters{
    "0004264440 0242",            // A
    "00063645443303 3342413000",  // B
    "4536160501103041",           // C
    "00062644422000",             // D
    "46060040 0333",              // E
    "460600 0333",                // F
    "45361605011030414323",       // G
    "0006 4046 0343",             // H
    "1030 1636 2026",             // I
    "0110304146",                 // J
    "0006 4602 1340",             // K
    "060040",                     // L
    "0006234640",                 // M
    "00064046",                   // N
    "103041453616050110",         // O
    "00063645443303",             // P
    "103041453616050110 2240",    // Q
    "00063645443303 2340",        // R
    "453616050413334241301001",   // S
    "0646 2620",                  // T
    "060110304146",               // U
    "062046",                     // V
    "0610233046",                 // W
    "0046 0640",                  // X
    "062346 2320",                // Y
    "06460040",                   // Z
};

}  // namespace

std::string_view glyph(char character) {
  static constexpr std::string_view kUnknownSign = "0516364544332322 2120";
  if (character >= '0' && character <= '9') {
    return kDigits[static_cast<std::size_t>(character - '0')];
  }
  if (character >= 'A' && character <= 'Z') {
    return kLetters[static_cast<std::size_t>(character - 'A')];
  }
  if (character >= 'a' && character <= 'z') {
    return kLetters[static_cast<std::size_t>(character - 'a')];
  }
  switch (character) {
    case ' ':
      return "";
    case '.':
      return "2021";
    case ',':
      return "2110";
    case '-':
      return "1333";
    case '_':
      return "0040";
    case '+':
      return "0343 2125";
    case '/':
      return "0046";
    case ':':
      return "2122 2425";
    case '(':
      return "36252130";
    case ')':
      return "16252110";
    case '#':
      return "1016 3036 0242 0444";
    case '%':
      return "0046 0516 3140";
    default:
      return kUnknownSign;
  }
}

}  // namespace cairn::clients
