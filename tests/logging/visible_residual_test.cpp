#include "surefoot/logging/visible_residual.hpp"

#include <gtest/gtest.h>

namespace surefoot::logging {
namespace {

TEST(VisibleResidual, GoesWithTheRobotsSize) {
  const Scale small{.length = 0.5, .mass = 0.125};
  const auto visible = [&](const char* unit) {
    return visible_residual("torso", unit, small) / visible_residual("torso", unit, Scale());
  };
  EXPECT_DOUBLE_EQ(visible("N"), 0.125);
  EXPECT_DOUBLE_EQ(visible("N·m"), 0.0625);
  EXPECT_DOUBLE_EQ(visible("rad/s²"), 2.0);
  EXPECT_DOUBLE_EQ(visible("m/s²"), 1.0);
}

TEST(VisibleResidual, OfATipIsMoreThanItsSlowJointsCost) {
  EXPECT_EQ(visible_residual("arm_tip", "", Scale()), 1.5);
}

}  // namespace
}  // namespace surefoot::logging
