#include "clients/cairn/goal.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace cairn::clients {
namespace {

TEST(Goal, ANumberIsAPlace) {
  const auto goal = parse_goal("12");
  ASSERT_TRUE(goal);
  EXPECT_EQ(goal->goal_place, 12);
  EXPECT_EQ(goal->from_place, -1);
  EXPECT_EQ(goal->goal_name, "");
}

TEST(Place, IsANumberAVisitOrAName) {
  EXPECT_EQ(parse_place("12")->place, 12);
  EXPECT_EQ(parse_place("12")->visit, -1);
  EXPECT_EQ(parse_place("visit:7")->visit, 7);
  EXPECT_EQ(parse_place("kitchen 2")->name, "kitchen 2");
  for (const char* wrong : {"", "-3", "visit:", "visit:x", "visit:-1", "99999999999999999999"}) {
    EXPECT_FALSE(parse_place(wrong)) << wrong;
  }
}

TEST(Goal, TwoNumbersAreAPointWithAnyHeading) {
  const auto goal = parse_goal("1.5,-2");
  ASSERT_TRUE(goal);
  EXPECT_EQ(goal->goal_place, -1);
  EXPECT_EQ(goal->goal_x_m, 1.5);
  EXPECT_EQ(goal->goal_y_m, -2.0);
  EXPECT_TRUE(std::isnan(goal->goal_theta_rad));
}

TEST(Goal, AThirdNumberIsAHeadingInDegrees) {
  const auto goal = parse_goal("0,0,-270");
  ASSERT_TRUE(goal);
  EXPECT_NEAR(goal->goal_theta_rad, std::acos(0.0), 1e-12);
}

TEST(Goal, EverythingElseIsAName) {
  for (const char* name : {"kitchen", "1,2,3,4", "1,", "room 5", "3a", "a,b"}) {
    const auto goal = parse_goal(name);
    ASSERT_TRUE(goal) << name;
    EXPECT_EQ(goal->goal_name, name);
    EXPECT_EQ(goal->goal_place, -1);
  }
}

TEST(Goal, NumbersThatLeadNowhereAreRefused) {
  for (const char* text : {"", "-3", "inf,0", "0,nan", "1,2,inf"}) {
    EXPECT_FALSE(parse_goal(text)) << text;
  }
}

}  // namespace
}  // namespace cairn::clients
