#include "runtime/event_book.hpp"

#include <gmock/gmock.h>

namespace cairn {
namespace {

using ::testing::IsEmpty;
using ::testing::SizeIs;
using Kind = cairn_lcm::place_event_t;

PlaceEvent entered() {
  PlaceEvent event;
  event.kind = PlaceEventKind::kEntered;
  return event;
}

MapState map_of(std::vector<int> place_of_visit, int closures) {
  MapState state;
  state.hypothesis = 1;
  state.visit_count = static_cast<std::int64_t>(place_of_visit.size());
  state.place_of_visit = std::move(place_of_visit);
  state.closure_count = closures;
  return state;
}

TEST(EventBook, NumbersWithoutGapsAndGivesTheMissedOnesAgain) {
  EventBook book(7);
  for (int i = 0; i < 5; ++i) {
    EXPECT_EQ(book.note(entered(), nullptr).front().event_number, i + 1);
  }
  EXPECT_THAT(book.after(3), SizeIs(2));
  EXPECT_EQ(book.after(3).front().event_number, 4);
  EXPECT_THAT(book.after(0), SizeIs(5));
}

TEST(EventBook, KeepsABoundedNumber) {
  EventBook book(7);
  for (std::size_t i = 0; i < EventBook::kKept + 10; ++i) {
    static_cast<void>(book.note(entered(), nullptr));
  }
  EXPECT_THAT(book.after(0), SizeIs(EventBook::kKept));
}

TEST(EventBook, TellsAClosedLoop) {
  EventBook book(7);
  const auto events = book.note(map_of({0, 1, 2}, 0), map_of({0, 1, 2, 0}, 1));
  ASSERT_THAT(events, SizeIs(1));
  EXPECT_EQ(events.front().kind, Kind::LOOP_CLOSED);
  EXPECT_EQ(events.front().visit_id, 3);
}

TEST(EventBook, TellsAClosureThatWasUndone) {
  EventBook book(7);
  const auto events = book.note(map_of({0, 1, 0}, 1), map_of({0, 1, 2, 3}, 0));
  ASSERT_THAT(events, SizeIs(1));
  EXPECT_EQ(events.front().kind, Kind::CLOSURE_UNDONE);
  EXPECT_EQ(events.front().visit_id, 2);
}

TEST(EventBook, SaysNothingWhileTheMapOnlyGrows) {
  EventBook book(7);
  EXPECT_THAT(book.note(map_of({0, 1}, 0), map_of({0, 1, 2}, 0)), SizeIs(0));
}

TEST(EventBook, TellsOnceThatTheRobotIsLostAndOnceThatItIsFound) {
  EventBook book(1);
  LocalisationHealth well;
  well.state = LocalisationState::kTracking;
  LocalisationHealth lost = well;
  lost.state = LocalisationState::kLost;
  lost.times_lost = 1;
  LocalisationHealth found = lost;
  found.state = LocalisationState::kDegraded;
  EXPECT_THAT(book.note(well, well, {}), IsEmpty());
  const auto told = book.note(well, lost, {TimePoint(), "the scans do not fit"});
  ASSERT_EQ(told.size(), 1U);
  EXPECT_EQ(told.front().kind_name, "LOST");
  EXPECT_EQ(told.front().reason, "the scans do not fit");
  EXPECT_THAT(book.note(lost, lost, {}), IsEmpty());
  ASSERT_EQ(book.note(lost, found, {}).size(), 1U);
  EXPECT_EQ(book.after(1).front().kind_name, "LOCALIZED");
}

TEST(EventBook, TellsARelocalisationWithItsPlace) {
  EventBook book(1);
  Relocalisation found;
  found.place = 3;
  const auto told = book.note(found);
  ASSERT_EQ(told.size(), 1U);
  EXPECT_EQ(told.front().kind_name, "LOCALIZED");
  EXPECT_EQ(told.front().place_id, 3);
}

}  // namespace
}  // namespace cairn
