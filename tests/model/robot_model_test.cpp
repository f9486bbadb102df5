#include "surefoot/model/robot_model.hpp"

#include "surefoot/math/rotation.hpp"
#include "tests/model/mujoco_reference.hpp"
#include "tests/support/anymal_b.hpp"
#include "tests/support/random_motion.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace surefoot::model {
namespace {

using test::anymal_b;
using test::moved;
using test::MujocoReference;
using test::Random;

constexpr int kTrials = 50;
const Vec3 kUp = Vec3::UnitZ();

template <typename A, typename B>
double difference(const A& a, const B& b) {
  return (a - b).norm() / std::max(1.0, b.norm());
}

void expect_same(const PointKinematics& ours, const PointKinematics& theirs,
                 const std::string& what) {
  SCOPED_TRACE(what);
  EXPECT_LT(difference(ours.p, theirs.p), 1e-9);
  EXPECT_LT(difference(ours.v, theirs.v), 1e-9);
  EXPECT_LT(difference(ours.J, theirs.J), 1e-9);
  EXPECT_LT(difference(ours.Jdot_u, theirs.Jdot_u), 1e-9);
}

void expect_same(const RotationKinematics& ours, const RotationKinematics& theirs,
                 const std::string& what) {
  SCOPED_TRACE(what);
  EXPECT_LT(difference(ours.R, theirs.R), 1e-9);
  EXPECT_LT(difference(ours.w, theirs.w), 1e-9);
  EXPECT_LT(difference(ours.J, theirs.J), 1e-9);
  EXPECT_LT(difference(ours.Jdot_u, theirs.Jdot_u), 1e-9);
}

/// Calls check(dynamics, state) at random states.
template <typename Check>
void at_random_states(RobotModel& model, unsigned seed, const Check& check) {
  Random random(seed);
  for (int trial = 0; trial < kTrials; ++trial) {
    SCOPED_TRACE("trial " + std::to_string(trial));
    const RobotState state = random.state();
    check(model.update(state, kUp), state);
  }
}

/// (f(t + e) − f(t − e)) / 2e along the motion with constant u.
template <typename Function>
auto derivative(RobotModel& model, const RobotState& state, const Vec3& normal,
                const Function& function) {
  constexpr double kStep = 1e-6;
  const auto after = function(model.update(moved(state, state.u(), kStep), normal));
  const auto before = function(model.update(moved(state, state.u(), -kStep), normal));
  return ((after - before) / (2.0 * kStep)).eval();
}

TEST(RobotModel, has_the_mass_matrix_and_bias_forces_of_an_independent_implementation) {
  RobotModel model(anymal_b());
  MujocoReference reference(anymal_b());
  EXPECT_NEAR(model.mass(), reference.mass(), 1e-9);
  at_random_states(model, 1, [&](const Dynamics& dynamics, const RobotState& state) {
    reference.set_state(state);
    EXPECT_LT(difference(dynamics.M, reference.mass_matrix()), 1e-9);
    EXPECT_LT(difference(dynamics.h, reference.bias()), 1e-9);
    EXPECT_EQ(dynamics.M, dynamics.M.transpose());
  });
}

TEST(RobotModel, has_of_each_leg_what_its_links_have_to_do_with_its_joints) {
  RobotModel model(anymal_b());
  at_random_states(model, 5, [&](const Dynamics& now, const RobotState& state) {
    const Dynamics dynamics = now;
    for (const Leg leg : kLegs) {
      const std::size_t k = index(leg);
      const int first = 6 + first_joint(leg);
      const Vec3 momentum = dynamics.links[k].momentum.rowwise().sum();
      EXPECT_LT(difference(momentum, (dynamics.M * dynamics.u).segment<3>(first).eval()), 1e-9);
      const Vec3 rate =
          derivative(model, state, kUp, [k](const Dynamics& d) { return d.links[k].momentum; })
              .rowwise()
              .sum();
      const Vec3 torque = rate - dynamics.links[k].free_rate.rowwise().sum();
      EXPECT_LT(difference(torque, dynamics.h.segment<3>(first).eval()), 1e-5);
      EXPECT_TRUE(dynamics.links[k].momentum.isUpperTriangular(0.0))
          << "a link moves no joint behind it";
    }
  });
}

TEST(RobotModel, has_the_points_jacobians_and_drifts_of_an_independent_implementation) {
  const RobotDescription robot = anymal_b();
  RobotModel model(robot);
  MujocoReference reference(robot);
  at_random_states(model, 2, [&](const Dynamics& dynamics, const RobotState& state) {
    reference.set_state(state);
    expect_same(dynamics.base, reference.point(robot.base_link, Vec3::Zero()), "base");
    expect_same(dynamics.base_rotation, reference.rotation(robot.base_link), "base rotation");
    expect_same(dynamics.com, reference.com(), "centre of mass");
    for (const Leg leg : kLegs) {
      const LegDescription& parts = robot.legs[index(leg)];
      const std::string name(kLegNames[index(leg)]);
      expect_same(dynamics.hip[index(leg)], reference.point(parts.hip_frame, Vec3::Zero()),
                  name + " hip");
      expect_same(dynamics.foot[index(leg)], reference.point(parts.foot_frame, parts.foot_center),
                  name + " foot");
      expect_same(dynamics.shank[index(leg)], reference.rotation(parts.shank_link),
                  name + " shank");
    }
  });
}

TEST(RobotModel, has_the_contact_point_of_a_sphere_that_rolls_on_the_terrain) {
  const RobotDescription robot = anymal_b();
  RobotModel model(robot);
  MujocoReference reference(robot);
  Random random(3);
  for (int trial = 0; trial < kTrials; ++trial) {
    const RobotState state = random.state();
    const Vec3 normal = random.small_rotation(0.5) * kUp;
    const Dynamics& dynamics = model.update(state, normal);
    reference.set_state(state);
    for (const Leg leg : kLegs) {
      const PointKinematics& contact = dynamics.contact[index(leg)];
      const Vec3 lever = -robot.legs[index(leg)].foot_radius * normal;
      EXPECT_LT(difference(contact.p, dynamics.foot[index(leg)].p + lever), 1e-12);
      PointKinematics material =
          reference.material_point(robot.legs[index(leg)].shank_link, contact.p);
      const Vec3 w = dynamics.shank[index(leg)].w;
      material.Jdot_u -=
          w.cross(w.cross(lever));  // the point of contact does not turn with the foot
      expect_same(contact, material, std::string(kLegNames[index(leg)]));
    }
  }
}

TEST(RobotModel, has_velocities_that_are_the_rates_of_its_positions) {
  RobotModel model(anymal_b());
  Random random(4);
  for (int trial = 0; trial < 10; ++trial) {
    const RobotState state = random.state();
    const Dynamics dynamics = model.update(state, kUp);
    const auto expect_rate = [&](const Vec3& v, const auto& position) {
      EXPECT_LT(difference(derivative(model, state, kUp, position), v), 1e-8);
    };
    expect_rate(dynamics.com.v, [](const Dynamics& d) { return d.com.p; });
    for (std::size_t k = 0; k < kNumLegs; ++k) {
      expect_rate(dynamics.hip[k].v, [k](const Dynamics& d) { return d.hip[k].p; });
      expect_rate(dynamics.foot[k].v, [k](const Dynamics& d) { return d.foot[k].p; });
    }
  }
}

TEST(RobotModel, has_drifts_that_are_the_rates_of_its_velocities_at_constant_u) {
  RobotModel model(anymal_b());
  Random random(5);
  for (int trial = 0; trial < 10; ++trial) {
    const RobotState state = random.state();
    const Vec3 normal = random.small_rotation(0.5) * kUp;
    const Dynamics d = model.update(state, normal);
    const auto expect_rate = [&](const Vec3& Jdot_u, const auto& velocity) {
      EXPECT_LT(difference(derivative(model, state, normal, velocity), Jdot_u), 1e-7);
    };
    expect_rate(d.base.Jdot_u, [](const Dynamics& x) { return x.base.v; });
    expect_rate(d.base_rotation.Jdot_u, [](const Dynamics& x) { return x.base_rotation.w; });
    expect_rate(d.com.Jdot_u, [](const Dynamics& x) { return x.com.v; });
    for (std::size_t k = 0; k < kNumLegs; ++k) {
      expect_rate(d.hip[k].Jdot_u, [k](const Dynamics& x) { return x.hip[k].v; });
      expect_rate(d.foot[k].Jdot_u, [k](const Dynamics& x) { return x.foot[k].v; });
      expect_rate(d.shank[k].Jdot_u, [k](const Dynamics& x) { return x.shank[k].w; });
      // v of the contact point is that of the lowest point at each instant, so its rate at constant
      // u is the drift of rolling.
      expect_rate(d.contact[k].Jdot_u, [k](const Dynamics& x) { return x.contact[k].v; });
    }
  }
}

TEST(RobotModel, can_be_moved) {
  RobotModel model(anymal_b());
  RobotModel other(std::move(model));
  EXPECT_NEAR(other.mass(), 30.4754, 1e-4);
}

TEST(RobotModel, HasMassFirstMomentAndWeightOfALoadOfTheBase) {
  RobotModel model(anymal_b()), bare(anymal_b());
  const Vec3 at(0.1, -0.05, 0.2);
  constexpr double kLoad = 7.0;
  model.set_base_load({.mass = kLoad, .first_moment = kLoad * at});
  EXPECT_EQ(model.base_mass(), bare.base_mass());
  Random random(13);
  for (int trial = 0; trial < kTrials; ++trial) {
    RobotState state = random.state();
    const Dynamics laden = model.update(state, kUp), unladen = bare.update(state, kUp);
    const Vec3 p = state.p_WB + state.R_WB() * at;
    const Vec3 v = state.v_WB + state.R_WB() * state.w_WB_B.cross(at);
    EXPECT_NEAR(laden.mass, unladen.mass + kLoad, 1e-9);
    EXPECT_LT((laden.mass * laden.com.p - unladen.mass * unladen.com.p - kLoad * p).norm(), 1e-9);
    EXPECT_LT((laden.mass * laden.com.v - unladen.mass * unladen.com.v - kLoad * v).norm(), 1e-9);
    EXPECT_EQ(laden.foot[0].p, unladen.foot[0].p);
    const MassMatrix M = laden.M - unladen.M;
    EXPECT_LT((M.topLeftCorner<3, 3>() - kLoad * Mat3::Identity()).norm(), 1e-9);
    EXPECT_LT((M.block<3, 3>(0, 3) + kLoad * state.R_WB() * skew(at)).norm(), 1e-9);
    EXPECT_LT(M.bottomRows<kNumLegJoints>().norm(), 1e-9);
    state.v_WB.setZero();
    state.w_WB_B.setZero();
    state.qd.setZero();
    const GeneralizedVector h = model.update(state, kUp).h - bare.update(state, kUp).h;
    const Vec3 weight(0.0, 0.0, -kLoad * kGravity);
    EXPECT_LT((h.head<3>() + weight).norm(), 1e-9);
    EXPECT_LT((h.segment<3>(3) + at.cross(state.R_WB().transpose() * weight)).norm(), 1e-9);
  }
  model.set_base_load({});
  const RobotState state = random.state();
  EXPECT_LT((model.update(state, kUp).M - bare.update(state, kUp).M).norm(), 1e-12);
}

TEST(RobotModel, ALoadDoesTheWorkOfAWrenchOnTheBaseAtTheCentreOfMass) {
  RobotModel model(anymal_b());
  Random random(12);
  for (int trial = 0; trial < kTrials; ++trial) {
    const RobotState state = random.state();
    const Dynamics& dynamics = model.update(state, kUp);
    const GeneralizedVector h = dynamics.h;
    const Vec3 force = random.vector(100.0), moment = random.vector(20.0);
    const Vec3 w_W = state.R_WB() * state.w_WB_B;
    const Vec3 v = state.v_WB + w_W.cross(dynamics.com.p - state.p_WB);
    model.apply_wrench(force, moment);
    const double power = force.dot(v) + moment.dot(w_W);
    EXPECT_NEAR((h - dynamics.h).dot(state.u()), power, 1e-9 * (1.0 + std::abs(power)));
    EXPECT_EQ((h - dynamics.h).tail<kNumLegJoints>(), JointVector::Zero(kNumLegJoints));
  }
}

}  // namespace
}  // namespace surefoot::model
