#include "surefoot/estimation/base_motion.hpp"

#include "tests/support/random_motion.hpp"

#include <gtest/gtest.h>

namespace surefoot::estimation {
namespace {

using test::Random;

PerLeg<Vec3> some_feet(Random& random) {
  PerLeg<Vec3> feet{Vec3(0.3, 0.2, -0.5), Vec3(0.3, -0.2, -0.5), Vec3(-0.3, 0.2, -0.5),
                    Vec3(-0.3, -0.2, -0.5)};
  for (Vec3& foot : feet) foot += random.vector(0.1);
  return feet;
}

// Of a base that moves by v and ω, feet that stand move by −v − ω × p in it.
TEST(BaseMotion, IsWhatMovesFeetThatStand) {
  Random random(1);
  for (int i = 0; i < 50; ++i) {
    const PerLeg<Vec3> p_BC = some_feet(random);
    const Vec3 v = random.vector(1.0), w = random.vector(2.0);
    PerLeg<Vec3> v_BC;
    for (std::size_t k = 0; k < kNumLegs; ++k) v_BC[k] = -v - w.cross(p_BC[k]);
    const BaseMotion motion = base_motion(p_BC, v_BC);
    EXPECT_LT((motion.v - v).norm(), 1e-12);
    EXPECT_LT((motion.w - w).norm(), 1e-12);
  }
}

TEST(BaseMotion, LeavesTheLeastOfWhatNoRigidMotionExplains) {
  Random random(2);
  const auto rest = [](const PerLeg<Vec3>& p_BC, const PerLeg<Vec3>& v_BC, const BaseMotion& m) {
    double sum = 0.0;
    for (std::size_t k = 0; k < kNumLegs; ++k) {
      sum += (m.v + m.w.cross(p_BC[k]) + v_BC[k]).squaredNorm();
    }
    return sum;
  };
  for (int i = 0; i < 50; ++i) {
    const PerLeg<Vec3> p_BC = some_feet(random);
    PerLeg<Vec3> v_BC;
    for (Vec3& v : v_BC) v = random.vector(0.5);
    const BaseMotion best = base_motion(p_BC, v_BC);
    for (int other = 0; other < 10; ++other) {
      const BaseMotion changed{best.v + random.vector(0.01), best.w + random.vector(0.01)};
      EXPECT_GT(rest(p_BC, v_BC, changed), rest(p_BC, v_BC, best));
    }
  }
}

TEST(BaseMotion, FeetThatDoNotMoveMakeItExactlyZero) {
  Random random(3);
  PerLeg<Vec3> still;
  still.fill(Vec3::Zero());
  const BaseMotion motion = base_motion(some_feet(random), still);
  EXPECT_EQ(motion.v, Vec3::Zero());
  EXPECT_EQ(motion.w, Vec3::Zero());
}

TEST(BaseMotion, IsZeroWhereAllPointsLieInALine) {
  PerLeg<Vec3> p_BC, v_BC;
  for (std::size_t k = 0; k < kNumLegs; ++k)
    p_BC[k] = Vec3(0.25 * static_cast<double>(k), 0.0, 0.0);
  v_BC.fill(Vec3(0.1, 0.0, 0.0));
  EXPECT_EQ(base_motion(p_BC, v_BC).v, Vec3::Zero());
}

}  // namespace
}  // namespace surefoot::estimation
