#include "surefoot/model/body_tree.hpp"
#include "surefoot/model/leg_jacobian.hpp"
#include "surefoot/model/robot_model.hpp"
#include "surefoot/model/urdf.hpp"
#include "tests/support/anymal_b.hpp"
#include "tests/support/random_motion.hpp"

#include <gtest/gtest.h>

namespace surefoot::model {
namespace {

using test::anymal_b;
using test::Random;

/// Angles in which the leg's knee is bent to the side of the X-configuration by 0.3 to 2 rad.
Vec3 bent_knee(Random& random, Leg leg) {
  const double straight = std::atan2(0.1, 0.298);
  const double end = is_front(leg) ? 1.0 : -1.0;
  const double knee = straight - random.uniform(0.3, 2.0);
  return {random.uniform(-0.6, 0.6), end * random.uniform(-0.2, 1.2), end * knee};
}

TEST(LegKinematics, agree_with_the_whole_body) {
  RobotModel model(anymal_b());
  const BodyTree tree =
      make_body_tree(model.description(), read_urdf(model.description().urdf_path));
  Random random(90);
  for (int trial = 0; trial < 20; ++trial) {
    const RobotState state = random.state();
    const Dynamics& dynamics = model.update(state, Vec3::UnitZ());
    const Mat3 R_WB = state.R_WB();
    for (const Leg leg : kLegs) {
      const Vec3 q = state.q.segment<3>(first_joint(leg));
      const Vec3 foot = state.p_WB + R_WB * model.foot_in_base(leg, q);
      const Vec3 hip = state.p_WB + R_WB * model.hip_in_base(leg, q);
      EXPECT_LT((foot - dynamics.foot[index(leg)].p).norm(), 1e-12);
      EXPECT_LT((hip - dynamics.hip[index(leg)].p).norm(), 1e-12);
      Mat3 J;
      (void)tree.legs[index(leg)].chain.foot_in_base(q, &J);
      EXPECT_LT((R_WB * J - leg_jacobian(dynamics.foot[index(leg)], leg)).norm(), 1e-12);
    }
  }
}

TEST(LegChain, ALongerLegEndsElsewhere) {
  const RobotDescription robot = anymal_b();
  const BodyTree tree = make_body_tree(robot, read_urdf(robot.urdf_path));
  Random random(92);
  for (int trial = 0; trial < 20; ++trial) {
    for (const Leg leg : kLegs) {
      const LegChain& chain = tree.legs[index(leg)].chain;
      const Vec3 q = bent_knee(random, leg);
      const Vec2 longer(random.uniform(-0.02, 0.02), random.uniform(-0.02, 0.02));
      const Vec3 moved = chain.lengthened(longer[0], longer[1]).foot_in_base(q);
      const auto directions = chain.lengthening_in_base(q);
      EXPECT_LT((moved - chain.foot_in_base(q) - directions * longer).norm(), 1e-14);
      EXPECT_NEAR(directions.col(0).norm(), 1.0, 1e-12);
      EXPECT_NEAR(directions.col(1).norm(), 1.0, 1e-12);
    }
  }
}

TEST(LegChain, LengthsAreThoseOfTheWholeBodyToo) {
  const RobotDescription robot = anymal_b();
  const BodyTree tree = make_body_tree(robot, read_urdf(robot.urdf_path));
  RobotModel model(robot);
  KinematicErrors longer;
  longer.thigh = {0.01, -0.008, 0.003, 0.006};
  longer.shank = {-0.004, 0.01, 0.009, -0.01};
  model.set_leg_lengths(longer);
  Random random(93);
  const RobotState state = random.state();
  const Dynamics dynamics = model.update(state, Vec3::UnitZ());
  const RobotState later = test::moved(state, state.u(), 1e-6);
  const Dynamics moved = model.update(later, Vec3::UnitZ());
  for (const Leg leg : kLegs) {
    const std::size_t k = index(leg);
    const Vec3 foot = tree.legs[k]
                          .chain.lengthened(longer.thigh[k], longer.shank[k])
                          .foot_in_base(state.q.segment<3>(first_joint(leg)));
    EXPECT_LT((dynamics.foot[k].p - state.p_WB - state.R_WB() * foot).norm(), 1e-12);
    EXPECT_LT((dynamics.foot[k].v - dynamics.foot[k].J * state.u()).norm(), 1e-12);
    EXPECT_LT(((moved.foot[k].p - dynamics.foot[k].p) / 1e-6 - dynamics.foot[k].v).norm(), 1e-4);
  }
  model.set_leg_lengths(KinematicErrors{});
  EXPECT_EQ(model.update(state, Vec3::UnitZ()).foot[0].p,
            RobotModel(robot).update(state, Vec3::UnitZ()).foot[0].p);
}

TEST(InverseKinematics, finds_the_angles_on_the_guess_side_of_the_knee) {
  const RobotModel model(anymal_b());
  Random random(91);
  for (int trial = 0; trial < 500; ++trial) {
    for (const Leg leg : kLegs) {
      const Vec3 q = bent_knee(random, leg);
      const Vec3 guess = model.description().q_nominal.segment<3>(first_joint(leg));
      Vec3 found;
      ASSERT_TRUE(model.inverse_kinematics(leg, model.foot_in_base(leg, q), guess, found));
      EXPECT_LT((found - q).norm(), 1e-4) << q.transpose() << " | " << found.transpose();
    }
  }
}

TEST(InverseKinematics, gives_the_mirrored_knee_for_a_mirrored_guess) {
  const RobotModel model(anymal_b());
  const Vec3 backward(0.0, 0.4, -0.8);
  const Vec3 p = model.foot_in_base(Leg::LF, backward);
  Vec3 q;
  ASSERT_TRUE(model.inverse_kinematics(Leg::LF, p, Vec3(0.0, -0.5, 1.2), q));
  EXPECT_LT((model.foot_in_base(Leg::LF, q) - p).norm(), 1e-6);
  EXPECT_GT(q[2], std::atan2(0.1, 0.298));
}

TEST(InverseKinematics, says_when_a_point_is_out_of_reach_and_comes_as_close_as_it_can) {
  const RobotModel model(anymal_b());
  const Vec3 guess = model.description().q_nominal.head<3>();
  const Vec3 direction(0.1, 0.1, -1.0);
  const Vec3 hip = model.hip_in_base(Leg::LF, Vec3::Zero());
  Vec3 q;
  EXPECT_FALSE(model.inverse_kinematics(Leg::LF, hip + 2.0 * direction, guess, q));
  EXPECT_TRUE(q.allFinite());
  // A straight leg that points there; the foot stands 0.089 m outside of the hip's frame.
  const Vec3 foot = model.foot_in_base(Leg::LF, q);
  const double straight = std::hypot(0.25 + std::hypot(0.1, 0.298), 0.089);
  EXPECT_NEAR((foot - model.hip_in_base(Leg::LF, q)).norm(), straight, 1e-4);
  EXPECT_LT((foot - hip).normalized().cross(direction.normalized()).norm(), 0.15);
}

TEST(InverseKinematics, refuses_a_point_that_is_not_finite) {
  const RobotModel model(anymal_b());
  Vec3 q;
  EXPECT_FALSE(
      model.inverse_kinematics(Leg::RH, Vec3::Constant(std::nan("")), Vec3(0.0, -0.4, 0.8), q));
}

}  // namespace
}  // namespace surefoot::model
