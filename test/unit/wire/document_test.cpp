#include "wire/document.hpp"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/message_samples.hpp"
#include "wire/signatures.hpp"

namespace cairn::wire {
namespace {

using ::testing::HasSubstr;

TEST(Document, GivesItsMessageBack) {
  const auto topology = test::sample<cairn_lcm::topology_t>();
  const auto back = from_document<cairn_lcm::topology_t>(to_document(topology));
  ASSERT_TRUE(back.ok()) << back.error();
  EXPECT_EQ(encode(*back), encode(topology));
}

TEST(Document, LargerThanAllowedIsRefusedBeforeItIsUnpacked) {
  const Bytes document = compressed(Bytes(1'000'000));
  const auto content = decompressed(document.data(), document.size(), 999'999);
  ASSERT_FALSE(content.ok());
  EXPECT_THAT(content.error(), HasSubstr("claims 1000000 bytes"));
}

TEST(Document, ThatClaimsMoreThanItCanHoldIsRefused) {
  // Magic, then a descriptor of a single segment with eight bytes of content size: 256 MiB.
  const Bytes forged = {0x28, 0xB5, 0x2F, 0xFD, 0xE0, 0, 0, 0, 0x10, 0, 0, 0, 0, 1, 0, 0};
  EXPECT_FALSE(decompressed(forged.data(), forged.size()).ok());
}

TEST(Document, DamagedAnywhereIsRefusedOrGivesOtherBytes) {
  const Bytes sound = to_document(test::sample<cairn_lcm::grid_map_t>());
  for (std::size_t size = 0; size < sound.size(); ++size) {
    EXPECT_FALSE(decompressed(sound.data(), size).ok()) << size;
  }
  for (std::size_t i = 0; i < sound.size(); ++i) {
    for (const int bit : {0, 3, 7}) {
      Bytes bytes = sound;
      bytes[i] = static_cast<std::uint8_t>(bytes[i] ^ (1 << bit));
      const auto message = from_document<cairn_lcm::grid_map_t>(bytes);
      EXPECT_TRUE(!message.ok() || !message->tiles.empty() || message->num_tiles == 0);
    }
  }
}

TEST(Document, ChecksumIsThatOfZlib) {
  const std::string text = "123456789";
  const Bytes bytes(text.begin(), text.end());
  EXPECT_EQ(static_cast<std::uint32_t>(crc32_of(bytes)), 0xCBF43926U);
}

}  // namespace
}  // namespace cairn::wire
