#include "topology/reading.hpp"

#include <cmath>
#include <limits>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/stars.hpp"
#include "topology/experience.hpp"

namespace cairn::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

/// A tee entered by gateway 0 that may be a corridor (no stem) or a crossing (one gateway more).
View uncertain_tee() {
  View view{tee(), 0, VisitId{0}};
  view.log_likelihood = -0.5;
  view.others.push_back({corridor(), {0, 2}, -1.0});
  view.others.push_back({crossing(), {2, -1, 0, 1}, -2.0});
  return view;
}

std::string complaint(const View& view) {
  const Status status = validate(view);
  return status ? "none" : status.error().message;
}

/// A place where every gateway's fragment ends.
Star stubs(std::size_t gateways) {
  Star star;
  for (std::size_t gateway = 0; gateway < gateways; ++gateway) {
    star.slots.push_back({static_cast<int>(gateway), 2 * gateway + 1, ControlLaw::kMidline});
    star.slots.push_back({-1, 2 * gateway, ControlLaw::kDeadEnd});
  }
  return star;
}

TEST(Reading, IsToldOfAViewByNumberTheFirstOneBeingTheViewsOwn) {
  const View view = uncertain_tee();
  ASSERT_EQ(reading_count(view), 3);
  EXPECT_EQ(star_of(view, 0), tee());
  EXPECT_EQ(star_of(view, 2), crossing());
  EXPECT_EQ(arrival_gateway_of(view, 0), 0);
  EXPECT_EQ(arrival_gateway_of(view, 1), 0);
  EXPECT_EQ(arrival_gateway_of(view, 2), 2);
  EXPECT_EQ(log_likelihood_of(view, 0), -0.5);
  EXPECT_EQ(log_likelihood_of(view, 2), -2.0);
}

TEST(Reading, LacksGatewaysOfTheFirstOne) {
  const View view = uncertain_tee();
  EXPECT_EQ(gateway_in(view.others[0], 2), 1);
  EXPECT_EQ(gateway_in(view.others[0], 1), std::nullopt);
  EXPECT_EQ(gateway_in(view.others[1], -1), std::nullopt);
}

TEST(Reading, OfAViewMayDifferInGatewaysFromTheFirst) {
  EXPECT_EQ(complaint(uncertain_tee()), "none");
}

TEST(Reading, MustHaveTheArrivalGateway) {
  View view = uncertain_tee();
  view.arrival_gateway = 1;
  EXPECT_THAT(complaint(view),
              AllOf(StartsWith("view: others[0]: gateways"), HasSubstr("arrival gateway 1")));
}

TEST(Reading, MustNameGatewaysOfTheFirstOneClockwiseAndOnce) {
  View view = uncertain_tee();
  view.others[1].gateways = {0, -1, 2, 1};
  EXPECT_THAT(complaint(view), AllOf(HasSubstr("others[1]"), HasSubstr("clockwise, are 0 -1 2 1")));
  view.others[1].gateways = {0, -1, 0, 1};
  EXPECT_THAT(complaint(view), HasSubstr("are 0 -1 0 1"));
  view.others[1].gateways = {0, 1, 2, 3};
  EXPECT_THAT(complaint(view), HasSubstr("gateways[3] must be in [-1, 2], is 3"));
  view.others[1].gateways = {0, 1, 2, -2};
  EXPECT_THAT(complaint(view), HasSubstr("gateways[3] must be in [-1, 2], is -2"));
  view.others[1].gateways = {0, 1, 2};
  EXPECT_THAT(complaint(view), HasSubstr("must have 4 entries, has 3"));
  view.others[1].gateways = {-1, -1, 0, -1};
  EXPECT_EQ(complaint(view), "none");
}

TEST(Reading, MustHaveAFiniteLogLikelihoodOfAtMostZero) {
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double wrong : {0.1, infinity, -infinity, std::nan("")}) {
    View view = uncertain_tee();
    view.others[0].log_likelihood = wrong;
    EXPECT_THAT(complaint(view), HasSubstr("others[0]: log_likelihood must be finite"));
    view = uncertain_tee();
    view.log_likelihood = wrong;
    EXPECT_THAT(complaint(view), StartsWith("view: log_likelihood must be finite"));
  }
}

TEST(Reading, MustBeOfAValidStarOfFewGateways) {
  View view = uncertain_tee();
  view.others[0].star.slots[0].partner = 7;
  EXPECT_THAT(complaint(view), HasSubstr("others[0]: star: slot 0"));
  EXPECT_EQ(complaint({stubs(64), 63, VisitId{0}}), "none");
  EXPECT_THAT(complaint({stubs(65), 0, VisitId{0}}), HasSubstr("at most 128 slots, has 130"));
  Star loops;
  for (std::size_t slot = 0; slot < 66; ++slot) {
    loops.slots.push_back({static_cast<int>(slot), slot ^ 1U, ControlLaw::kMidline});
  }
  EXPECT_THAT(complaint({loops, 0, VisitId{0}}), HasSubstr("at most 64 gateways, has 66"));
}

TEST(Reading, MayHaveSevenOthersBesideIt) {
  View view{corridor(), 0, VisitId{0}};
  view.others.assign(7, Reading{corridor(), {0, 1}, -1.0});
  EXPECT_EQ(complaint(view), "none");
  view.others.push_back(view.others.front());
  EXPECT_THAT(complaint(view), HasSubstr("at most 8 readings, has 9"));
}

}  // namespace
}  // namespace cairn::test
