#include "wire/snapshot_assembler.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "wire/document.hpp"

namespace cairn::wire {
namespace {

using ::testing::ElementsAre;

constexpr std::int32_t kChunkBytes = 1000;

Bytes document(std::uint8_t value) {
  return Bytes(2500, value);
}

cairn_lcm::snapshot_chunk_t chunk_of(const Bytes& document,
                                     std::int64_t snapshot_id,
                                     std::int32_t number) {
  cairn_lcm::snapshot_chunk_t chunk{};
  chunk.snapshot_id = snapshot_id;
  chunk.revision = snapshot_id;
  chunk.total_bytes = static_cast<std::int32_t>(document.size());
  chunk.total_crc32 = crc32_of(document);
  chunk.num_chunks = (chunk.total_bytes + kChunkBytes - 1) / kChunkBytes;
  chunk.chunk = number;
  chunk.offset_bytes = number * kChunkBytes;
  chunk.num_bytes = std::min(kChunkBytes, chunk.total_bytes - chunk.offset_bytes);
  const auto begin = document.begin() + chunk.offset_bytes;
  chunk.data.assign(begin, begin + chunk.num_bytes);
  return chunk;
}

TEST(SnapshotAssembler, TakesChunksInAnyOrder) {
  SnapshotAssembler assembler;
  const Bytes whole = document(7);
  EXPECT_EQ(assembler.add(0, chunk_of(whole, 1, 2)), std::nullopt);
  EXPECT_EQ(assembler.add(0, chunk_of(whole, 1, 2)), std::nullopt);
  EXPECT_THAT(assembler.missing(10), ElementsAre(0, 1));
  EXPECT_EQ(assembler.add(0, chunk_of(whole, 1, 0)), std::nullopt);
  EXPECT_EQ(assembler.add(0, chunk_of(whole, 1, 1)), whole);
  EXPECT_FALSE(assembler.is_collecting());
}

TEST(SnapshotAssembler, StaysWithASnapshotThatMakesProgress) {
  SnapshotAssembler assembler;
  (void)assembler.add(0, chunk_of(document(1), 1, 0));
  (void)assembler.add(100'000, chunk_of(document(2), 2, 0));
  EXPECT_EQ(assembler.snapshot_id(), 1);
  (void)assembler.add(2'000'000, chunk_of(document(2), 2, 1));
  EXPECT_EQ(assembler.snapshot_id(), 2);
}

TEST(SnapshotAssembler, RefusesADocumentWhoseChecksumIsWrong) {
  SnapshotAssembler assembler;
  const Bytes whole = document(7);
  (void)assembler.add(0, chunk_of(whole, 1, 0));
  (void)assembler.add(0, chunk_of(whole, 1, 1));
  auto forged = chunk_of(whole, 1, 2);
  forged.data[0] ^= 1;
  EXPECT_EQ(assembler.add(0, forged), std::nullopt);
  EXPECT_FALSE(assembler.is_collecting());
}

TEST(SnapshotAssembler, IgnoresChunksThatContradictThemselves) {
  const auto sound = chunk_of(document(7), 1, 1);
  const auto is_ignored = [&sound](auto change) {
    auto chunk = sound;
    change(chunk);
    SnapshotAssembler assembler;
    (void)assembler.add(0, chunk);
    return !assembler.is_collecting();
  };
  EXPECT_FALSE(is_ignored([](auto&) {}));
  EXPECT_TRUE(is_ignored([](auto& chunk) { chunk.chunk = 3; }));
  EXPECT_TRUE(is_ignored([](auto& chunk) { chunk.chunk = -1; }));
  EXPECT_TRUE(is_ignored([](auto& chunk) { chunk.num_chunks = 0; }));
  EXPECT_TRUE(is_ignored([](auto& chunk) { chunk.num_chunks = 2'000'000'000; }));
  EXPECT_TRUE(is_ignored([](auto& chunk) { chunk.total_bytes = 0; }));
  EXPECT_TRUE(is_ignored([](auto& chunk) { chunk.total_bytes = 2'147'483'647; }));
  EXPECT_TRUE(is_ignored([](auto& chunk) { chunk.offset_bytes = 2'147'483'647; }));
  EXPECT_TRUE(is_ignored([](auto& chunk) { chunk.offset_bytes = -1; }));
  EXPECT_TRUE(is_ignored([](auto& chunk) { chunk.snapshot_id = 0; }));
}

}  // namespace
}  // namespace cairn::wire
