#include "place/place_options.hpp"

#include "base/validator.hpp"

namespace cairn {

Status validate(const PlaceOptions& options) {
  return Validator("place").positive("cell_m", options.cell_m).status();
}

}  // namespace cairn
