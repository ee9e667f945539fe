#include "topology/star_catalogue.hpp"

#include "base/check.hpp"

namespace cairn {

std::optional<StarId> StarCatalogue::find(const Star& star) const {
  for (std::size_t index = 0; index < entries_.size(); ++index) {
    if (entries_[index].star == star) {
      return StarId{static_cast<std::int32_t>(index)};
    }
  }
  return std::nullopt;
}

StarId StarCatalogue::add(const Star& star) {
  if (const std::optional<StarId> known = find(star)) {
    return *known;
  }
  CAIRN_CHECK(validate(star).ok());
  Entry entry{star, cairn::gateway_count(star), {}};
  for (int gateway = 0; gateway < entry.gateway_count; ++gateway) {
    const ViewClassId fresh{static_cast<std::int32_t>(view_classes_.size())};
    const ViewClassId view_class =
        view_classes_.try_emplace(view_code(star, gateway), fresh).first->second;
    entry.gateways.push_back(
        {slot_of_gateway(star, gateway), through_partner(star, gateway).value_or(-1), view_class});
  }
  entries_.push_back(std::move(entry));
  return StarId{static_cast<std::int32_t>(entries_.size() - 1)};
}

}  // namespace cairn
