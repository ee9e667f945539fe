#include "runtime/bounded_queue.hpp"

#include <thread>

#include <gmock/gmock.h>

namespace cairn {
namespace {

TEST(BoundedQueue, MakesRoomByDroppingTheOldestAndCountsIt) {
  BoundedQueue<int> queue(2);
  for (int i = 0; i < 5; ++i) {
    queue.push(i);
  }
  EXPECT_EQ(queue.dropped(), 3);
  EXPECT_EQ(queue.pop(), 3);
  EXPECT_EQ(queue.pop(), 4);
  EXPECT_EQ(queue.try_pop(), std::nullopt);
}

TEST(BoundedQueue, GivesWhatWaitsAfterItWasClosedAndThenEnds) {
  BoundedQueue<int> queue(2);
  queue.push(1);
  queue.close();
  queue.push(2);
  EXPECT_EQ(queue.pop(), 1);
  EXPECT_EQ(queue.pop(), std::nullopt);
}

TEST(BoundedQueue, CarriesEverythingFromOneThreadToAnother) {
  BoundedQueue<int> queue(100'000);
  std::thread producer([&queue] {
    for (int i = 0; i < 50'000; ++i) {
      queue.push(i);
    }
    queue.close();
  });
  int expected = 0;
  while (const std::optional<int> value = queue.pop()) {
    ASSERT_EQ(*value, expected++);
  }
  producer.join();
  EXPECT_EQ(expected, 50'000);
}

}  // namespace
}  // namespace cairn
