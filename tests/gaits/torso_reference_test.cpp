#include "surefoot/gaits/parts/torso_reference.hpp"

#include "surefoot/math/rotation.hpp"
#include "tests/support/random_motion.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace surefoot::gaits {
namespace {

using test::Random;

constexpr double kPeriod = 0.0025;
constexpr double kStance = 0.46;

estimation::TerrainPlane sloped(double roll, double pitch, double yaw) {
  estimation::TerrainPlane plane;
  plane.normal = from_roll_pitch_yaw({roll, pitch, yaw}) * Vec3::UnitZ();
  return plane;
}

RobotState level_state(double height, double yaw = 0.0) {
  RobotState state;
  state.time = 0.0;
  state.p_WB = Vec3(0.0, 0.0, height);
  state.q_WB = from_roll_pitch_yaw({0.0, 0.0, yaw});
  state.v_WB.setZero();
  state.w_WB_B.setZero();
  return state;
}

/// A reference that began level at the stance height, over a plane through the origin.
struct Bench {
  explicit Bench(const TorsoOptions& options = {}) : torso(options, kPeriod) {
    torso.restart(level_state(kStance));
  }
  const TorsoPlan& tick(const estimation::TerrainPlane& plane, double height = kStance) {
    yaw += kPeriod * yaw_rate;
    com.p += kPeriod * com.v;
    torso.update(plane, yaw, yaw_rate, com, height);
    return torso.plan();
  }
  void run(double duration, const estimation::TerrainPlane& plane, double height = kStance) {
    for (double t = 0.0; t < duration - 0.5 * kPeriod; t += kPeriod) tick(plane, height);
  }
  [[nodiscard]] Vec3 angles() const { return roll_pitch_yaw(torso.plan().q_WB.toRotationMatrix()); }

  TorsoReference torso;
  ComPlan com;
  double yaw = 0.0, yaw_rate = 0.0;
};

TEST(TorsoReference, StaysWhereItBeganOnLevelGround) {
  Bench bench;
  bench.run(1.0, estimation::TerrainPlane{});
  EXPECT_LT(box_minus(bench.torso.plan().q_WB, Quat::Identity()).norm(), 1e-12);
  EXPECT_NEAR(bench.torso.plan().height, kStance, 1e-12);
  EXPECT_LT(bench.torso.plan().w_WB.norm() + bench.torso.plan().wdot_WB.norm(), 1e-12);
}

TEST(TorsoReference, ComesToStandAlongTheTerrain) {
  Random random(1);
  for (int trial = 0; trial < 20; ++trial) {
    Bench bench;
    bench.yaw = random.uniform(-3.0, 3.0);
    const double roll = random.uniform(-0.3, 0.3), pitch = random.uniform(-0.3, 0.3);
    const estimation::TerrainPlane plane = sloped(roll, pitch, bench.yaw);
    bench.com.p = random.vector(1.0).head<2>();
    bench.run(4.0, plane, 0.5);
    EXPECT_LT((bench.torso.plan().q_WB * Vec3::UnitZ() - plane.normal).norm(), 1e-6);
    EXPECT_LT((bench.angles() - Vec3(roll, pitch, bench.yaw)).norm(), 1e-6);
    EXPECT_NEAR(bench.torso.plan().height, plane.height(bench.com.p) + 0.5, 1e-6);
    EXPECT_LT(bench.torso.plan().w_WB.norm(), 1e-5);
  }
}

TEST(TorsoReference, ApproachesItsGoalCriticallyDamped) {
  const TorsoOptions options;
  Bench bench;
  const estimation::TerrainPlane plane = sloped(0.2, -0.1, 0.0);
  for (double t = kPeriod; t < 3.0; t += kPeriod) {
    bench.tick(plane, kStance + 0.1);
    const double w = options.frequency;
    const double share = 1.0 - (1.0 + w * t + 0.5 * w * w * t * t) * std::exp(-w * t);
    ASSERT_NEAR(bench.angles().x(), 0.2 * share, 0.2 * 0.01) << t;
    ASSERT_NEAR(bench.angles().y(), -0.1 * share, 0.1 * 0.01) << t;
    ASSERT_NEAR(bench.torso.plan().height, kStance + 0.1 * share, 0.1 * 0.01) << t;
    ASSERT_LE(bench.angles().x(), 0.2 + 1e-7) << "overshoot at " << t;
  }
}

TEST(TorsoReference, DoesNotJumpWhenTheTerrainDoesNorDoItsRatesAndAccelerations) {
  Random random(2);
  Bench bench;
  TorsoPlan before = bench.tick(estimation::TerrainPlane{});
  estimation::TerrainPlane plane;
  for (int tick = 0; tick < 4000; ++tick) {
    if (tick % 200 == 0) {
      plane = sloped(random.uniform(-0.35, 0.35), random.uniform(-0.35, 0.35), 0.0);
      plane.point.z() = random.uniform(-0.2, 0.2);
    }
    const TorsoPlan& plan = bench.tick(plane);
    ASSERT_LT(box_minus(plan.q_WB, before.q_WB).norm(), 0.005) << tick;
    ASSERT_LT((plan.w_WB - before.w_WB).norm(), 0.06) << tick;
    ASSERT_LT((plan.wdot_WB - before.wdot_WB).norm(), 2.0) << tick;
    ASSERT_LT(std::abs(plan.height - before.height), 0.005) << tick;
    ASSERT_LT(std::abs(plan.height_rate - before.height_rate), 0.04) << tick;
    ASSERT_LT(std::abs(plan.height_acceleration - before.height_acceleration), 0.8) << tick;
    before = plan;
  }
}

TEST(TorsoReference, AngularVelocityAndAccelerationAreRatesOfTheOrientation) {
  Random random(3);
  for (int trial = 0; trial < 20; ++trial) {
    Bench bench;
    bench.yaw = random.uniform(-3.0, 3.0);
    bench.yaw_rate = random.uniform(-0.5, 0.5);
    const estimation::TerrainPlane plane =
        sloped(random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3), 0.7);
    bench.run(random.uniform(0.05, 0.5), plane);
    const TorsoPlan before = bench.torso.plan();
    const TorsoPlan now = bench.tick(plane);
    const TorsoPlan after = bench.tick(plane);
    const Vec3 w = box_minus(after.q_WB, before.q_WB) / (2.0 * kPeriod);
    const Vec3 wdot = (after.w_WB - now.w_WB) / kPeriod;
    // Half a period lies between a rate and the difference that it is compared with.
    const double late = kPeriod * (1.0 + TorsoOptions{}.frequency);
    EXPECT_LT((w - now.w_WB).norm(), late * (0.1 + now.wdot_WB.norm())) << trial;
    EXPECT_LT((wdot - after.wdot_WB).norm(), late * (0.1 + now.wdot_WB.norm())) << trial;
  }
}

