#include "surefoot/evaluation/alignment.hpp"

#include "surefoot/math/rotation.hpp"

#include <gtest/gtest.h>

namespace surefoot::evaluation {
namespace {

const Mat3 kTurn = rotation_about_z(2.0);  // takes W to S
const Vec3 kShift(3.0, -7.0, 0.5);

Vec3 in_S(const Vec3& p_W) { return kTurn * p_W + kShift; }

/// A robot that stands where it believes and plans, but in a world that lies elsewhere.
struct Standing {
  TickRecord tick;
  simulation::GroundTruth truth;

  Standing() {
    tick.state.p_WB = Vec3(1.0, 2.0, 0.5);
    tick.state.q_WB = from_roll_pitch_yaw({0.1, -0.05, 0.3});
    tick.state.v_WB = Vec3::Zero();
    tick.plan.com.p = Vec2(1.05, 2.01);
    tick.plan.torso.height = 0.5;
    for (std::size_t k = 0; k < kNumLegs; ++k) {
      tick.plan.feet[k].phase = LegPhase::stance;
      tick.model.p_WF[k] = Vec3(k < 2 ? 1.3 : 0.7, k % 2 == 0 ? 2.2 : 1.8, 0.03);
      truth.p_SF[k] = in_S(tick.model.p_WF[k]);
    }
    truth.p_SB = in_S(tick.state.p_WB);
    truth.q_SB = Quat(kTurn) * tick.state.q_WB;
    truth.p_SCom = in_S({1.05, 2.01, 0.4});
  }
};

TEST(Alignment, OfARobotThatDoesAsPlannedThereIsNoErrorWhereverTheWorldsLie) {
  Standing robot;
  const Alignment found = Aligner().update(robot.truth, robot.tick);
  EXPECT_LT(found.com_error.norm(), 1e-12);
  EXPECT_NEAR(found.height_error, 0.0, 1e-12);
  EXPECT_LT(found.base_error.norm(), 1e-12);
  EXPECT_NEAR(found.heading_error, 0.0, 1e-12);
  for (const WorldPose& X : {found.feet, found.start})
    EXPECT_LT((X.q_WS * in_S({5.0, 6.0, 7.0}) + X.p_WS - Vec3(5.0, 6.0, 7.0)).norm(), 1e-12);
}

TEST(Alignment, ErrorsAreInTheControllersWorld) {
  Standing robot;
  Aligner aligner;
  (void)aligner.update(robot.truth, robot.tick);
  robot.truth.time = 0.0025;
  robot.truth.p_SCom = in_S({1.05 + 0.01, 2.01 - 0.02, 0.4});
  robot.truth.p_SB = in_S(robot.tick.state.p_WB - Vec3(0.03, 0.0, 0.004));
  const Alignment found = aligner.update(robot.truth, robot.tick);
  EXPECT_LT((found.com_error - Vec2(0.01, -0.02)).norm(), 1e-12) << "truth minus plan";
  EXPECT_NEAR(found.height_error, -0.004, 1e-12) << "truth minus plan";
  EXPECT_LT((found.base_error - Vec3(0.03, 0.0, 0.004)).norm(), 1e-12) << "estimate minus truth";
}

TEST(Alignment, TheEstimatesDriftIsNoErrorOfThePlan) {
  Standing robot;
  Aligner aligner;
  (void)aligner.update(robot.truth, robot.tick);
  robot.truth.time = 0.0025;
  const Vec3 drift(0.2, 0.1, 0.0);
  robot.tick.state.p_WB += drift;
  robot.tick.plan.com.p += drift.head<2>();
  for (Vec3& p_WF : robot.tick.model.p_WF) p_WF += drift;
  const Alignment found = aligner.update(robot.truth, robot.tick);
  EXPECT_LT(found.com_error.norm(), 1e-12);
  EXPECT_LT((found.base_error - drift).norm(), 1e-12);
}

TEST(Alignment, OfAStoppedControllerOnlyTheEstimateIsCompared) {
  Standing robot;
  robot.tick.command.cause = StopCause::imu;
  const Alignment found = Aligner().update(robot.truth, robot.tick);
  EXPECT_TRUE(found.com_error.hasNaN() && std::isnan(found.height_error));
  EXPECT_LT(found.base_error.norm(), 1e-12);
}

}  // namespace
}  // namespace surefoot::evaluation
