#include "surefoot/math/rotation.hpp"
#include "surefoot/tasks/com_xy.hpp"
#include "surefoot/tasks/swing_foot.hpp"
#include "surefoot/tasks/torso_height.hpp"
#include "surefoot/tasks/torso_orientation.hpp"
#include "tests/support/sizes.hpp"
#include "tests/tasks/scene.hpp"

#include <gtest/gtest.h>

namespace surefoot::tasks {
namespace {

using test::Motion;
using test::plan_with_contacts;
using test::Random;
using test::random_motion;
using test::randomise_references;
using test::Rates;
using test::rates;
using test::Scene;
using test::written;
using test::WrittenRows;

constexpr int kTrials = 20;
constexpr double kTolerance = 1e-5;

/// x of a motion, with torques that must not matter.
VecX unknowns(const Motion& motion) {
  VecX x = VecX::Constant(kNumUnknowns, 77.0);
  x.head<kNumVelocities>() = motion.acceleration;
  return x;
}

/// What a row asks r̈ to be: A x is r̈ less its drift, so A x − b is r̈ less that.
double asked(const WrittenRows& rows, Eigen::Index row, const VecX& x, double rddot) {
  return rddot - (rows.A.row(row).dot(x) - rows.lower[row]);
}

TEST(ComXy, asks_for_a_spring_and_damper_around_the_reference) {
  Scene scene;
  Random random(40);
  const ComXy task({.kp = 130.0, .kd = 11.0, .max_error = 1.0});
  for (int trial = 0; trial < kTrials; ++trial) {
    const Motion motion = random_motion(random, scene.model.description().q_nominal);
    randomise_references(random, scene.model.update(motion.state, Vec3::UnitZ()), scene.plan);
    const double heading = yaw(scene.plan.R_WC);
    const std::array<Vec2, 2> axes{Vec2(std::cos(heading), std::sin(heading)),
                                   Vec2(-std::sin(heading), std::cos(heading))};
    for (std::size_t i = 0; i < 2; ++i) {
      const Rates r = rates(
          scene, motion, [&](const model::Dynamics& d) { return axes[i].dot(d.com.p.head<2>()); });
      const WrittenRows rows = written(task, scene.update(motion.state));
      ASSERT_EQ(rows.ids, (std::vector<int>{0, 1}));
      const double expected = axes[i].dot(scene.plan.com.a) +
                              11.0 * (axes[i].dot(scene.plan.com.v) - r.rdot) +
                              130.0 * (axes[i].dot(scene.plan.com.p) - r.r);
      const auto row = static_cast<Eigen::Index>(i);
      EXPECT_NEAR(asked(rows, row, unknowns(motion), r.rddot), expected, kTolerance * 100.0);
      EXPECT_TRUE(rows.lower == rows.upper);
    }
  }
}

TEST(ComXy, keeps_only_the_line_between_two_feet) {
  Scene scene;
  Random random(41);
  const RobotState state = random.standing_state(scene.model.description().q_nominal);
  randomise_references(random, scene.model.update(state, Vec3::UnitZ()), scene.plan);
  const ComXy task({.max_error = 1.0});
  const WrittenRows both = written(task, scene.update(state));
  scene.plan.feet[0].phase = LegPhase::swing;
  scene.plan.feet[3].phase = LegPhase::search;
  const TaskInput input = scene.update(state);
  const WrittenRows line = written(task, input);
  ASSERT_EQ(line.ids, (std::vector<int>{2}));
  const Vec2 direction =
      (input.dynamics.foot[2].p - input.dynamics.foot[1].p).head<2>().normalized();
  // The same request as both rows, seen along the line (whichever way it points).
  const Mat2 R = rotation_about_z(yaw(scene.plan.R_WC)).topLeftCorner<2, 2>();
  const Vec2 weights = R.transpose() * direction;
  const double sign = line.A.row(0).dot(weights.transpose() * both.A) > 0.0 ? 1.0 : -1.0;
  EXPECT_LT((sign * line.A - weights.transpose() * both.A).norm(), 1e-3);
  EXPECT_NEAR(sign * line.lower[0], weights.dot(both.lower), 1e-2);
  scene.plan.feet[1].phase = LegPhase::swing;
  EXPECT_EQ(written(task, scene.update(state)).count(), 0);
}

TEST(ComXy, shortens_large_errors) {
  Scene scene;
  const RobotState state = Random(42).standing_state(scene.model.description().q_nominal);
  const Vec2 com = scene.model.update(state, Vec3::UnitZ()).com.p.head<2>();
  const ComXy task({.kp = 100.0, .kd = 0.0, .max_error = 0.02});
  scene.plan.com.p = com;
  const WrittenRows none = written(task, scene.update(state));
  scene.plan.com.p = com + Vec2(3.0, -4.0);
  const WrittenRows far = written(task, scene.update(state));
  EXPECT_NEAR(far.lower[0] - none.lower[0], 100.0 * 0.02 * 0.6, 1e-9);
  EXPECT_NEAR(far.lower[1] - none.lower[1], 100.0 * 0.02 * -0.8, 1e-9);
}

TEST(TorsoOrientation, asks_for_a_spring_and_damper_about_the_axes_of_the_control_frame) {
  Scene scene;
  Random random(43);
  const TorsoOrientationOptions options{.kp = 130.0, .kd = 11.0, .max_error = 10.0};
  const TorsoYaw torso_yaw(options);
  const TorsoRollPitch torso_roll_pitch(options);
  for (int trial = 0; trial < kTrials; ++trial) {
    const Motion motion = random_motion(random, scene.model.description().q_nominal);
    randomise_references(random, scene.model.update(motion.state, Vec3::UnitZ()), scene.plan);
    const TaskInput input = scene.update(motion.state);
    const WrittenRows rows = test::stacked({&torso_roll_pitch, &torso_yaw}, input);
    ASSERT_EQ(rows.count(), 3);
    // ẇ in W by differences of the rotation matrix itself: S(w) = Ṙ Rᵀ.
    constexpr double kStep = 1e-5;
    const auto rate = [&](double time) {
      const Mat3 after = motion.at(time + kStep).R_WB();
      const Mat3 before = motion.at(time - kStep).R_WB();
      const Mat3 S = (after - before) / (2.0 * kStep) * motion.at(time).R_WB().transpose();
      return Vec3(S(2, 1), S(0, 2), S(1, 0));
    };
    const Vec3 wdot = (rate(1e-3) - rate(-1e-3)) / 2e-3;
    const Mat3 C = scene.plan.R_WC.transpose();
    const Vec3 error = box_minus(scene.plan.torso.q_WB, motion.state.q_WB);
    const Vec3 expected =
        C * (scene.plan.torso.wdot_WB + 11.0 * (scene.plan.torso.w_WB - rate(0.0)) + 130.0 * error);
    for (Eigen::Index i = 0; i < 3; ++i) {
      EXPECT_NEAR(asked(rows, i, unknowns(motion), (C * wdot)[i]), expected[i], 1e-4);
    }
  }
}

TEST(TorsoOrientation, drives_the_error_to_zero_from_any_side) {
  Scene scene;
  Random random(44);
  const TorsoOrientationOptions options{.kp = 200.0, .kd = 28.0, .max_error = 0.05};
  const TorsoYaw torso_yaw(options);
  const TorsoRollPitch torso_roll_pitch(options);
  for (int trial = 0; trial < 5; ++trial) {
    scene.plan.R_WC = random.small_rotation(0.3).toRotationMatrix();
    RobotState state = random.standing_state(scene.model.description().q_nominal);
    scene.plan.torso.q_WB = random.small_rotation(0.5) * state.q_WB;
    constexpr double kTick = 0.0025;
    for (int tick = 0; tick < 2000; ++tick) {
      const TaskInput input = scene.update(state);
      const WrittenRows rows = test::stacked({&torso_roll_pitch, &torso_yaw}, input);
      // The rows act on the base's angular acceleration alone.
      const Vec3 wdot_B = rows.A.middleCols<3>(3).inverse() * rows.lower;
      state.w_WB_B += kTick * wdot_B;
      state.q_WB = state.q_WB * exp_rotation(kTick * state.w_WB_B);
    }
    EXPECT_LT(state.q_WB.angularDistance(scene.plan.torso.q_WB), 1e-6);
    EXPECT_LT(state.w_WB_B.norm(), 1e-6);
  }
}

TEST(TorsoOrientation, shortens_large_errors) {
  Scene scene;
  RobotState state = Random(45).standing_state(scene.model.description().q_nominal);
  state.w_WB_B.setZero();
  scene.plan.torso.q_WB = exp_rotation(Vec3(0.6, 0.8, 0.5)) * state.q_WB;
  const TorsoOrientationOptions options{.kp = 100.0, .kd = 0.0, .max_error = 0.05};
  const TaskInput input = scene.update(state);
  const WrittenRows roll_pitch = written(TorsoRollPitch(options), input);
  EXPECT_NEAR(roll_pitch.lower[0], 3.0, 1e-9);
  EXPECT_NEAR(roll_pitch.lower[1], 4.0, 1e-9);
  EXPECT_NEAR(written(TorsoYaw(options), input).lower[0], 5.0, 1e-9);
}

TEST(TorsoHeight, asks_for_a_spring_and_damper_around_the_reference) {
  Scene scene;
  Random random(46);
  const TorsoHeight task({.kp = 130.0, .kd = 11.0, .max_error = 1.0});
  for (int trial = 0; trial < kTrials; ++trial) {
    const Motion motion = random_motion(random, scene.model.description().q_nominal);
    randomise_references(random, scene.model.update(motion.state, Vec3::UnitZ()), scene.plan);
    const Rates z = rates(scene, motion, [](const model::Dynamics& d) { return d.base.p.z(); });
    const WrittenRows rows = written(task, scene.update(motion.state));
    const TorsoPlan& reference = scene.plan.torso;
    EXPECT_NEAR(asked(rows, 0, unknowns(motion), z.rddot),
                reference.height_acceleration + 11.0 * (reference.height_rate - z.rdot) +
                    130.0 * (reference.height - z.r),
                kTolerance);
  }
}

TEST(SwingFoot, asks_for_a_spring_and_damper_around_the_reference_of_feet_in_the_air) {
  Scene scene;
  Random random(47);
  const SwingFoot task({.kp = 130.0, .kd = 11.0, .max_error = 1.0});
  for (int trial = 0; trial < kTrials; ++trial) {
    scene.plan = plan_with_contacts({true, false, true, false});
    const Motion motion = random_motion(random, scene.model.description().q_nominal);
    randomise_references(random, scene.model.update(motion.state, Vec3::UnitZ()), scene.plan);
    for (Eigen::Index i = 0; i < 6; ++i) {
      const std::size_t leg = i < 3 ? 1 : 3;
      const FootPlan& reference = scene.plan.feet[leg];
      const Rates r =
          rates(scene, motion, [&](const model::Dynamics& d) { return d.foot[leg].p[i % 3]; });
      const WrittenRows rows = written(task, scene.update(motion.state));
      ASSERT_EQ(rows.ids, (std::vector<int>{3, 4, 5, 9, 10, 11}));
      EXPECT_NEAR(asked(rows, i, unknowns(motion), r.rddot),
                  reference.a_WF[i % 3] + 11.0 * (reference.v_WF[i % 3] - r.rdot) +
                      130.0 * (reference.p_WF[i % 3] - r.r),
                  kTolerance * 100.0);
    }
  }
}

TEST(SwingFoot, writes_nothing_while_all_feet_are_on_the_ground) {
  Scene scene;
  const TaskInput input =
      scene.update(Random(48).standing_state(scene.model.description().q_nominal));
  EXPECT_EQ(written(SwingFoot({}), input).count(), 0);
}

}  // namespace
}  // namespace surefoot::tasks
