// Stars that are found again, over made-up buildings: with doors half open, furniture and people
// that move. Robots of several makes, half of them with a field of view of half a turn.

#include <string>

#include <gtest/gtest.h>

#include "bench/lab/building_score.hpp"

namespace cairn::lab {
namespace {

constexpr int kBuildings = 20;
constexpr std::uint64_t kFirstSeed = 101;  // parameters were chosen on seeds below 100
constexpr int kTravels = 24;

double share(std::size_t part, std::size_t whole) {
  return static_cast<double>(part) / static_cast<double>(whole);
}

TEST(Buildings, JunctionsShowTheSameStarAtEveryVisit) {
  BuildingScore all;
  for (int i = 0; i < kBuildings; ++i) {
    const std::uint64_t seed = kFirstSeed + static_cast<std::uint64_t>(i);
    const Building building(seed);
    all += score_of(building, walk_of(building, 0, kTravels),
                    drive_building(building, seed, 0, kTravels));
  }
  ASSERT_GE(all.revisits, 100U);
  EXPECT_GE(share(all.same_star, all.revisits), 0.98);
  EXPECT_GE(share(all.gateways_found, all.gateways), 0.98);
  EXPECT_LT(share(all.gateways_false, all.gateways), 0.02);
  EXPECT_LE(share(all.false_places, all.noticed), 0.01);
  // The tour ends at a junction, of which not everything is seen.
  EXPECT_GE(share(all.noticed, all.passages - kBuildings), 0.95);
}

}  // namespace
}  // namespace cairn::lab
