#include "bench/lab/place_pictures.hpp"

#include <cstdint>
#include <string>

#include "clients/common/place_picture.hpp"
#include "clients/common/progress.hpp"
#include "clients/common/text.hpp"
#include "transport/place_messages.hpp"

namespace cairn::lab {

void draw_place_sheet(const std::vector<PlaceVisit>& visits,
                      const PlaceOptions& options,
                      const std::filesystem::path& png) {
  std::vector<cairn_lcm::perceived_place_t> places;
  for (const PlaceVisit& visit : visits) {
    places.push_back(to_perceived_place(visit, static_cast<std::int64_t>(places.size()), options));
  }
  clients::write_png(clients::draw_place_sheet(places), png);
}

void draw_places(const std::vector<PlaceVisit>& visits,
                 const PlaceOptions& options,
                 const std::filesystem::path& folder) {
  clients::make_folder(folder);
  clients::Progress progress("drawing places");
  for (std::size_t i = 0; i < visits.size(); ++i) {
    const auto number = static_cast<std::int64_t>(i);
    clients::write_png(
        clients::draw_perceived_place(to_perceived_place(visits[i], number, options), {}),
        folder / ("visit-" + std::to_string(i) + ".png"));
    progress.show(number + 1, static_cast<std::int64_t>(visits.size()));
  }
}

}  // namespace cairn::lab
