#include "layout/shared_layouts.hpp"

#include <random>

#include <gmock/gmock.h>

#include "support/simulated_tour.hpp"

namespace cairn {
namespace {

using Travels = std::vector<TravelConstraint>;

TravelConstraint travel(int from, int to, double x, double y, double theta) {
  return {from, to, {Pose2(x, y, theta), Eigen::Vector3d(0.01, 0.01, 0.0004).asDiagonal()}};
}

Travels first(const Travels& travels, std::size_t count) {
  return {travels.begin(), travels.begin() + static_cast<std::ptrdiff_t>(count)};
}

int place_count(const Travels& travels) {
  int last = 0;
  for (const TravelConstraint& one : travels) {
    last = std::max({last, one.from, one.to});
  }
  return last + 1;
}

void expect_as_solved_at_once(const Result<LaidPlaces>& laid, const Travels& travels) {
  const Result<PlaceLayout> batch = solve_layout(place_count(travels), travels);
  ASSERT_TRUE(batch);
  ASSERT_TRUE(laid) << laid.error().message;
  EXPECT_NEAR(laid->chi2, batch->chi2, 1e-6 * (1.0 + batch->chi2));
  ASSERT_EQ(laid->T_global_place.size(), batch->T_global_place.size());
  for (std::size_t i = 0; i < batch->T_global_place.size(); ++i) {
    EXPECT_LT(
        (laid->T_global_place[i].translation() - batch->T_global_place[i].translation()).norm(),
        1e-3);
  }
}

TEST(SharedLayouts, AreAsGoodAsMapsSolvedAtOnce) {
  const Travels travels = test::simulated_tour({60, 3, 10.0, 0.5, 0.1, 0.02}).travels;
  SharedLayouts layouts({});
  for (std::size_t count = 1; count <= travels.size(); ++count) {
    const Travels known = first(travels, count);
    expect_as_solved_at_once(layouts.lay_out(place_count(known), known), known);
  }
  EXPECT_EQ(layouts.solved_count(), 0);
}

TEST(SharedLayouts, AnArrivalPaysForItsOwnTravelOnlyInEveryHypothesis) {
  const Travels travels = test::simulated_tour({60, 3, 10.0, 0.5, 0.1, 0.02}).travels;
  SharedLayouts layouts({});
  ASSERT_TRUE(layouts.lay_out(place_count(travels), travels));
  const std::int64_t before = layouts.added_count();
  EXPECT_EQ(before, static_cast<std::int64_t>(travels.size()));
  const int places = place_count(travels);
  for (int hypothesis = 0; hypothesis < 20; ++hypothesis) {
    Travels longer = travels;
    longer.push_back(travel(places - 1, hypothesis, 1.0, 0.0, 0.0));
    ASSERT_TRUE(layouts.lay_out(places, longer));
  }
  EXPECT_EQ(layouts.added_count() - before, 20);
}

TEST(SharedLayouts, TheAnswerDoesNotDependOnWhatIsKept) {
  const Travels travels = test::simulated_tour({60, 3, 10.0, 0.5, 0.1, 0.02}).travels;
  SharedLayouts grown({});
  SharedLayouts forgetful({}, 0);
  for (std::size_t count = 1; count <= travels.size(); ++count) {
    const Travels known = first(travels, count);
    const Result<LaidPlaces> a = grown.lay_out(place_count(known), known);
    const Result<LaidPlaces> b = forgetful.lay_out(place_count(known), known);
    ASSERT_TRUE(a && b);
    EXPECT_EQ(a->chi2, b->chi2);
    EXPECT_EQ(a->T_global_place, b->T_global_place);
  }
  EXPECT_EQ(forgetful.kept_count(), 1U);
}

TEST(SharedLayouts, WhatIsKeptIsBounded) {
  constexpr std::size_t kBytes = 200'000;
  SharedLayouts layouts({}, kBytes);
  Travels travels;
  for (int place = 0; place < 300; ++place) {
    travels.push_back(travel(place, place + 1, 3.0, 0.5, 0.1));
    ASSERT_TRUE(layouts.lay_out(place + 2, travels));
    EXPECT_LE(layouts.kept_count() * sizeof(IncrementalLayout), kBytes + sizeof(IncrementalLayout));
  }
  EXPECT_EQ(layouts.added_count(), 300);
}

TEST(SharedLayouts, PlacesThatComeOutOfOrderAreSolvedAtOnce) {
  const Travels travels = {travel(0, 2, 1.0, 0.0, 0.0), travel(2, 1, 1.0, 0.0, 0.0),
                           travel(1, 0, -2.1, 0.0, 0.0)};
  SharedLayouts layouts({});
  expect_as_solved_at_once(layouts.lay_out(3, travels), travels);
  EXPECT_EQ(layouts.solved_count(), 1);
}

TEST(SharedLayouts, APlaceThatCannotBeReachedIsAnErrorAsEver) {
  SharedLayouts layouts({});
  const Result<LaidPlaces> laid = layouts.lay_out(3, {travel(0, 1, 1.0, 0.0, 0.0)});
  ASSERT_FALSE(laid);
  EXPECT_EQ(laid.error().code, ErrorCode::kContradiction);
}

TEST(SharedLayouts, OutliersAreWeighedAsTheOptionsSay) {
  const Travels travels = test::simulated_tour({30, 3, 10.0, 0.5, 0.1, 0.02}).travels;
  LayoutOptions options;
  options.outlier_sigmas = 1.0;
  SharedLayouts layouts(options);
  const Result<LaidPlaces> laid = layouts.lay_out(place_count(travels), travels);
  const Result<PlaceLayout> batch = solve_layout(place_count(travels), travels, options);
  ASSERT_TRUE(laid && batch);
  EXPECT_EQ(laid->T_global_place, batch->T_global_place);
  EXPECT_EQ(laid->chi2, batch->chi2);
}

}  // namespace
}  // namespace cairn
