#include "surefoot/base/error.hpp"
#include "surefoot/math/rotation.hpp"
#include "surefoot/model/robot_model.hpp"
#include "tests/support/anymal_b.hpp"
#include "tests/support/random_motion.hpp"

#include <gtest/gtest.h>

namespace surefoot::model {
namespace {

using test::anymal_b_with_arm;
using test::moved;
using test::Random;

constexpr double kStep = 1e-6;
const Vec3 kUp = Vec3::UnitZ();

RobotState random_state(Random& random) {
  RobotState state = random.state();
  for (JointVector* values : {&state.q, &state.qd}) {
    values->conservativeResize(kNumLegJoints + 6);
    for (double& value : values->tail(6)) value = random.uniform(-1.5, 1.5);
  }
  return state;
}

TEST(Arm, ItsTipMovesAsItsJacobianSays) {
  RobotModel model(anymal_b_with_arm());
  Random random(1);
  for (int trial = 0; trial < 20; ++trial) {
    const RobotState state = random_state(random);
    const FrameKinematics tip = model.update(state, kUp).arm_tips[0];
    const GeneralizedVector u = state.u();
    const FrameKinematics after = model.update(moved(state, u, kStep), kUp).arm_tips[0];
    const FrameKinematics before = model.update(moved(state, u, -kStep), kUp).arm_tips[0];
    EXPECT_LT((tip.point.J * u - tip.point.v).norm(), 1e-9);
    EXPECT_LT((tip.rotation.J * u - tip.rotation.w).norm(), 1e-9);
    EXPECT_LT(((after.point.p - before.point.p) / (2.0 * kStep) - tip.point.v).norm(), 1e-6);
    EXPECT_LT(((after.point.v - before.point.v) / (2.0 * kStep) - tip.point.Jdot_u).norm(), 1e-5);
    EXPECT_LT(((after.rotation.w - before.rotation.w) / (2.0 * kStep) - tip.rotation.Jdot_u).norm(),
              1e-5);
    const Vec3 turn = box_minus(Quat(after.rotation.R), Quat(before.rotation.R));
    EXPECT_LT((turn / (2.0 * kStep) - tip.rotation.w).norm(), 1e-6);
  }
}

TEST(Arm, ItsWeightIsInTheTorquesOfItsJointsAndOnTheBase) {
  RobotModel model(anymal_b_with_arm());
  Random random(2);
  RobotState state = random_state(random);
  for (Vec3* velocity : {&state.v_WB, &state.w_WB_B}) velocity->setZero();
  state.qd.setZero();
  const Dynamics dynamics = model.update(state, kUp);
  const double weight = kGravity * dynamics.mass;
  EXPECT_NEAR(dynamics.h[2], weight, 1e-9 * weight);
  for (int j = kNumLegJoints; j < kNumLegJoints + 6; ++j) {  // h is the gradient of m g z
    RobotState raised = state, lowered = state;
    raised.q[j] += kStep;
    lowered.q[j] -= kStep;
    const double slope =
        (model.update(raised, kUp).com.p.z() - model.update(lowered, kUp).com.p.z()) /
        (2.0 * kStep);
    EXPECT_NEAR(dynamics.h[6 + j], weight * slope, 1e-4) << j;
  }
  EXPECT_LT((dynamics.M - dynamics.M.transpose()).norm(), 1e-12);
  EXPECT_EQ(dynamics.M.llt().info(), Eigen::Success);
}

TEST(Arm, JointsThatNobodyNamesAreToldWithTheWayToNameThem) {
  RobotDescription robot = anymal_b_with_arm();
  robot.arms[0].joints.pop_back();
  try {
    const RobotModel model(robot);
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what())
                  .find("joint \"j2s6s200_joint_6\" can move but is not a joint "
                        "of a leg or an arm of the description; name it under "
                        "`arms:`, or make it fixed"),
              std::string::npos)
        << error.what();
  }
}

TEST(Arm, AnArmOnAnotherComesAfterIt) {
  RobotDescription robot = anymal_b_with_arm();
  const ArmDescription whole = robot.arms[0];
  robot.arms = {{"hand", {whole.joints.begin() + 3, whole.joints.end()}, whole.tip_frame},
                {"upper", {whole.joints.begin(), whole.joints.begin() + 3}, "j2s6s200_link_3"}};
  EXPECT_THROW(RobotModel{robot}, Error);
  std::swap(robot.arms[0], robot.arms[1]);
  EXPECT_EQ(RobotModel(robot).dynamics().arm_tips.size(), 2U);
}

}  // namespace
}  // namespace surefoot::model
