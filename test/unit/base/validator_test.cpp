#include "base/validator.hpp"

#include <limits>

#include <gmock/gmock.h>

namespace cairn {
namespace {

TEST(Validator, NamesEveryFieldThatIsOutOfRangeWithItsValue) {
  const Status status = Validator("localizer")
                            .within("particle_count", 0, 1, 100'000)
                            .positive("hit_sigma_m", -0.05)
                            .within("share", 0.5, 0, 1)
                            .status();
  ASSERT_FALSE(status.ok());
  EXPECT_EQ(status.error().message,
            "localizer.particle_count must be in [1, 100000], is 0; "
            "localizer.hit_sigma_m must be > 0, is -0.05");
}

TEST(Validator, RefusesWhatIsNotANumber) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(Validator("x").within("y", nan, 0, 1).status().ok());
  EXPECT_FALSE(Validator("x").positive("y", nan).status().ok());
  EXPECT_FALSE(Validator("x").positive("y", std::numeric_limits<double>::infinity()).status().ok());
}

}  // namespace
}  // namespace cairn
