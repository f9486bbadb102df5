// Legs of any number of joints, with soles that bear forces and moments.
#include "surefoot/math/rotation.hpp"
#include "surefoot/model/limb_chain.hpp"
#include "surefoot/model/limb_dynamics.hpp"
#include "surefoot/model/robot_model.hpp"
#include "surefoot/model/support_dynamics.hpp"
#include "tests/support/biped.hpp"
#include "tests/support/random_motion.hpp"

#include <gtest/gtest.h>

namespace surefoot::model {
namespace {

using test::biped;
using test::Random;

const Vec3 kUp = Vec3::UnitZ();

MotionPlan plan_with(std::initializer_list<bool> contacts) {
  MotionPlan plan;
  plan.feet.resize(static_cast<int>(contacts.size()));
  std::size_t leg = 0;
  for (const bool stands : contacts)
    plan.feet[leg++].phase = stands ? LegPhase::stance : LegPhase::swing;
  return plan;
}

TEST(FlatFeet, their_soles_move_as_their_jacobians_say) {
  constexpr double kStep = 1e-6;
  RobotModel model(biped());
  Random random(1);
  for (int trial = 0; trial < 10; ++trial) {
    const RobotState state = random.state_around(model.description().q_nominal);
    const GeneralizedVector u = state.u();
    const Dynamics now = model.update(state, kUp);
    const Dynamics after = model.update(test::moved(state, u, kStep), kUp);
    const Dynamics before = model.update(test::moved(state, u, -kStep), kUp);
    for (const Leg leg : now.contact.legs()) {
      const std::size_t k = index(leg);
      EXPECT_LT((now.contact[k].J * u - now.contact[k].v).norm(), 1e-9);
      EXPECT_LT((now.shank[k].J * u - now.shank[k].w).norm(), 1e-9);
      const Vec3 v = (after.contact[k].p - before.contact[k].p) / (2.0 * kStep);
      const Vec3 turn = box_minus(Quat(after.shank[k].R), Quat(before.shank[k].R));
      EXPECT_LT((v - now.contact[k].v).norm(), 1e-6);
      EXPECT_LT((turn / (2.0 * kStep) - now.shank[k].w).norm(), 1e-6);
      const Vec3 a = (after.contact[k].v - before.contact[k].v) / (2.0 * kStep);
      const Vec3 rate = (after.shank[k].w - before.shank[k].w) / (2.0 * kStep);
      EXPECT_LT((a - now.contact[k].Jdot_u).norm(), 1e-4);
      EXPECT_LT((rate - now.shank[k].Jdot_u).norm(), 1e-4);
    }
  }
}

TEST(FlatFeet, a_limb_chain_has_them_at_the_same_place) {
  const RobotDescription robot = biped();
  RobotModel model(robot);
  const BodyTree tree = make_body_tree(robot, read_urdf(robot));
  Random random(3);
  RobotState state = random.state_around(robot.q_nominal);
  state.p_WB.setZero();
  state.q_WB.setIdentity();
  const Dynamics& dynamics = model.update(state, kUp);
  for (const Leg leg : robot.legs.legs()) {
    const JointRange joints = robot.leg_joints(leg);
    const LimbChain::Pose pose = limb_chain(tree, leg, joints).foot_in_base(state.q);
    const PointKinematics& contact = dynamics.contact[index(leg)];
    EXPECT_LT((pose.p - contact.p).norm(), 1e-12);
    EXPECT_LT((pose.R - dynamics.shank[index(leg)].R).norm(), 1e-12);
    EXPECT_LT((pose.J - contact.J.middleCols(6 + joints.first, joints.count)).norm(), 1e-12);
  }
}

TEST(FlatFeet, their_forces_and_moments_explain_the_motion) {
  RobotModel model(biped());
  SupportDynamics support;
  Random random(4);
  for (const auto& contacts : {std::initializer_list<bool>{true, true}, {true, false}}) {
    const MotionPlan plan = plan_with(contacts);
    const Dynamics& dynamics =
        model.update(random.state_around(model.description().q_nominal), kUp);
    support.update(dynamics, plan);
    EXPECT_EQ(support.rank(), 6 * plan.num_contacts());
    EXPECT_EQ(support.num_forces(), 6 * plan.num_contacts());
    // Any forces and torques, and the motion that they make.
    VecX wrenches(support.num_forces()), torque(dynamics.num_joints());
    for (double& value : wrenches) value = random.uniform(-50.0, 50.0);
    for (double& value : torque) value = random.uniform(-20.0, 20.0);
    VecX forces = -dynamics.h;
    forces.tail(torque.size()) += torque;
    for (const Leg leg : plan.feet.legs()) {
      if (!plan.contact(leg)) continue;
      const int row = support.first_force(leg);
      forces += dynamics.contact[index(leg)].J.transpose() * wrenches.segment<3>(row);
      forces += dynamics.shank[index(leg)].J.transpose() * wrenches.segment<3>(row + 3);
    }
    VecX x(forces.size() + torque.size());
    x << dynamics.M.ldlt().solve(forces), torque;
    EXPECT_LT((support.Lambda() * x + support.lambda_0() - wrenches).norm(), 1e-6);
    const int row = support.first_force(Leg{0});
    EXPECT_LT((support.force(Leg{0}, x) - wrenches.segment<3>(row)).norm(), 1e-6);
    EXPECT_LT((support.moment(Leg{0}, x) - wrenches.segment<3>(row + 3)).norm(), 1e-6);
  }
}

TEST(FlatFeet, a_legs_torques_tell_force_and_moment_apart) {
  RobotModel model(biped());
  Random random(5);
  RobotState state = random.state_around(model.description().q_nominal);
  const Dynamics& dynamics = model.update(state, kUp);
  for (const Leg leg : dynamics.contact.legs()) {
    const auto [first, count] = dynamics.leg_joints[index(leg)];
    LimbDynamics::Vector6 wrench;
    for (double& value : wrench) value = random.uniform(-100.0, 100.0);
    const VecX torque =
        dynamics.contact[index(leg)].J.middleCols(6 + first, count).transpose() * wrench.head<3>() +
        dynamics.shank[index(leg)].J.middleCols(6 + first, count).transpose() * wrench.tail<3>();
    JointVector acceleration = JointVector::Zero(dynamics.num_joints());
    acceleration.segment(first, count) =
        dynamics.M.block(6 + first, 6 + first, count, count).llt().solve(torque);
    const LimbDynamics limb(dynamics, leg);
    EXPECT_LT((limb.wrench(acceleration) - wrench).norm(), 0.05 * wrench.norm());
    // The foot at rest: no force is needed for a motion that keeps it there.
    const LimbDynamics::Joints still = limb.stance_acceleration(LimbDynamics::Vector6::Zero());
    const Vec3 a = dynamics.contact[index(leg)].J.middleCols(6 + first, count) * still +
                   dynamics.contact[index(leg)].Jdot_u;
    EXPECT_LT(a.norm(), 0.05 * (1.0 + dynamics.contact[index(leg)].Jdot_u.norm()));
  }
}

}  // namespace
}  // namespace surefoot::model
