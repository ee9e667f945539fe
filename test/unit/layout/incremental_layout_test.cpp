#include "layout/incremental_layout.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include <gmock/gmock.h>

#include "support/simulated_tour.hpp"

namespace cairn {
namespace {

using ::testing::HasSubstr;

Matrix3d diagonal(double x, double y, double theta) {
  return Eigen::Vector3d(x * x, y * y, theta * theta).asDiagonal();
}

TravelConstraint travel(int from, int to, double x, double y, double theta) {
  return {from, to, {Pose2(x, y, theta), diagonal(0.1, 0.1, 0.02)}};
}

/// Adds a travel, to a new place where it leads to one.
Status add(const TravelConstraint& travel, IncrementalLayout* layout) {
  return std::max(travel.from, travel.to) == layout->place_count() ? layout->add_place(travel)
                                                                   : layout->add_travel(travel);
}

IncrementalLayout layout_of(const std::vector<TravelConstraint>& travels) {
  IncrementalLayout layout;
  for (const TravelConstraint& travel : travels) {
    EXPECT_TRUE(add(travel, &layout));
  }
  return layout;
}

void expect_near(const Pose2& a, const Pose2& b, double tolerance) {
  EXPECT_NEAR(a.x(), b.x(), tolerance);
  EXPECT_NEAR(a.y(), b.y(), tolerance);
  EXPECT_NEAR(turn_between(a.theta(), b.theta()), 0.0, tolerance);
}

/// As good as all at once: never worse than by rounding and a millionth.
void expect_as_good_as_batch(const IncrementalLayout& layout) {
  const Result<PlaceLayout> batch = solve_layout(layout.place_count(), layout.travels());
  ASSERT_TRUE(batch) << batch.error().message;
  EXPECT_NEAR(layout.chi2(), batch->chi2, 1e-6 * (1.0 + batch->chi2));
}

TEST(IncrementalLayout, BeginsWithPlace0AtTheOrigin) {
  const IncrementalLayout layout;
  EXPECT_EQ(layout.place_count(), 1);
  EXPECT_EQ(layout.T_global_place(0), Pose2());
  EXPECT_EQ(layout.chi2(), 0.0);
}

TEST(IncrementalLayout, ANewPlaceIsWhereItsTravelPutsIt) {
  const IncrementalLayout layout = layout_of(
      {travel(0, 1, 2.0, 1.0, 0.5), travel(1, 2, 1.0, 0.0, 0.0), travel(3, 2, 0.5, 0.2, -1.0)});
  const Pose2 T_global_1(2.0, 1.0, 0.5);
  const Pose2 T_global_2 = T_global_1 * Pose2(1.0, 0.0, 0.0);
  expect_near(layout.T_global_place(1), T_global_1, 1e-12);
  expect_near(layout.T_global_place(2), T_global_2, 1e-12);
  expect_near(layout.T_global_place(3), T_global_2 * Pose2(0.5, 0.2, -1.0).inverse(), 1e-12);
  EXPECT_EQ(layout.eliminated_count(), 0);
}

TEST(IncrementalLayout, ANewPlaceMovesNoOther) {
  const test::SimulatedTour tour = test::simulated_tour({50, 1, 10.0, 0.5, 0.1, 0.02});
  IncrementalLayout layout = layout_of(tour.travels);
  const std::vector<Pose2> before = layout.T_global_place();
  ASSERT_TRUE(layout.add_place(travel(17, 50, 3.0, 0.0, 0.0)));
  ASSERT_TRUE(layout.add_place(travel(50, 51, 3.0, 0.0, 0.0)));
  for (int place = 0; place < 50; ++place) {
    EXPECT_EQ(layout.T_global_place(place), before[static_cast<std::size_t>(place)]);
  }
}

TEST(IncrementalLayout, IsAsGoodAsAllAtOnceAfterEveryClosure) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    const test::SimulatedTour tour = test::simulated_tour({40, seed, 10.0, 0.5, 0.1, 0.02});
    IncrementalLayout layout;
    for (const TravelConstraint& travel : tour.travels) {
      const bool is_new = std::max(travel.from, travel.to) == layout.place_count();
      ASSERT_TRUE(add(travel, &layout));
      if (!is_new) {
        expect_as_good_as_batch(layout);
      }
    }
  }
}

// Travels of which some are a hundred times surer than others, and turn by anything.
TEST(IncrementalLayout, IsAsGoodAsAllAtOnceWhateverTheUncertainties) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    test::SimulatedTour tour = test::simulated_tour({40, seed, 1.0, 0.3, 0.0, 0.0});
    IncrementalLayout layout;
    for (TravelConstraint& travel : tour.travels) {
      const double sigma_m = std::pow(10.0, -1.0 - 2.0 * static_cast<double>(random() % 2));
      Pose2& mean = travel.T_from_to.mean;
      mean = Pose2(mean.x() + sigma_m * normal(random), mean.y() + sigma_m * normal(random),
                   mean.theta() + 0.2 * sigma_m * normal(random));
      travel.T_from_to.covariance = diagonal(sigma_m, sigma_m, 0.2 * sigma_m);
      const bool is_new = std::max(travel.from, travel.to) == layout.place_count();
      ASSERT_TRUE(add(travel, &layout));
      if (!is_new) {
        expect_as_good_as_batch(layout);
      }
    }
  }
}

