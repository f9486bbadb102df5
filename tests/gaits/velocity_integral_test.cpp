#include "surefoot/gaits/rhythm/velocity_integral.hpp"

#include <gtest/gtest.h>

namespace surefoot::gaits {
namespace {

constexpr double kTick = 0.0025;

TEST(VelocityIntegral, MakesUpForARobotThatIsSlowerThanAsked) {
  const Vec2 asked(0.5, 0.0), lost(0.06, -0.03);
  VelocityIntegral integral;
  Vec2 velocity;
  for (int i = 0; i < 4000; ++i) {
    velocity = asked + integral.value() - lost;
    integral.update(asked - velocity, 0.5, 0.15, kTick);
  }
  EXPECT_LT((velocity - asked).norm(), 0.001);
}

TEST(VelocityIntegral, IsBounded) {
  VelocityIntegral integral;
  for (int i = 0; i < 4000; ++i) integral.update({3.0, 4.0}, 0.5, 0.15, kTick);
  EXPECT_LT((integral.value() - Vec2(0.09, 0.12)).norm(), 1e-9);
}

}  // namespace
}  // namespace surefoot::gaits
