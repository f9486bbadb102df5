#include "surefoot/base/error.hpp"
#include "surefoot/math/rotation.hpp"
#include "surefoot/tasks/body_height_limits.hpp"
#include "surefoot/tasks/joint_position_limits.hpp"
#include "surefoot/tasks/limb_extension_limits.hpp"
#include "surefoot/tasks/motion_bound.hpp"
#include "surefoot/tasks/torso_tilt_limits.hpp"
#include "tests/support/sizes.hpp"
#include "tests/tasks/scene.hpp"

#include <gtest/gtest.h>

#include <functional>

namespace surefoot::tasks {
namespace {

using test::Motion;
using test::plan_with_contacts;
using test::Random;
using test::random_motion;
using test::Rates;
using test::rates;
using test::Scene;
using test::written;
using test::WrittenRows;

using Form = LimbExtensionLimits::Form;

constexpr int kTrials = 20;
constexpr double kTolerance = 2e-4;  // of second differences

/// Checks row i against Eq. 27 on the coordinate's own rates: the distance of A x from each bound
/// is that of r̈ from k (r_bound − r) − d ṙ.
void expect_bounds(const WrittenRows& rows, Eigen::Index i, const Motion& motion, const Rates& r,
                   double r_min, double r_max, double dt) {
  const double stiffness = 2.0 / (dt * dt);
  const double damping = 2.0 / dt;
  VecX x = VecX::Constant(kNumUnknowns, 77.0);
  x.head<kNumVelocities>() = motion.acceleration;
  const double value = rows.A.row(i).dot(x);
  EXPECT_NEAR(rows.lower[i] - value, stiffness * (r_min - r.r) - damping * r.rdot - r.rddot,
              kTolerance);
  EXPECT_NEAR(rows.upper[i] - value, stiffness * (r_max - r.r) - damping * r.rdot - r.rddot,
              kTolerance);
}

TEST(MotionBound, is_a_damped_oscillator_around_its_bound) {
  constexpr double kBoundAt = 0.3;
  constexpr double kDt = 0.1;
  const MotionBound bound(kDt);
  // The bound is active all the time: r̈ is its upper limit. Integrated finely from rest at 0.
  double r = 0.0;
  double v = 0.0;
  double peak = 0.0;
  double time_of_peak = 0.0;
  constexpr double kStep = 1e-5;
  for (int i = 0; i < 100000; ++i) {
    v += kStep * bound.upper(kBoundAt, r, v);
    r += kStep * v;
    time_of_peak = r > peak ? i * kStep : time_of_peak;
    peak = std::max(peak, r);
  }
  // Step response of ω_n = √2/δt, ζ = 1/√2: overshoot exp(−π) = 4.3 %, peak at π/ω_d = π δt.
  EXPECT_NEAR(peak / kBoundAt - 1.0, std::exp(-kPi), 1e-4);
  EXPECT_NEAR(time_of_peak, kPi * kDt, 1e-3);
  EXPECT_NEAR(r, kBoundAt, 1e-4);
}

TEST(MotionBound, without_overshoot_stays_inside) {
  const MotionBound bound(0.1, BoundResponse::no_overshoot);
  double r = 0.0;
  double v = 0.0;
  double peak = 0.0;
  constexpr double kStep = 1e-4;
  for (int i = 0; i < 20000; ++i) {
    v += kStep * bound.upper(0.3, r, v);
    r += kStep * v;
    peak = std::max(peak, r);
  }
  EXPECT_LE(peak, 0.3);
  EXPECT_NEAR(r, 0.3, 1e-6);
}

TEST(MotionBound, refuses_a_time_that_is_not_positive) {
  EXPECT_THROW(MotionBound(0.0), Error);
  EXPECT_THROW(MotionBound(-0.1), Error);
  EXPECT_THROW(MotionBound(std::numeric_limits<double>::quiet_NaN()), Error);
}

TEST(BodyHeightLimits, bound_the_height_above_the_feet_in_contact) {
  Scene scene;
  Random random(60);
  const BodyHeightLimits task({.min = 0.3, .max = 0.5, .dt = 0.2});
  scene.plan = plan_with_contacts({true, false, true, true});
  for (int trial = 0; trial < kTrials; ++trial) {
    const Motion motion = random_motion(random, scene.model.description().q_nominal);
    const model::Dynamics now = scene.model.update(motion.state, Vec3::UnitZ());
    const double footprint = (now.foot[0].p.z() + now.foot[2].p.z() + now.foot[3].p.z()) / 3.0;
    const Rates r =
        rates(scene, motion, [&](const model::Dynamics& d) { return d.base.p.z() - footprint; });
    expect_bounds(written(task, scene.update(motion.state)), 0, motion, r, 0.3, 0.5, 0.2);
  }
  scene.plan = plan_with_contacts({false, false, false, false});
  EXPECT_EQ(written(task, scene.update(random.state())).count(), 0);
}

TEST(LimbExtensionLimits, bound_the_distance_of_every_leg_in_each_form) {
  Scene scene;
  Random random(61);
  scene.plan = plan_with_contacts({true, false, true, true});
  for (int trial = 0; trial < kTrials; ++trial) {
    const Motion motion = random_motion(random, scene.model.description().q_nominal);
    const model::Dynamics now = scene.model.update(motion.state, Vec3::UnitZ());
    for (std::size_t k = 0; k < kNumLegs; ++k) {
      const double still_foot = now.foot[k].p.z();
      const std::map<Form, std::function<double(const model::Dynamics&)>> coordinates{
          {Form::paper, [=](const model::Dynamics& d) { return d.hip[k].p.z() - still_foot; }},
          {Form::relative,
           [=](const model::Dynamics& d) { return d.hip[k].p.z() - d.foot[k].p.z(); }},
          {Form::radial,
           [=](const model::Dynamics& d) { return (d.hip[k].p - d.foot[k].p).norm(); }}};
      for (const auto& [form, coordinate] : coordinates) {
        const Rates r = rates(scene, motion, coordinate);
        const LimbExtensionLimits task({.form = form, .min = 0.2, .max = 0.5, .dt = 0.1});
        const WrittenRows rows = written(task, scene.update(motion.state));
        ASSERT_EQ(rows.count(), kNumLegs);
        expect_bounds(rows, static_cast<Eigen::Index>(k), motion, r, 0.2, 0.5, 0.1);
      }
    }
  }
}

/// Steady excess of z_H − z_F over its bound while a foot goes down at v and the hip follows with
/// the acceleration that the active bound asks for.
double steady_violation(Form form, double v) {
  constexpr double kMax = 0.5;
  constexpr double kTick = 1e-4;
  Scene scene;
  const LimbExtensionLimits task({.form = form, .min = 0.1, .max = kMax, .dt = 0.1});
  RobotState state = Random(62).standing_state(scene.model.description().q_nominal);
  TaskInput input = scene.update(state);
  model::Dynamics dynamics = input.dynamics;  // hip and foot of LF are moved by hand
  const TaskInput moved{dynamics, scene.plan, scene.support, scene.model.description()};
  model::PointKinematics& hip = dynamics.hip[0];
  model::PointKinematics& foot = dynamics.foot[0];
  hip.v.setZero();
  hip.Jdot_u.setZero();
  foot.Jdot_u.setZero();
  foot.v = Vec3(0.0, 0.0, -v);
  foot.p = hip.p - kMax * Vec3::UnitZ();
  for (int tick = 0; tick < 20000; ++tick) {
    // The row bounds z̈_H (− z̈_F, which is zero).
    hip.v.z() += kTick * written(task, moved).upper[0];
    hip.p += kTick * hip.v;
    foot.p += kTick * foot.v;
  }
  return hip.p.z() - foot.p.z() - kMax;
}

TEST(LimbExtensionLimits, lag_behind_a_moving_foot_only_in_the_form_of_the_paper) {
  EXPECT_NEAR(steady_violation(Form::paper, 0.1), 0.1 * 0.1, 1e-4);
  EXPECT_NEAR(steady_violation(Form::relative, 0.1), 0.0, 1e-4);
}

TEST(LimbExtensionLimits, stay_finite_where_a_leg_has_no_length) {
  Scene scene;
  const TaskInput input =
      scene.update(Random(63).standing_state(scene.model.description().q_nominal));
  model::Dynamics dynamics = input.dynamics;
  dynamics.foot[2].p = dynamics.hip[2].p;
  const WrittenRows rows =
      written(LimbExtensionLimits({.form = Form::radial}),
              {dynamics, scene.plan, scene.support, scene.model.description()});
  EXPECT_TRUE(rows.A.allFinite());
  EXPECT_TRUE(rows.lower.allFinite());
  EXPECT_TRUE(rows.upper.allFinite());
}

TEST(JointPositionLimits, bound_every_joint_inside_its_range) {
  Scene scene;
  Random random(64);
  JointPositionLimits task({.margin = 0.1, .dt = 0.1, .response = BoundResponse::paper});
  const model::RobotDescription& robot = scene.model.description();
  task.prepare(robot);
  for (int trial = 0; trial < kTrials; ++trial) {
    const Motion motion = random_motion(random, robot.q_nominal);
    for (int j = 0; j < kNumLegJoints; ++j) {
      const Rates r = rates(scene, motion, [&](const model::Dynamics& d) { return d.q[j]; });
      const WrittenRows rows = written(task, scene.update(motion.state));
      expect_bounds(rows, j, motion, r, robot.q_min[j] + 0.1, robot.q_max[j] - 0.1, 0.1);
    }
  }
}

TEST(JointPositionLimits, stay_consistent_where_the_margins_are_wider_than_the_range) {
  Scene scene;
  const TaskInput input = scene.update(Random(65).state());
  JointPositionLimits task({.margin = 10.0});
  task.prepare(scene.model.description());
  const WrittenRows rows = written(task, input);
  EXPECT_EQ(rows.count(), kNumLegJoints);
  EXPECT_TRUE((rows.lower.array() <= rows.upper.array()).all());
}

TEST(TorsoTiltLimits, bound_the_sines_of_pitch_and_roll) {
  Scene scene;
  Random random(66);
  const TorsoTiltLimits task({.max_roll = 0.3, .max_pitch = 0.4, .dt = 0.1});
  for (int trial = 0; trial < kTrials; ++trial) {
    scene.plan.R_WC = random.small_rotation(0.5).toRotationMatrix();
    const double heading = yaw(scene.plan.R_WC);
    const Motion motion = random_motion(random, scene.model.description().q_nominal);
    const Vec3 forward(std::cos(heading), std::sin(heading), 0.0);
    const Vec3 left(-std::sin(heading), std::cos(heading), 0.0);
    const Rates pitch = rates(scene, motion, [&](const model::Dynamics& d) {
      return forward.dot(d.base_rotation.R.col(2));
    });
    const Rates roll = rates(scene, motion, [&](const model::Dynamics& d) {
      return left.dot(d.base_rotation.R.col(2));
    });
    const WrittenRows rows = written(task, scene.update(motion.state));
    expect_bounds(rows, 0, motion, pitch, -std::sin(0.4), std::sin(0.4), 0.1);
    expect_bounds(rows, 1, motion, roll, -std::sin(0.3), std::sin(0.3), 0.1);
  }
}

TEST(TorsoTiltLimits, give_way_to_no_lean_and_push_back_a_large_one) {
  Scene scene;
  RobotState state = Random(67).standing_state(scene.model.description().q_nominal);
  state.w_WB_B.setZero();
  state.v_WB.setZero();
  state.qd.setZero();
  const TorsoTiltLimits task({.max_roll = 0.3, .max_pitch = 0.3});
  const VecX at_rest = VecX::Zero(kNumUnknowns);
  state.q_WB = Quat::Identity();
  const WrittenRows upright = written(task, scene.update(state));
  EXPECT_TRUE((upright.lower.array() < 0.0).all() && (upright.upper.array() > 0.0).all());
  state.q_WB = exp_rotation(Vec3(0.0, 0.5, 0.0));  // nose down
  const WrittenRows nose_down = written(task, scene.update(state));
  EXPECT_LT(nose_down.upper[0], 0.0);
  // Turning the nose up again is about −y, and makes the row's value negative.
  EXPECT_LT(nose_down.A(0, 4) * -1.0, 0.0);
}

TEST(Limits, refuse_options_that_make_no_sense) {
  EXPECT_THROW(BodyHeightLimits({.min = 0.5, .max = 0.5}), Error);
  EXPECT_THROW(BodyHeightLimits({.min = 0.3, .max = 0.5, .dt = 0.0}), Error);
  EXPECT_THROW(LimbExtensionLimits({.min = -0.1}), Error);
  EXPECT_THROW(LimbExtensionLimits({.min = 0.6, .max = 0.5}), Error);
  EXPECT_THROW(JointPositionLimits({.margin = -0.1}), Error);
  EXPECT_THROW(TorsoTiltLimits({.max_roll = 0.0}), Error);
  EXPECT_THROW(TorsoTiltLimits({.max_pitch = 2.0}), Error);
}

}  // namespace
}  // namespace surefoot::tasks
