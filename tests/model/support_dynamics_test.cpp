#include "surefoot/model/support_dynamics.hpp"

#include "surefoot/model/robot_model.hpp"
#include "tests/support/anymal_b.hpp"
#include "tests/support/forward_dynamics.hpp"
#include "tests/support/linear_algebra.hpp"
#include "tests/support/random_motion.hpp"
#include "tests/support/sizes.hpp"

#include <gtest/gtest.h>

namespace surefoot::model {
namespace {

using test::all_contact_sets;
using test::anymal_b;
using test::plan_with_contacts;
using test::Random;
using test::random_torque;
using test::stacked_jacobians;
using test::straight_legged_state;

const Vec3 kUp = Vec3::UnitZ();

RobotDescription point_foot_robot() {
  RobotDescription robot = anymal_b();
  for (LegDescription& leg : robot.legs) leg.foot_radius = 0.0;
  return robot;
}

TEST(SupportDynamics, gives_the_multipliers_of_the_constrained_forward_dynamics) {
  RobotModel model(anymal_b());
  SupportDynamics support;
  Random random(10);
  for (const PerLeg<bool>& contacts : all_contact_sets()) {
    const MotionPlan plan = plan_with_contacts(contacts);
    const Dynamics& dynamics =
        model.update(random.standing_state(model.description().q_nominal), kUp);
    support.update(dynamics, plan);
    EXPECT_EQ(support.rank(), 3 * plan.num_contacts());
    const test::ForwardDynamics expected =
        test::forward_dynamics(dynamics, plan, random_torque(random));
    const VecX lambda = support.Lambda() * expected.x + support.lambda_0();
    EXPECT_LT((lambda - expected.lambda).norm(), 1e-7 * (1.0 + expected.lambda.norm()));
  }
}

TEST(SupportDynamics, numbers_the_forces_by_leg_and_gives_none_to_legs_in_the_air) {
  RobotModel model(anymal_b());
  SupportDynamics support;
  Random random(11);
  const VecX x = VecX::Ones(kNumUnknowns);
  for (const PerLeg<bool>& contacts : all_contact_sets()) {
    const MotionPlan plan = plan_with_contacts(contacts);
    support.update(model.update(random.standing_state(model.description().q_nominal), kUp), plan);
    const VecX lambda = support.Lambda() * x + support.lambda_0();
    VecX by_leg = VecX::Zero(3 * plan.num_contacts());
    Vec3 in_the_air = Vec3::Zero();
    Eigen::Index next = 0;
    for (const Leg leg : kLegs) {
      EXPECT_EQ(support.in_contact(leg), plan.contact(leg));
      if (plan.contact(leg)) {
        by_leg.segment<3>(next) = support.force(leg, x);
        next += 3;
      } else {
        in_the_air += support.force(leg, x).cwiseAbs();
      }
    }
    EXPECT_LT((by_leg - lambda).norm(), 1e-9 * (1.0 + lambda.norm()));
    EXPECT_EQ(in_the_air, Vec3::Zero());
  }
}

TEST(SupportDynamics, leaves_a_basis_of_all_motions_that_no_contact_force_acts_on) {
  RobotModel model(anymal_b());
  SupportDynamics support;
  Random random(12);
  for (const PerLeg<bool>& contacts : all_contact_sets()) {
    const MotionPlan plan = plan_with_contacts(contacts);
    const Dynamics& dynamics =
        model.update(random.standing_state(model.description().q_nominal), kUp);
    support.update(dynamics, plan);
    const MatX Q_u = support.Q_u();
    EXPECT_EQ(Q_u.cols(), kNumVelocities - 3 * plan.num_contacts());
    EXPECT_LT((Q_u.transpose() * Q_u - MatX::Identity(Q_u.cols(), Q_u.cols())).norm(), 1e-12);
    EXPECT_LT((stacked_jacobians(dynamics, plan) * Q_u).norm(), 1e-12);
  }
}

TEST(SupportDynamics, sees_the_lost_rank_of_straight_legs) {
  RobotModel model(point_foot_robot());
  SupportDynamics support;
  const Dynamics& dynamics = model.update(straight_legged_state(), kUp);
  const MotionPlan plan = plan_with_contacts({true, true, true, true});
  support.update(dynamics, plan);
  EXPECT_EQ(support.rank(), 11);
  const MatX Q_u = support.Q_u();
  EXPECT_EQ(Q_u.cols(), 7);
  EXPECT_LT((stacked_jacobians(dynamics, plan) * Q_u).norm(), 1e-9);
}

TEST(SupportDynamics, gives_the_forces_of_least_norm_where_they_are_not_unique) {
  RobotModel model(point_foot_robot());
  SupportDynamics support;
  const Dynamics& dynamics = model.update(straight_legged_state(), kUp);
  const MotionPlan plan = plan_with_contacts({true, true, true, true});
  support.update(dynamics, plan);
  const MatX J_s = stacked_jacobians(dynamics, plan);
  Random random(13);
  for (int trial = 0; trial < 20; ++trial) {
    // Any forces, and accelerations that go with them.
    const VecX forces = VecX::NullaryExpr(12, [&] { return random.uniform(-100.0, 100.0); });
    const VecX x = test::accelerated_by(dynamics, plan, random_torque(random), forces);
    const VecX least = test::least_squares(J_s.transpose(), J_s.transpose() * forces);
    const VecX lambda = support.Lambda() * x + support.lambda_0();
    EXPECT_LT((lambda - least).norm(), 1e-6 * (1.0 + least.norm()));
    EXPECT_LT(lambda.norm(), forces.norm());
  }
}

}  // namespace
}  // namespace surefoot::model
