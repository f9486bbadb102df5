#include "surefoot/gaits/parts/arm_reference.hpp"

#include "surefoot/math/rotation.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace surefoot::gaits {
namespace {

constexpr double kPeriod = 0.0025;

/// A base and the tip of its only arm.
struct Bench {
  Bench() {
    state.p_WB = Vec3(1.0, 2.0, 0.5);
    state.q_WB = from_roll_pitch_yaw({0.1, 0.2, 0.3});
    state.v_WB = state.w_WB_B = Vec3::Zero();
    dynamics.arm_tips[0].point.p = state.p_WB + Vec3(0.3, 0.0, 0.2);
  }
  ArmPlan after(double time, const ReachCommand& command) {
    ArmPlan plan;
    for (double t = 0.0; t < time; t += kPeriod) {
      plan = reference.update(command, state, dynamics);
      if (!follows) continue;
      dynamics.arm_tips[0].point.p = plan.p_WT;
      dynamics.arm_tips[0].rotation.R = plan.q_WT.toRotationMatrix();
      fastest = std::max(fastest, plan.v_WT.norm());
    }
    return plan;
  }
  RobotState state;
  model::Dynamics dynamics{kNumLegJoints + 6, 1};
  ArmReference reference{kPeriod, {}};
  double fastest = 0.0;
  bool follows = true;  // the tip, its reference
};

TEST(ArmReference, GoesSmoothlyFromWhereTheTipIsToWhereItIsWanted) {
  Bench bench;
  const Vec3 first = bench.dynamics.arm_tips[0].point.p, last = first + Vec3(0.8, -0.3, 0.1);
  const ReachCommand command{
      .arm = 0, .in_world = true, .position = last, .orientation = Vec3(0.5, 0.0, -0.4)};
  EXPECT_LT((bench.after(kPeriod, command).p_WT - first).norm(), 1e-4);
  const ArmPlan plan = bench.after(10.0, command);
  EXPECT_LT((plan.p_WT - last).norm(), 1e-3);
  EXPECT_LT(plan.q_WT.angularDistance(from_roll_pitch_yaw(command.orientation)), 1e-3);
  EXPECT_LT(plan.v_WT.norm(), 1e-3);
  EXPECT_GT(bench.fastest, 0.15);
  EXPECT_LT(bench.fastest, 0.21) << "however far it is";
}

TEST(ArmReference, WaitsForATipThatCanNotFollow) {
  Bench bench;
  bench.follows = false;
  const Vec3 tip = bench.dynamics.arm_tips[0].point.p;
  const ReachCommand command{.arm = 0,
                             .in_world = true,
                             .position = tip + Vec3(9.0, 0.0, 0.0),
                             .orientation = Vec3(0.0, 0.0, 2.0)};
  const ArmPlan plan = bench.after(10.0, command);
  EXPECT_NEAR((plan.p_WT - tip).norm(), 0.02, 1e-3);
  EXPECT_NEAR(plan.q_WT.angularDistance(Quat::Identity()), 0.2, 1e-2);
  EXPECT_LT(plan.v_WT.norm(), 1e-3);
  EXPECT_LT(plan.w_WT.norm(), 1e-2);
  bench.follows = true;
  EXPECT_GT((bench.after(5.0, command).p_WT - tip).norm(), 0.5) << "goes on where the tip follows";
}

TEST(ArmReference, InTheBaseItMovesWithTheBase) {
  Bench bench;
  const Vec3 wanted(0.4, 0.1, 0.3);
  const ReachCommand command{.arm = 0, .position = wanted};
  bench.after(8.0, command);
  bench.state.p_WB = Vec3(4.0, -1.0, 0.4);
  bench.state.v_WB = Vec3(0.2, 0.1, 0.0);
  bench.state.w_WB_B = Vec3(0.0, 0.0, 0.5);
  const Vec3 arm = bench.state.R_WB() * wanted;
  bench.dynamics.arm_tips[0].point.p = bench.state.p_WB + arm;
  const ArmPlan plan = bench.after(kPeriod, command);
  EXPECT_LT((plan.p_WT - (bench.state.p_WB + arm)).norm(), 1e-3);
  const Vec3 velocity = bench.state.v_WB + (bench.state.R_WB() * bench.state.w_WB_B).cross(arm);
  EXPECT_LT((plan.v_WT - velocity).norm(), 1e-3);
}

TEST(ArmReference, AnArmThatIsNotThereFollowsNothing) {
  Bench bench;
  for (const int arm : {-1, 1, 7}) EXPECT_EQ(bench.after(kPeriod, {.arm = arm}).arm, -1);
  ReachCommand command{.arm = 0};
  command.position.x() = kNaN;
  EXPECT_EQ(bench.after(kPeriod, command).arm, -1);
}

}  // namespace
}  // namespace surefoot::gaits
