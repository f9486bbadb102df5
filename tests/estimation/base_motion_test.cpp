#include "surefoot/estimation/base_motion.hpp"

#include "tests/support/random_motion.hpp"

#include <gtest/gtest.h>

namespace surefoot {
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
    const PerLeg<Vec3> p_BF = some_feet(random);
    const Vec3 v = random.vector(1.0), w = random.vector(2.0);
    PerLeg<Vec3> v_BF;
    for (std::size_t k = 0; k < kNumLegs; ++k) v_BF[k] = -v - w.cross(p_BF[k]);
    const BaseMotion motion = base_motion(p_BF, v_BF);
    EXPECT_LT((motion.v - v).norm(), 1e-12);
    EXPECT_LT((motion.w - w).norm(), 1e-12);
  }
}

TEST(BaseMotion, LeavesTheLeastOfWhatNoRigidMotionExplains) {
  Random random(2);
  const auto rest = [](const PerLeg<Vec3>& p_BF, const PerLeg<Vec3>& v_BF, const BaseMotion& m) {
    double sum = 0.0;
    for (std::size_t k = 0; k < kNumLegs; ++k) {
      sum += (m.v + m.w.cross(p_BF[k]) + v_BF[k]).squaredNorm();
    }
    return sum;
  };
  for (int i = 0; i < 50; ++i) {
    const PerLeg<Vec3> p_BF = some_feet(random);
    PerLeg<Vec3> v_BF;
    for (Vec3& v : v_BF) v = random.vector(0.5);
    const BaseMotion best = base_motion(p_BF, v_BF);
    for (int other = 0; other < 10; ++other) {
      const BaseMotion changed{best.v + random.vector(0.01), best.w + random.vector(0.01)};
      EXPECT_GT(rest(p_BF, v_BF, changed), rest(p_BF, v_BF, best));
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

TEST(LineFit, FindsSlopeMeanAndEndOfALine) {
  const Vec3 start(1.0, -2.0, 0.5), slope(0.1, 0.2, -0.3);
  LineFit fit;
  for (int k = 0; k < 7; ++k) fit.add(start + k * slope);
  EXPECT_LT((fit.slope() - slope).norm(), 1e-12);
  EXPECT_LT((fit.mean() - start - 3.0 * slope).norm(), 1e-12);
  EXPECT_LT((fit.last() - start - 6.0 * slope).norm(), 1e-12);
  fit.clear();
  fit.add(start);
  EXPECT_EQ(fit.slope(), Vec3::Zero());
  EXPECT_EQ(fit.last(), start);
}

}  // namespace
}  // namespace surefoot