TEST(IncrementalLayout, ALargeLoopThatClosesBadlyIsAsGoodAsAllAtOnce) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    IncrementalLayout layout;
    for (int place = 1; place < 300; ++place) {
      ASSERT_TRUE(layout.add_place(travel(place - 1, place, 1.0 + 0.1 * normal(random),
                                          0.1 * normal(random),
                                          2.0 * kPi / 300.0 + 0.02 * normal(random))));
    }
    ASSERT_TRUE(layout.add_travel(travel(299, 0, 1.0, 0.0, 2.0 * kPi / 300.0)));
    expect_as_good_as_batch(layout);
    ASSERT_TRUE(layout.add_travel(travel(150, 0, 0.0, 95.0, kPi)));
    expect_as_good_as_batch(layout);
  }
}

// Hypotheses are laid out though they are wrong: a closure may contradict everything.
TEST(IncrementalLayout, UnderFalseClosuresIsNeverWorseThanAllAtOnce) {
  for (unsigned seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const test::SimulatedTour tour = test::simulated_tour({40, seed, 3.0, 0.5, 0.1, 0.02});
    IncrementalLayout layout = layout_of(tour.travels);
    for (int i = 0; i < 3; ++i) {
      const int from = static_cast<int>(random() % 40);
      const int to = (from + 1 + static_cast<int>(random() % 39)) % 40;
      ASSERT_TRUE(layout.add_travel(
          travel(from, to, 1.0, 0.0, 0.001 * static_cast<double>(random() % 6000))));
      const Result<PlaceLayout> batch = solve_layout(layout.place_count(), layout.travels());
      if (batch) {
        EXPECT_LE(layout.chi2(), (1.0 + 1e-6) * batch->chi2 + 1e-6);
      }
    }
  }
}

TEST(IncrementalLayout, PlacesThatHangOnOthersGoWithThem) {
  IncrementalLayout layout = layout_of({travel(0, 1, 2.0, 0.0, 0.0), travel(1, 2, 0.0, 2.0, 0.0),
                                        travel(2, 3, 0.0, 1.0, 1.0), travel(4, 3, 1.0, 0.0, 0.3)});
  ASSERT_TRUE(layout.add_travel(travel(0, 2, 2.4, 2.2, 0.1)));
  expect_near(layout.T_global_place(3), layout.T_global_place(2) * Pose2(0.0, 1.0, 1.0), 1e-9);
  expect_near(layout.T_global_place(4), layout.T_global_place(3) * Pose2(1.0, 0.0, 0.3).inverse(),
              1e-9);
  expect_as_good_as_batch(layout);
}

TEST(IncrementalLayout, LoopsThatMeetInPlace0AloneDoNotConcernEachOther) {
  IncrementalLayout layout = layout_of(
      {travel(0, 1, 2.0, 0.0, 0.0), travel(1, 2, 0.0, 2.0, 0.0), travel(2, 0, -2.1, -2.1, 0.1)});
  const Pose2 before = layout.T_global_place(2);
  for (const TravelConstraint& next :
       {travel(0, 3, -2.0, 0.0, 0.0), travel(3, 4, 0.0, -2.0, 0.0), travel(4, 0, 2.2, 2.1, 0.1)}) {
    ASSERT_TRUE(add(next, &layout));
  }
  EXPECT_EQ(layout.T_global_place(2), before);
  expect_as_good_as_batch(layout);
}

TEST(IncrementalLayout, ALoopPathCountsButMovesNothing) {
  IncrementalLayout layout = layout_of({travel(0, 1, 2.0, 0.0, 0.0)});
  ASSERT_TRUE(layout.add_travel(travel(1, 1, 0.1, 0.0, 0.0)));
  EXPECT_NEAR(layout.chi2(), 1.0, 1e-12);
  expect_near(layout.T_global_place(1), Pose2(2.0, 0.0, 0.0), 1e-12);
}

TEST(IncrementalLayout, TravelsOfTheSameWayAllCount) {
  IncrementalLayout layout = layout_of({travel(0, 1, 1.0, 0.0, 0.0)});
  ASSERT_TRUE(layout.add_travel(travel(0, 1, 2.0, 0.0, 0.0)));
  ASSERT_TRUE(layout.add_travel(travel(1, 0, -3.0, 0.0, 0.0)));
  EXPECT_NEAR(layout.T_global_place(1).x(), 2.0, 1e-6);
}

TEST(IncrementalLayout, IsTheSameBitForBitForTheSameTravels) {
  const test::SimulatedTour tour = test::simulated_tour({200, 3, 10.0, 0.5, 0.1, 0.02});
  EXPECT_EQ(layout_of(tour.travels).T_global_place(), layout_of(tour.travels).T_global_place());
}

