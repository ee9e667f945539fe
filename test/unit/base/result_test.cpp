#include "base/result.hpp"

#include <gmock/gmock.h>

#include "base/id.hpp"

namespace cairn {
namespace {

TEST(Result, HoldsAValueOrTheReasonWhyThereIsNone) {
  const Result<int> value = 7;
  const Result<int> none = Error{ErrorCode::kNotFound, "no such place"};

  EXPECT_EQ(*value, 7);
  ASSERT_FALSE(none.ok());
  EXPECT_EQ(none.error().code, ErrorCode::kNotFound);
}

TEST(ResultDeathTest, LookingAtAValueThatIsNotThereIsOurOwnBug) {
  const Result<int> none = Error{ErrorCode::kNotFound, "no such place"};
  EXPECT_DEATH(static_cast<void>(*none), "CAIRN_CHECK failed");
}

TEST(Status, IsDoneUnlessItCarriesAReason) {
  EXPECT_TRUE(Status().ok());
  EXPECT_FALSE(Status(Error{ErrorCode::kMalformed, "bytes"}).ok());
}

TEST(Id, OfNothingIsNotValid) {
  using PlaceId = Id<struct PlaceTag>;
  EXPECT_FALSE(PlaceId{}.is_valid());
  EXPECT_TRUE(PlaceId{0}.is_valid());
}

}  // namespace
}  // namespace cairn
