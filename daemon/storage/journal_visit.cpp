#include <cmath>
#include <utility>

#include <cairn_journal/visit_record_t.hpp>

#include "star/star.hpp"
#include "storage/journal_codec.hpp"
#include "storage/journal_parts.hpp"
#include "wire/document.hpp"

namespace cairn::wire {

template <>
inline constexpr std::string_view kSignatureText<cairn_journal::visit_record_t> =
    "q q q d[=3] i i d[=3] d[=3] d[=2] i d d i {d[=4] d[=2] d d d}[12] i {i i i}[14] i {i i i}[16] "
    "i {i {i i i}[0] i i[2] d}[18] i {{d[=4] d[=2] d d d} d i}[20] "
    "{d d[=2] i i i h[4]}";

}  // namespace cairn::wire

namespace cairn {
namespace {

using journal::kMaxRowBytes;
using journal::malformed;
using journal::point_of;
using journal::pose_of;
using journal::put;

cairn_journal::gateway_record_t to_record(const Gateway& gateway) {
  cairn_journal::gateway_record_t record{};
  put(gateway.basis_points[0], record.basis_points_m);
  put(gateway.basis_points[1], record.basis_points_m + 2);
  put(gateway.middle, record.middle_m);
  record.width_m = gateway.width_m;
  record.outward_bearing_rad = gateway.outward_bearing_rad;
  record.seen_beyond_m = gateway.seen_beyond_m;
  return record;
}

Gateway gateway_of(const cairn_journal::gateway_record_t& record) {
  Gateway gateway;
  gateway.basis_points = {point_of(record.basis_points_m), point_of(record.basis_points_m + 2)};
  gateway.middle = point_of(record.middle_m);
  gateway.width_m = record.width_m;
  gateway.outward_bearing_rad = record.outward_bearing_rad;
  gateway.seen_beyond_m = record.seen_beyond_m;
  return gateway;
}

void put(const OccupancyGrid& grid, cairn_journal::grid_record_t* record) {
  const GridGeometry& geometry = grid.geometry();
  record->cell_m = geometry.cell_m;
  put(geometry.origin_m, record->origin_m);
  record->width = geometry.width;
  record->height = geometry.height;
  record->log_odds = grid.cells();
  record->num_cells = static_cast<int>(grid.cells().size());
}

Result<OccupancyGrid> grid_of(const cairn_journal::grid_record_t& record) {
  GridGeometry geometry;
  geometry.cell_m = record.cell_m;
  geometry.origin_m = point_of(record.origin_m);
  geometry.width = record.width;
  geometry.height = record.height;
  const bool is_sound = record.cell_m > 0.0 && std::isfinite(record.cell_m) &&
                        geometry.origin_m.allFinite() && record.width >= 0 && record.height >= 0 &&
                        geometry.cell_count() == record.log_odds.size();
  if (!is_sound) {
    return malformed("a grid whose size and cells do not agree");
  }
  OccupancyGrid grid(geometry);
  grid.cells() = record.log_odds;
  return grid;
}

std::vector<cairn_journal::slot_record_t> to_records(const Star& star) {
  std::vector<cairn_journal::slot_record_t> records;
  for (const StarSlot& slot : star.slots) {
    cairn_journal::slot_record_t one{};
    one.gateway = slot.gateway;
    one.partner = static_cast<int>(slot.partner);
    one.law = static_cast<int>(slot.law);
    records.push_back(one);
  }
  return records;
}

Result<Star> star_of(const std::vector<cairn_journal::slot_record_t>& records, int gateways) {
  const int count = static_cast<int>(records.size());
  Star star;
  for (const cairn_journal::slot_record_t& slot : records) {
    const bool is_sound = slot.partner >= 0 && slot.partner < count && slot.gateway >= -1 &&
                          slot.gateway < gateways && slot.law >= 0 &&
                          slot.law <= static_cast<int>(ControlLaw::kNone);
    if (!is_sound) {
      return malformed("a star that names a missing gateway or slot");
    }
    star.slots.push_back(
        {slot.gateway, static_cast<std::size_t>(slot.partner), static_cast<ControlLaw>(slot.law)});
  }
  if (const Status status = validate(star); !status) {
    return malformed(status.error().message);
  }
  if (gateway_count(star) != gateways) {
    return malformed("a star whose gateways are not those of the visit");
  }
  return star;
}

cairn_journal::reading_record_t to_record(const StarReading& reading) {
  cairn_journal::reading_record_t record{};
  record.slots = to_records(reading.star);
  record.num_slots = static_cast<int>(record.slots.size());
  record.gateways.assign(reading.gateways.begin(), reading.gateways.end());
  record.num_gateways = static_cast<int>(record.gateways.size());
  record.log_likelihood = reading.log_likelihood;
  return record;
}

Result<StarReading> reading_of(const cairn_journal::reading_record_t& record) {
  Result<Star> star = star_of(record.slots, record.num_gateways);
  if (!star) {
    return star.error();
  }
  return StarReading{
      *std::move(star), {record.gateways.begin(), record.gateways.end()}, record.log_likelihood};
}

void put(const PlaceNeighbourhood& neighbourhood, cairn_journal::visit_record_t* record) {
  put(neighbourhood.center, record->center_m);
  record->is_complete = neighbourhood.is_complete ? 1 : 0;
  record->radius_m = neighbourhood.radius_m;
  record->distinctiveness_share = neighbourhood.distinctiveness;
  for (const Gateway& gateway : neighbourhood.gateways) {
    record->gateways.push_back(to_record(gateway));
  }
  record->num_gateways = static_cast<int>(record->gateways.size());
  for (const PathFragment& fragment : neighbourhood.fragments) {
    cairn_journal::fragment_record_t one{};
    one.gateway = fragment.gateway;
    one.through = fragment.through;
    one.is_dead_end = fragment.is_dead_end ? 1 : 0;
    record->fragments.push_back(one);
  }
  record->num_fragments = static_cast<int>(record->fragments.size());
  record->slots = to_records(neighbourhood.star);
  record->num_slots = static_cast<int>(record->slots.size());
  for (const StarReading& reading : neighbourhood.others) {
    record->readings.push_back(to_record(reading));
  }
  record->num_readings = static_cast<int>(record->readings.size());
  for (const UnsureGateway& unsure : neighbourhood.unsure) {
    cairn_journal::unsure_gateway_record_t one{};
    one.gateway = to_record(unsure.gateway);
    one.log_odds = unsure.log_odds;
    one.is_doorway = unsure.is_doorway ? 1 : 0;
    record->unsure.push_back(one);
  }
  record->num_unsure = static_cast<int>(record->unsure.size());
}

Result<PlaceNeighbourhood> neighbourhood_of(const cairn_journal::visit_record_t& record) {
  PlaceNeighbourhood neighbourhood;
  neighbourhood.center = point_of(record.center_m);
  neighbourhood.is_complete = record.is_complete != 0;
  neighbourhood.radius_m = record.radius_m;
  neighbourhood.distinctiveness = record.distinctiveness_share;
  for (const cairn_journal::gateway_record_t& gateway : record.gateways) {
    neighbourhood.gateways.push_back(gateway_of(gateway));
  }
  for (const cairn_journal::fragment_record_t& fragment : record.fragments) {
    neighbourhood.fragments.push_back(
        {fragment.gateway, fragment.through, fragment.is_dead_end != 0});
  }
  Result<Star> star = star_of(record.slots, record.num_gateways);
  if (!star) {
    return star.error();
  }
  neighbourhood.star = *std::move(star);
  for (const cairn_journal::reading_record_t& reading : record.readings) {
    Result<StarReading> one = reading_of(reading);
    if (!one) {
      return one.error();
    }
    neighbourhood.others.push_back(*std::move(one));
  }
  for (const cairn_journal::unsure_gateway_record_t& unsure : record.unsure) {
    neighbourhood.unsure.push_back(
        {gateway_of(unsure.gateway), unsure.log_odds, unsure.is_doorway != 0});
  }
  return neighbourhood;
}

bool is_finite(const PlaceVisit& visit) {
  double sum = visit.T_lpm_place.x() + visit.T_lpm_place.y() + visit.T_lpm_place.theta();
  for (const Gateway& gateway : visit.neighbourhood.gateways) {
    sum += gateway.middle.sum() + gateway.outward_bearing_rad + gateway.width_m;
  }
  return std::isfinite(sum);
}

bool names_a_gateway(int gateway, std::size_t count) {
  return gateway >= -1 && gateway < static_cast<int>(count);
}

}  // namespace

std::vector<std::uint8_t> to_row(const Visit& visit) {
  const PlaceVisit& perceived = visit.perceived;
  cairn_journal::visit_record_t record{};
  record.anchor_scan = static_cast<std::int64_t>(visit.anchor_scan);
  record.entered_utime = utime_of(perceived.entered);
  record.left_utime = utime_of(perceived.left);
  put(perceived.T_lpm_place, record.T_lpm_place_m_rad);
  record.arrival_gateway = perceived.arrival_gateway;
  record.departure_gateway = perceived.departure_gateway;
  put(perceived.T_place_robot_at_entry, record.T_place_entry_m_rad);
  put(perceived.T_place_robot_at_exit, record.T_place_exit_m_rad);
  put(perceived.neighbourhood, &record);
  put(perceived.lpm, &record.lpm);
  return wire::to_document(record);
}

Result<Visit> visit_of_row(const std::vector<std::uint8_t>& row) {
  const auto record = wire::from_document<cairn_journal::visit_record_t>(row, kMaxRowBytes);
  if (!record) {
    return malformed(record.error());
  }
  Result<OccupancyGrid> lpm = grid_of(record->lpm);
  if (!lpm) {
    return lpm.error();
  }
  Result<PlaceNeighbourhood> neighbourhood = neighbourhood_of(*record);
  if (!neighbourhood) {
    return neighbourhood.error();
  }
  Visit visit;
  visit.anchor_scan = static_cast<std::size_t>(record->anchor_scan);
  PlaceVisit& perceived = visit.perceived;
  perceived.entered = time_of_utime(record->entered_utime);
  perceived.left = time_of_utime(record->left_utime);
  perceived.T_lpm_place = pose_of(record->T_lpm_place_m_rad);
  perceived.arrival_gateway = record->arrival_gateway;
  perceived.departure_gateway = record->departure_gateway;
  perceived.T_place_robot_at_entry = pose_of(record->T_place_entry_m_rad);
  perceived.T_place_robot_at_exit = pose_of(record->T_place_exit_m_rad);
  perceived.neighbourhood = *std::move(neighbourhood);
  perceived.lpm = *std::move(lpm);
  const std::size_t gateways = perceived.neighbourhood.gateways.size();
  if (record->anchor_scan < 0 || gateways == 0 || !is_finite(perceived) ||
      !names_a_gateway(perceived.arrival_gateway, gateways) ||
      !names_a_gateway(perceived.departure_gateway, gateways)) {
    return malformed("a visit with a missing gateway or scan, or a number that is none");
  }
  return visit;
}

}  // namespace cairn
