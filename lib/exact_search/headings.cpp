#include "exact_search/headings.hpp"

namespace cairn {

void Headings::add_place(const MapChange& change) {
  const std::size_t arrival_slot = map_->stars().slot_of(change.star, change.target);
  const auto onward = static_cast<std::size_t>(of(change.departure));
  // Coming in, the robot looks back against its heading.
  append(PlaceId{map_->place_count() - 1}, onward + 2 + 4 - arrival_slot % 4);
}

void Headings::remove_place(const MapChange& change) {
  headings_.resize(headings_.size() -
                   static_cast<std::size_t>(map_->stars().gateway_count(change.star)));
}

void Headings::append(PlaceId place, std::size_t zero) {
  const StarId star = map_->star(place);
  for (int gateway = 0; gateway < map_->stars().gateway_count(star); ++gateway) {
    const std::size_t heading = zero + map_->stars().slot_of(star, gateway);
    headings_.push_back(static_cast<std::uint8_t>(heading % 4));
  }
}

}  // namespace cairn
