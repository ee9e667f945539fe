#include "service/options.hpp"

#include <gmock/gmock.h>

namespace cairn {
namespace {

using ::testing::HasSubstr;

TEST(ServiceOptions, DefaultsAreSound) {
  EXPECT_TRUE(validate(ServiceOptions()).ok());
}

TEST(ServiceOptions, TellsTheViolationsOfAllStagesTogether) {
  ServiceOptions options;
  options.joiner.history_s = -1.0;
  options.layout.max_iterations = 0;
  const Status status = validate(options);
  ASSERT_FALSE(status.ok());
  EXPECT_THAT(status.error().message, HasSubstr("joiner.history_s"));
  EXPECT_THAT(status.error().message, HasSubstr("layout.max_iterations"));
}

}  // namespace
}  // namespace cairn
