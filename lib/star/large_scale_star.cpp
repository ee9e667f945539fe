#include "star/large_scale_star.hpp"

#include "base/check.hpp"
#include "star/small_scale_star.hpp"

namespace cairn {

LargeScaleStar abstracted(const Star& star, std::size_t first_slot) {
  const SlotNames names = names_from(star, first_slot);
  LargeScaleStar large;
  for (std::size_t step = 0; step < star.slots.size(); ++step) {
    const std::size_t slot = (first_slot + step) % star.slots.size();
    large.dstates.push_back(
        {names.fragment[slot], names.is_plus[slot], star.slots[slot].gateway < 0, slot});
  }
  return large;
}

std::vector<std::size_t> right_of(const LargeScaleStar& star, std::size_t dstate) {
  CAIRN_CHECK(dstate < star.dstates.size());
  std::vector<std::size_t> right;
  const int own_path = star.dstates[dstate].path;
  for (std::size_t step = 1; step < star.dstates.size(); ++step) {
    const std::size_t next = (dstate + step) % star.dstates.size();
    if (star.dstates[next].path == own_path) {
      break;
    }
    right.push_back(next);
  }
  return right;
}

std::string to_text(const LargeScaleStar& star) {
  std::string text = "(";
  for (std::size_t index = 0; index < star.dstates.size(); ++index) {
    const Dstate& dstate = star.dstates[index];
    const std::string path = "Pa" + std::to_string(dstate.path) + (dstate.is_forward ? "+" : "-");
    text += index == 0 ? "" : ",\n";
    text += "(ds" + std::to_string(index + 1) + ", " +
            (dstate.terminates ? "(" + path + ")" : path) + ")";
  }
  return text + ")";
}

std::string large_scale_text(const Star& star, std::size_t first_slot) {
  return to_text(abstracted(star, first_slot));
}

}  // namespace cairn
