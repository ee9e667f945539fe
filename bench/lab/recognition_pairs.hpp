#pragma once

#include <cstdint>
#include <vector>

#include "bench/lab/building_drive.hpp"
#include "lpm/map_matching.hpp"
#include "place/place_detector.hpp"
#include "place/recognition.hpp"

namespace cairn::lab {

/// As drive_building(), without the visits to what is no junction.
[[nodiscard]] std::vector<SimulatedVisit> visits_at_junctions(const Building& building,
                                                              std::uint64_t seed,
                                                              int session,
                                                              int travels);

/// Two visits under one alignment of their gateways, and what matching their maps says.
struct JudgedPair {
  std::uint64_t seed = 0;         ///< Of the building.
  bool is_same = false;           ///< The same junction, gateways on the true ones.
  bool is_same_junction = false;  ///< Perhaps turned.
  bool is_other_session = false;
  bool repeats_itself = false;  ///< The building does.
  MapMatch match;
  double chi2 = 0.0;  ///< Of the alignment found, about the true one. Of the same only.
};

/// All pairs of visits under all alignments that the service would ask about: where the later
/// visit, entered by its gateway of arrival, looks like the earlier one entered by some gateway, a
/// misread star allowed.
[[nodiscard]] std::vector<JudgedPair> judged_pairs(const std::vector<SimulatedVisit>& visits,
                                                   const MapMatchOptions& options);

/// Two sessions in each of so many buildings, from this seed on.
[[nodiscard]] std::vector<JudgedPair> judged_buildings(std::uint64_t first_seed, int count);

}  // namespace cairn::lab
