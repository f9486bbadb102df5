// How numbers go with the size of a robot, by their unit.
#include "surefoot/base/scale.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace surefoot {
namespace {

constexpr Scale kScale{.length = 4.0, .mass = 3.0};  // a robot for which times double

TEST(Scale, OfAUnitIsThatOfItsDimension) {
  EXPECT_DOUBLE_EQ(kScale.of("m"), 4.0);
  EXPECT_DOUBLE_EQ(kScale.of("kg"), 3.0);
  EXPECT_DOUBLE_EQ(kScale.of("s"), 2.0);
  EXPECT_DOUBLE_EQ(kScale.of("m/s"), 2.0);
  EXPECT_DOUBLE_EQ(kScale.of("N"), 3.0);
  EXPECT_DOUBLE_EQ(kScale.of("N·m"), 12.0);
  EXPECT_DOUBLE_EQ(kScale.of("N·s"), 6.0);
  EXPECT_DOUBLE_EQ(kScale.of("kg·m²"), 48.0);
  EXPECT_DOUBLE_EQ(kScale.of("1/s²"), 0.25);
  EXPECT_DOUBLE_EQ(kScale.of("N·m·s/rad"), 24.0);
  EXPECT_DOUBLE_EQ(kScale.of("m/√s"), 4.0 / std::sqrt(2.0));
  EXPECT_DOUBLE_EQ(kScale.of("1/(m s²)"), 0.0625);
  EXPECT_DOUBLE_EQ(kScale.of("rad/s/√Hz"), 0.5 * std::sqrt(2.0));
}

TEST(Scale, LeavesWhatHasNoDimensionAndAccelerations) {
  for (const char* unit : {"", "rad", "–", "ticks", "m/s²"})
    EXPECT_EQ(kScale.of(unit), 1.0) << unit;
}

TEST(Scale, OfTheReferenceChangesNothing) {
  for (const char* unit : {"m", "N·m·s/rad", "m/√s", "rad/s²/√Hz"})
    EXPECT_EQ(Scale{}.of(unit), 1.0) << unit;
}

TEST(Scale, HasNamesForTheUsualQuantities) {
  EXPECT_EQ(kScale.time(), kScale.of("s"));
  EXPECT_EQ(kScale.speed(), kScale.of("m/s"));
  EXPECT_EQ(kScale.rate(), kScale.of("rad/s"));
  EXPECT_EQ(kScale.force(), kScale.of("N"));
  EXPECT_EQ(kScale.torque(), kScale.of("N·m"));
}

}  // namespace
}  // namespace surefoot