TEST(TorsoReference, HeightRateAndAccelerationAreRatesOfTheHeight) {
  Bench bench;
  bench.com.v = Vec2(0.1, -0.05);
  const estimation::TerrainPlane plane = sloped(0.1, 0.2, 0.0);
  double height = bench.torso.plan().height, rate = 0.0;
  for (int tick = 0; tick < 800; ++tick) {
    const TorsoPlan& plan = bench.tick(plane, 0.5);
    ASSERT_NEAR((plan.height - height) / kPeriod, plan.height_rate, 1e-9);
    ASSERT_NEAR((plan.height_rate - rate) / kPeriod, plan.height_acceleration, 1e-9);
    height = plan.height;
    rate = plan.height_rate;
  }
}

TEST(TorsoReference, RestartsAtTheTruePoseAndMotion) {
  Random random(4);
  for (int trial = 0; trial < 20; ++trial) {
    Bench bench;
    RobotState state;
    state.p_WB = Vec3(0.0, 0.0, random.uniform(0.3, 0.6));
    state.v_WB = random.vector(0.2);
    state.q_WB = from_roll_pitch_yaw(Vec3(random.vector(0.3)));
    state.w_WB_B = random.vector(0.3);
    bench.torso.restart(state);
    bench.yaw = yaw(state.R_WB());
    bench.tick(sloped(0.1, 0.1, 0.0));
    const TorsoPlan& plan = bench.torso.plan();
    EXPECT_LT(box_minus(plan.q_WB, state.q_WB).norm(), 0.003);
    EXPECT_NEAR(plan.height, state.p_WB.z(), 0.003);
    EXPECT_NEAR(plan.height_rate, state.v_WB.z(), 0.05);
  }
}

TEST(TorsoReference, AfterARestartTurnsAsFastAsTheTorsoDoes) {
  Bench bench;
  RobotState state = level_state(kStance, 0.8);
  state.w_WB_B = Vec3(0.2, -0.1, 0.0);
  bench.torso.restart(state);
  bench.yaw = 0.8;
  bench.tick(estimation::TerrainPlane{});
  EXPECT_LT((bench.torso.plan().w_WB - state.R_WB() * state.w_WB_B).norm(), 0.01);
}

TEST(TorsoReference, KeepsLevelWhereItShallNotFollowTheTerrain) {
  Bench bench(TorsoOptions{.follow_terrain = false});
  const estimation::TerrainPlane plane = sloped(0.2, 0.2, 0.0);
  bench.com.p = Vec2(0.3, 0.1);
  bench.run(4.0, plane);
  EXPECT_LT(bench.angles().norm(), 1e-9);
  EXPECT_NEAR(bench.torso.plan().height, plane.height(bench.com.p) + kStance, 1e-6);
}

}  // namespace
}  // namespace surefoot::gaits
