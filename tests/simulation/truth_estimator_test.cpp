#include "surefoot/simulation/truth_estimator.hpp"

#include <gtest/gtest.h>

namespace surefoot::simulation {
namespace {

TEST(TruthEstimator, SensesJointPositionsAndTorquesAndTakesTheRestFromTheTruth) {
  GroundTruth truth;
  TruthEstimator estimator(truth);
  truth.p_SB = {1.0, 2.0, 3.0};  // after construction: it looks at each update
  truth.q_SB = Quat(Eigen::AngleAxisd(0.3, Vec3::UnitY()));
  truth.v_SB = {0.1, 0.2, 0.3};
  truth.w_SB_B = {0.4, 0.5, 0.6};
  truth.q.setConstant(9.0);
  truth.qd.setConstant(0.7);
  truth.torque.setConstant(9.0);
  SensorReading reading;
  reading.time = 1.5;
  reading.q.setConstant(0.8);
  reading.torque.setConstant(11.0);

  const RobotState& state = estimator.update(reading, {});
  EXPECT_EQ(state.time, 1.5);
  EXPECT_EQ(state.p_WB, truth.p_SB);
  EXPECT_EQ(state.q_WB.coeffs(), truth.q_SB.coeffs());
  EXPECT_EQ(state.v_WB, truth.v_SB);
  EXPECT_EQ(state.w_WB_B, truth.w_SB_B);
  EXPECT_EQ(state.q, reading.q);
  EXPECT_EQ(state.qd, truth.qd);
  EXPECT_EQ(state.torque, reading.torque);
}

TEST(TruthEstimator, TakesJointsThatComeLateOnToNow) {
  GroundTruth truth;
  TruthEstimator estimator(truth);
  truth.qd = JointVector::LinSpaced(kNumLegJoints, -2.0, 3.0);
  SensorReading reading;
  reading.q.setConstant(0.8);
  TickContext context;
  context.joint_lag = 0.0025;
  const RobotState& state = estimator.update(reading, context);
  EXPECT_LT((state.q - (reading.q + 0.0025 * truth.qd)).cwiseAbs().maxCoeff(), 1e-15);
}

}  // namespace
}  // namespace surefoot::simulation