TEST(IncrementalLayout, CopiesGoOnOnTheirOwn) {
  const test::SimulatedTour tour = test::simulated_tour({60, 4, 10.0, 0.5, 0.1, 0.02});
  IncrementalLayout one = layout_of(tour.travels);
  IncrementalLayout other = one;
  const std::vector<Pose2> before = one.T_global_place();
  const TravelConstraint right = travel(3, 40, 5.0, 5.0, 0.0);
  ASSERT_TRUE(other.add_travel(travel(10, 50, 5.0, 5.0, 0.0)));
  EXPECT_EQ(one.T_global_place(), before);
  ASSERT_TRUE(one.add_travel(right));
  IncrementalLayout alone = layout_of(tour.travels);
  ASSERT_TRUE(alone.add_travel(right));
  EXPECT_EQ(one.T_global_place(), alone.T_global_place());
  EXPECT_NE(one.T_global_place(), other.T_global_place());
}

TEST(IncrementalLayout, DoesWorkForWhatChangesOnly) {
  test::SimulatedTour tour = test::simulated_tour({2000, 5, 10.0, 0.7, 0.02, 0.001});
  IncrementalLayout layout = layout_of(tour.travels);
  const std::int64_t before = layout.eliminated_count();
  const Pose2 T_last_known = layout.T_global_place(1999).inverse() * layout.T_global_place(1998);
  ASSERT_TRUE(layout.add_travel({1999, 1998, {T_last_known, diagonal(0.1, 0.1, 0.02)}}));
  EXPECT_LT(layout.eliminated_count() - before, 300);
}

TEST(IncrementalLayout, ALongChainCanBeClosed) {
  constexpr int kPlaces = 20'000;
  IncrementalLayout layout;
  for (int place = 1; place < kPlaces; ++place) {
    ASSERT_TRUE(layout.add_place(travel(place - 1, place, 1.0, 0.0, 2.0 * kPi / kPlaces)));
  }
  ASSERT_TRUE(layout.add_travel(travel(kPlaces - 1, 0, 1.0, 0.0, 2.0 * kPi / kPlaces)));
  EXPECT_LT(layout.chi2(), 1e-3);
}

// Uncertainties and ways as far apart as they are let in: whatever cannot be laid out is not added.
TEST(IncrementalLayout, WhatCannotBeLaidOutLeavesAllAsItWas) {
  int refused = 0;
  for (unsigned seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const auto power = [&] { return std::pow(10.0, static_cast<double>(random() % 13) - 6.0); };
    IncrementalLayout layout;
    for (int i = 0; i < 30; ++i) {
      const bool is_new = layout.place_count() < 3 || random() % 2 == 0;
      const int to = is_new
                         ? layout.place_count()
                         : static_cast<int>(random() % static_cast<unsigned>(layout.place_count()));
      const int from = static_cast<int>(random() % static_cast<unsigned>(layout.place_count()));
      const std::vector<Pose2> before = layout.T_global_place();
      const std::size_t travels_before = layout.travels().size();
      const Status added =
          add({from, to, {Pose2(power(), -power(), power()), diagonal(power(), power(), power())}},
              &layout);
      for (const Pose2& pose : layout.T_global_place()) {
        ASSERT_TRUE(std::isfinite(pose.x() + pose.y() + pose.theta()));
      }
      if (!added) {
        ++refused;
        EXPECT_EQ(layout.T_global_place(), before);
        EXPECT_EQ(layout.travels().size(), travels_before);
      }
    }
  }
  EXPECT_GT(refused, 0);
}

TEST(IncrementalLayout, RefusesWhatJoinsNoKnownPlaceAndAddsNothing) {
  IncrementalLayout layout = layout_of({travel(0, 1, 1.0, 0.0, 0.0)});
  const Status unknown = layout.add_travel(travel(0, 2, 1.0, 0.0, 0.0));
  ASSERT_FALSE(unknown);
  EXPECT_EQ(unknown.error().code, ErrorCode::kInvalidValue);
  EXPECT_THAT(unknown.error().message, HasSubstr("travel 1 must join places in [0, 2)"));
  EXPECT_FALSE(layout.add_place(travel(0, 1, 1.0, 0.0, 0.0)));
  EXPECT_FALSE(layout.add_place(travel(2, 2, 1.0, 0.0, 0.0)));
  EXPECT_FALSE(layout.add_place(travel(-1, 2, 1.0, 0.0, 0.0)));
  EXPECT_FALSE(layout.add_place(travel(0, 3, 1.0, 0.0, 0.0)));
  TravelConstraint unsound = travel(0, 1, 1.0, 0.0, 0.0);
  unsound.T_from_to.covariance(0, 0) = -1.0;
  EXPECT_FALSE(layout.add_travel(unsound));
  unsound = travel(0, 2, NAN, 0.0, 0.0);
  EXPECT_FALSE(layout.add_place(unsound));
  EXPECT_EQ(layout.place_count(), 2);
  EXPECT_EQ(layout.travels().size(), 1U);
}

}  // namespace
}  // namespace cairn
