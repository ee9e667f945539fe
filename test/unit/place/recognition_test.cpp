#include "place/recognition.hpp"

#include <cmath>
#include <numbers>

#include <gmock/gmock.h>

namespace cairn {
namespace {

using ::testing::ElementsAre;

constexpr double kEast = 0.0;
constexpr double kSouth = -std::numbers::pi / 2;
constexpr double kWest = std::numbers::pi;
constexpr double kNorth = std::numbers::pi / 2;

/// So far out of a place's centre, in that direction.
Gateway gateway(double bearing_rad, double away_m = 1.5) {
  Gateway gateway;
  gateway.middle = away_m * Vector2d(std::cos(bearing_rad), std::sin(bearing_rad));
  gateway.outward_bearing_rad = bearing_rad;
  gateway.width_m = 1.0;
  return gateway;
}

TEST(PairedGateways, OthersFollowClockwiseWhereBothVisitsSawAll) {
  const std::vector<Gateway> known{gateway(kEast), gateway(kSouth), gateway(kWest)};
  // Seen in a frame turned by half a turn, so that counting starts elsewhere.
  const std::vector<Gateway> visit{gateway(kEast), gateway(kWest), gateway(kNorth)};
  EXPECT_THAT(paired_gateways(known, visit, {0, 1}),
              ElementsAre(GatewayPair{2, 0}, GatewayPair{0, 1}, GatewayPair{1, 2}));
}

TEST(PairedGateways, AsManyGatewaysAreNotTheSameWhereTheyLeadElsewhere) {
  // One saw the door to the north and not that to the south, the other the other way around.
  const std::vector<Gateway> known{gateway(kWest), gateway(kNorth), gateway(kEast)};
  const std::vector<Gateway> visit{gateway(kWest), gateway(kEast), gateway(kSouth)};
  EXPECT_THAT(paired_gateways(known, visit, {0, 0}),
              ElementsAre(GatewayPair{0, 0}, GatewayPair{2, 1}));
}

TEST(PairedGateways, WhereOneWasMissedTheOthersAreFoundByWhereTheyLead) {
  const std::vector<Gateway> known{gateway(kEast), gateway(kSouth), gateway(kWest),
                                   gateway(kNorth)};
  const std::vector<Gateway> visit{gateway(kEast), gateway(kWest), gateway(kNorth)};
  EXPECT_THAT(paired_gateways(known, visit, {0, 0}),
              ElementsAre(GatewayPair{0, 0}, GatewayPair{2, 1}, GatewayPair{3, 2}));
}

TEST(PairedGateways, AGatewayReadFartherOutIsTheSame) {
  const std::vector<Gateway> known{gateway(kEast), gateway(kSouth), gateway(kWest)};
  const std::vector<Gateway> visit{gateway(kEast), gateway(kWest, 3.5)};
  EXPECT_THAT(paired_gateways(known, visit, {0, 0}),
              ElementsAre(GatewayPair{0, 0}, GatewayPair{2, 1}));
}

TEST(PairedGateways, OneFarAwayIsAnother) {
  const std::vector<Gateway> known{gateway(kEast), gateway(kSouth), gateway(kWest)};
  const std::vector<Gateway> visit{gateway(kEast), gateway(kWest, 6.0)};
  EXPECT_THAT(paired_gateways(known, visit, {0, 0}), ElementsAre(GatewayPair{0, 0}));
}

}  // namespace
}  // namespace cairn
