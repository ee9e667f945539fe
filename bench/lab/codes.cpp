#include "bench/lab/codes.hpp"

#include <algorithm>
#include <sstream>

#include "base/check.hpp"
#include "star/isomorphism.hpp"

namespace cairn::lab {

std::string view_token(const Star& star, int gateway) {
  const int count = gateway_count(star);
  int first = 0;
  for (int other = 1; other < count; ++other) {
    first = view_code(star, other) > view_code(star, first) ? other : first;
  }
  int number = 0;
  while (!are_alike(star, (first + number) % count, star, gateway)) {
    ++number;
  }
  return type_name(star) + std::to_string(number);
}

std::vector<CodedPlace> parsed_code(const std::string& code) {
  std::vector<CodedPlace> places;
  for (std::size_t begin = 0; begin < code.size();) {
    const std::size_t open = code.find('[', begin);
    const std::size_t close = code.find(']', begin);
    CAIRN_CHECK(open != std::string::npos && close != std::string::npos && open < close);
    CodedPlace place{code.substr(begin, open - begin), {}};
    std::istringstream exits(code.substr(open + 1, close - open - 1));
    for (std::string exit; exits >> exit;) {
      const std::size_t point = exit.find('.');
      place.exits.push_back(exit == "-" ? CodedPlace::Exit{}
                                        : CodedPlace::Exit{std::stoi(exit.substr(0, point)),
                                                           std::stoi(exit.substr(point + 1))});
    }
    places.push_back(std::move(place));
    begin = close + 1;
  }
  return places;
}

std::string renamed_code(const std::string& code, const std::map<std::string, std::string>& names) {
  std::string renamed;
  for (std::size_t begin = 0; begin < code.size();) {
    const std::size_t open = std::min(code.find('[', begin), code.size());
    const std::size_t end = std::min(code.find(']', open), code.size() - 1) + 1;
    const std::string view = code.substr(begin, open - begin);
    const auto name = names.find(view);
    renamed += (name == names.end() ? view : name->second) + code.substr(open, end - open);
    begin = end;
  }
  return renamed;
}

}  // namespace cairn::lab
