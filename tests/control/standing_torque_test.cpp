#include "surefoot/control/standing_torque.hpp"

#include "surefoot/math/rotation.hpp"
#include "tests/support/anymal_b.hpp"
#include "tests/support/random_motion.hpp"
#include "tests/support/sizes.hpp"

#include <gtest/gtest.h>

namespace surefoot::control {
namespace {

using test::anymal_b;
using test::Random;

// h − Sᵀτ is what the ground must bear: Σ J_kᵀ f_k of vertical forces that push, for all 18 rows.
TEST(StandingTorque, LeavesToTheGroundVerticalForcesThatBearTheRobot) {
  model::RobotModel model(anymal_b());
  Random random(1);
  for (int i = 0; i < 50; ++i) {
    const JointVector q = random.standing_state(anymal_b().q_nominal).q;
    const JointVector torque = standing_torque(model, q);
    const model::Dynamics& dynamics = model.update(level_at_rest(q), Vec3::UnitZ());
    GeneralizedVector borne = dynamics.h;
    borne.tail<kNumLegJoints>() -= torque;
    Eigen::Matrix<double, kNumVelocities, kNumLegs> lifts;
    for (const Leg leg : kLegs) {
      const auto k = static_cast<Eigen::Index>(index(leg));
      lifts.col(k) = dynamics.contact[index(leg)].J.row(2).transpose();
    }
    const Eigen::Vector4d forces = lifts.colPivHouseholderQr().solve(borne);
    EXPECT_LT((lifts * forces - borne).norm(), 1e-9 * borne.norm());
    EXPECT_GT(forces.minCoeff(), 0.0);
    EXPECT_NEAR(forces.sum(), dynamics.mass * kGravity, 1e-9 * forces.sum());
  }
}

// Its centre of mass behind all feet: the hind ones alone push, and it tips over.
TEST(StandingTorque, NoFootPulls) {
  model::RobotModel model(anymal_b());
  JointVector q = anymal_b().q_nominal;
  for (const Leg leg : kLegs) q[first_joint(leg) + 1] -= 1.2;
  const model::Dynamics& dynamics = model.update(level_at_rest(q), Vec3::UnitZ());
  for (const model::PointKinematics& contact : dynamics.contact) {
    ASSERT_GT(contact.p.x(), dynamics.com.p.x());
  }
  const JointVector gravity = dynamics.h.tail<kNumLegJoints>();
  const JointVector torque = standing_torque(model, q);
  for (const Leg leg : kLegs) {
    const model::PointKinematics& contact = dynamics.contact[index(leg)];
    const JointVector lift = contact.J.row(2).tail<kNumLegJoints>().transpose();
    EXPECT_GE(lift.dot(gravity - torque), -1e-9);
  }
}

// Tilted, with a moment: vertical forces that push bear the robot and turn it.
TEST(StandingTorque, TurnsATiltedTorso) {
  model::RobotModel model(anymal_b());
  const JointVector q = anymal_b().q_nominal;
  for (const double side : {-1.0, 1.0}) {
    const Righting righting{.q_WB = exp_rotation(Vec3(0.1 * side, 0.05, 0.0)),
                            .moment = Vec3(-15.0 * side, -10.0, 0.0)};
    const JointVector torque = standing_torque(model, q, righting);
    RobotState tilted = level_at_rest(q);
    tilted.q_WB = righting.q_WB;
    const model::Dynamics& dynamics = model.update(tilted, Vec3::UnitZ());
    GeneralizedVector ground = dynamics.h;
    ground.tail<kNumLegJoints>() -= torque;
    Eigen::Matrix<double, kNumLegJoints, kNumLegs> lifts;
    Eigen::Matrix<double, 3, kNumLegs> arms;
    for (const Leg leg : kLegs) {
      const auto k = static_cast<Eigen::Index>(index(leg));
      lifts.col(k) = dynamics.contact[index(leg)].J.row(2).tail<kNumLegJoints>().transpose();
      arms.col(k) = dynamics.contact[index(leg)].p - dynamics.com.p;
    }
    const Eigen::Vector4d forces =
        lifts.colPivHouseholderQr().solve(Eigen::VectorXd(ground.tail<kNumLegJoints>()));
    EXPECT_GT(forces.minCoeff(), 0.0);
    EXPECT_NEAR(forces.sum(), dynamics.mass * kGravity, 1e-6 * forces.sum());
    EXPECT_NEAR(arms.row(1).dot(forces), righting.moment.x(), 1e-6);
    EXPECT_NEAR(-arms.row(0).dot(forces), righting.moment.y(), 1e-6);
  }
}

TEST(BorneForce, IsTheWeightUnderTorquesThatBearTheRobot) {
  model::RobotModel model(anymal_b());
  Random random(2);
  for (int i = 0; i < 50; ++i) {
    const JointVector q = random.standing_state(anymal_b().q_nominal).q;
    const JointVector torque = standing_torque(model, q);
    const Vec3 weight = model.mass() * kGravity * Vec3::UnitZ();
    EXPECT_LT((borne_force(model, q, torque) - weight).norm(), 0.05 * weight.norm());
    EXPECT_LT(borne_force(model, q, JointVector::Zero(kNumLegJoints)).norm(), 0.5 * weight.norm())
        << "it lies";
    EXPECT_FALSE(borne_force(model, q, JointVector::Constant(kNumLegJoints, kNaN)).allFinite());
  }
}

TEST(StandingTorque, IsNotFiniteWhereAngleIsNot) {
  model::RobotModel model(anymal_b());
  JointVector q = anymal_b().q_nominal;
  q[4] = kNaN;
  EXPECT_FALSE(standing_torque(model, q).allFinite());
}

}  // namespace
}  // namespace surefoot::control
