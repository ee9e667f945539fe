// Counts every allocation of this program.

#include <atomic>
#include <cstdlib>
#include <new>

#include <gmock/gmock.h>

#include "lpm/local_mapper.hpp"
#include "simulated_laser.hpp"

namespace {

std::atomic<long> allocations{0};

void* counted(std::size_t size) {
  ++allocations;
  void* const memory = std::malloc(size);  // NOLINT: this is the allocator
  if (memory == nullptr) {
    throw std::bad_alloc();
  }
  return memory;
}

}  // namespace

void* operator new(std::size_t size) {
  return counted(size);
}
void* operator new[](std::size_t size) {
  return counted(size);
}
void operator delete(void* memory) noexcept {
  std::free(memory);  // NOLINT
}
void operator delete[](void* memory) noexcept {
  std::free(memory);  // NOLINT
}
void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);  // NOLINT
}
void operator delete[](void* memory, std::size_t) noexcept {
  std::free(memory);  // NOLINT
}

namespace cairn {
namespace {

Pose2 to_and_fro(int step) {
  const double along = 0.05 * step;
  return {2.0 * std::sin(along), 0.3 * std::sin(2.0 * along), 0.2 * std::sin(3.0 * along)};
}

TEST(LocalMapper, AllocatesNothingPerScanOnceItIsWarm) {
  LocalMapper mapper;
  test::SimulatedLaser laser(test::furnished_room());
  std::vector<JoinedScan> scans;
  for (int i = 0; i < 600; ++i) {
    scans.push_back({laser.scan(to_and_fro(i), 0.2 * i), to_and_fro(i)});
  }
  for (std::size_t i = 0; i < 300; ++i) {
    mapper.absorb(scans[i]);
  }
  const long before = allocations;
  for (std::size_t i = 300; i < scans.size(); ++i) {
    mapper.absorb(scans[i]);
  }
  EXPECT_EQ(allocations - before, 0);
}

}  // namespace
}  // namespace cairn
