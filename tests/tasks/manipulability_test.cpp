#include "surefoot/tasks/manipulability.hpp"

#include "surefoot/model/body_tree.hpp"
#include "surefoot/model/urdf.hpp"
#include "tests/tasks/scene.hpp"

#include <Eigen/LU>
#include <gtest/gtest.h>

namespace surefoot::tasks {
namespace {

using test::Random;
using test::Scene;
using test::written;
using test::WrittenRows;

using Form = Manipulability::Form;

/// m of a leg at joint angles, from the definition.
double measure(const model::RobotModel& model, Leg leg, const Vec3& q) {
  const model::RobotDescription& robot = model.description();
  static const model::BodyTree tree =
      model::make_body_tree(robot, model::read_urdf(robot.urdf_path));
  Mat3 J;
  (void)tree.legs[index(leg)].chain.foot_in_base(q, &J);
  return std::sqrt((J * J.transpose()).determinant());
}

Vec3 leg_angles(const RobotState& state, Leg leg) { return state.q.segment<3>(first_joint(leg)); }

RobotState standing_still(const model::RobotDescription& robot) {
  RobotState state = Random(80).standing_state(robot.q_nominal);
  state.q = robot.q_nominal;
  state.q_WB = Quat::Identity();
  state.v_WB.setZero();
  state.w_WB_B.setZero();
  state.qd.setZero();
  return state;
}

/// The base at a height above the feet of the nominal posture, the feet where they are.
RobotState at_height(const model::RobotModel& model, double height) {
  const model::RobotDescription& robot = model.description();
  RobotState state = standing_still(robot);
  for (const Leg leg : kLegs) {
    Vec3 p_BF = model.foot_in_base(leg, robot.q_nominal.segment<3>(first_joint(leg)));
    p_BF.z() = -height;
    Vec3 q;
    EXPECT_TRUE(
        model.inverse_kinematics(leg, p_BF, robot.q_nominal.segment<3>(first_joint(leg)), q));
    state.q.segment<3>(first_joint(leg)) = q;
  }
  return state;
}

TEST(LegManipulability, has_the_measure_and_gradient_of_the_leg_jacobian) {
  Scene scene;
  Random random(81);
  for (int trial = 0; trial < 50; ++trial) {
    const RobotState state = random.state();  // any orientation: m does not depend on it
    const TaskInput input = scene.update(state);
    for (const Leg leg : kLegs) {
      const Vec3 q = leg_angles(state, leg);
      const LegManipulability ours = leg_manipulability(input.dynamics, leg);
      EXPECT_NEAR(ours.m, measure(scene.model, leg, q), 1e-9);
      Vec3 gradient;
      constexpr double kStep = 1e-5;
      for (int j = 0; j < 3; ++j) {
        const Vec3 step = kStep * Vec3::Unit(j);
        gradient[j] = (measure(scene.model, leg, q + step) - measure(scene.model, leg, q - step)) /
                      (2.0 * kStep);
      }
      EXPECT_LT((ours.gradient - gradient).norm(), 1e-6);
    }
  }
}

TEST(LegManipulability, has_the_slope_of_the_measure_in_height_with_the_foot_in_place) {
  Scene scene;
  Random random(82);
  constexpr double kStep = 1e-4;
  for (int trial = 0; trial < 20; ++trial) {
    const RobotState state = random.standing_state(scene.model.description().q_nominal);
    const TaskInput input = scene.update(state);
    for (const Leg leg : kLegs) {
      const Vec3 q = leg_angles(state, leg);
      const Vec3 up_in_base = state.R_WB().transpose() * Vec3::UnitZ();
      const Vec3 p_BF = scene.model.foot_in_base(leg, q);
      Vec3 higher;
      Vec3 lower;
      ASSERT_TRUE(scene.model.inverse_kinematics(leg, p_BF - kStep * up_in_base, q, higher));
      ASSERT_TRUE(scene.model.inverse_kinematics(leg, p_BF + kStep * up_in_base, q, lower));
      const double slope =
          (measure(scene.model, leg, higher) - measure(scene.model, leg, lower)) / (2.0 * kStep);
      EXPECT_NEAR(leg_manipulability(input.dynamics, leg).height_gradient, slope, 1e-4);
    }
  }
}

TEST(Manipulability, as_printed_does_nothing_in_the_x_configuration) {
  Scene scene;
  const RobotState state = standing_still(scene.model.description());
  const TaskInput input = scene.update(state);
  EXPECT_GT(std::abs(leg_manipulability(input.dynamics, Leg::LF).gradient[2]), 1e-3);
  EXPECT_NEAR(written(Manipulability({.form = Form::paper, .k0 = 1.0}), input).lower[0], 0.0, 1e-9);
  EXPECT_GT(std::abs(written(Manipulability({.form = Form::chained, .k0 = 1.0}), input).lower[0]),
            1e-2);
}

TEST(Manipulability, moves_towards_the_height_of_the_largest_measure) {
  Scene scene;
  double best_height = 0.0;
  double best = 0.0;
  for (double height = 0.30; height < 0.55; height += 0.001) {
    const RobotState state = at_height(scene.model, height);
    double sum = 0.0;
    for (const Leg leg : kLegs) sum += measure(scene.model, leg, leg_angles(state, leg));
    best_height = sum > best ? height : best_height;
    best = std::max(best, sum);
  }
  const Manipulability task({});
  const auto drive = [&](double height) {
    return written(task, scene.update(at_height(scene.model, height))).lower[0];
  };
  EXPECT_GT(drive(best_height - 0.05), 0.05);
  EXPECT_LT(drive(best_height + 0.01), -0.01);
  EXPECT_NEAR(drive(best_height), 0.0, 0.15);  // half a millimetre of the grid
}

TEST(Manipulability, damps_the_height_and_weighs_the_legs) {
  Scene scene;
  RobotState state = standing_still(scene.model.description());
  const Manipulability off({.k0 = 0.0, .kd = 7.0});
  state.v_WB.z() = 0.3;
  EXPECT_NEAR(written(off, scene.update(state)).lower[0], -2.1, 1e-12);
  state.v_WB.z() = 0.0;
  const TaskInput input = scene.update(state);
  const Manipulability one({.k0 = 2.0, .kd = 0.0, .weights = {0.0, 3.0, 0.0, 0.0}});
  EXPECT_NEAR(written(one, input).lower[0],
              6.0 * leg_manipulability(input.dynamics, Leg::RF).height_gradient, 1e-12);
}

TEST(Manipulability, stays_bounded_at_straight_legs) {
  Scene scene;
  const TaskInput input = scene.update(test::straight_legged_state());
  const WrittenRows rows = written(Manipulability({.kd = 0.0, .max_acceleration = 2.0}), input);
  EXPECT_TRUE(rows.A.allFinite());
  EXPECT_LE(std::abs(rows.lower[0]), 2.0);
}

}  // namespace
}  // namespace surefoot::tasks
