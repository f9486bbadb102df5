#include "surefoot/base/error.hpp"
#include "surefoot/math/rotation.hpp"
#include "surefoot/tasks/contact_force_minimisation.hpp"
#include "surefoot/tasks/equations_of_motion.hpp"
#include "surefoot/tasks/friction_cone.hpp"
#include "surefoot/tasks/no_contact_motion.hpp"
#include "surefoot/tasks/torque_limits.hpp"
#include "surefoot/tasks/torque_minimisation.hpp"
#include "tests/support/forward_dynamics.hpp"
#include "tests/support/linear_algebra.hpp"
#include "tests/support/sizes.hpp"
#include "tests/tasks/scene.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace surefoot::tasks {
namespace {

using test::all_contact_sets;
using test::plan_with_contacts;
using test::Random;
using test::random_torque;
using test::Scene;
using test::stacked;
using test::straight_legged_state;
using test::written;
using test::WrittenRows;

/// Of a robot that stands, nearly.
TaskInput stand(Scene& scene, Random& random) {
  return scene.update(random.standing_state(scene.model.description().q_nominal));
}
TaskInput stand(Scene& scene, Random&& random) { return stand(scene, random); }

/// Accelerations and torques, with the contact forces that go with them.
VecX forward_dynamics(const TaskInput& input, const JointVector& torque) {
  return test::forward_dynamics(input.dynamics, input.plan, torque).x;
}

const EquationsOfMotion kEquationsOfMotion;

TEST(EquationsOfMotion, and_no_contact_motion_together_are_the_constrained_forward_dynamics) {
  Scene scene;
  Random random(20);
  const NoContactMotion no_contact_motion({.kd = 0.0});
  for (const PerLeg<bool>& contacts : all_contact_sets()) {
    scene.plan = plan_with_contacts(contacts);
    const TaskInput input = stand(scene, random);
    const WrittenRows rows = stacked({&kEquationsOfMotion, &no_contact_motion}, input);
    ASSERT_EQ(rows.count(), kNumVelocities);
    // With torques given, both tasks leave one acceleration: that of forward dynamics.
    const VecX x = forward_dynamics(input, random_torque(random));
    const VecX residual = rows.A * x - rows.lower;
    EXPECT_LT(residual.norm(), 1e-8 * (1.0 + rows.lower.norm()));
    EXPECT_EQ(test::rank(rows.A.leftCols<kNumVelocities>()), kNumVelocities);
    EXPECT_EQ(test::rank(rows.A), kNumVelocities) << "twelve degrees of freedom are left";
  }
}

TEST(EquationsOfMotion, hold_with_straight_legs_where_the_contacts_lose_rank) {
  model::RobotDescription robot = test::anymal_b();
  for (model::LegDescription& leg : robot.legs) leg.foot_radius = 0.0;
  model::RobotModel model(robot);
  model::SupportDynamics support;
  const MotionPlan plan = plan_with_contacts({true, true, true, true});
  const model::Dynamics& dynamics = model.update(straight_legged_state(), Vec3::UnitZ());
  support.update(dynamics, plan);
  const TaskInput input{dynamics, plan, support, model.description()};
  const WrittenRows rows = written(kEquationsOfMotion, input);
  EXPECT_EQ(rows.count(), 7);
  // Whatever the contact forces are, the accelerations that they make obey the rows.
  Random random(22);
  for (int trial = 0; trial < 10; ++trial) {
    const VecX forces = VecX::NullaryExpr(12, [&] { return random.uniform(-100.0, 100.0); });
    const VecX x = test::accelerated_by(dynamics, plan, random_torque(random), forces);
    EXPECT_LT((rows.A * x - rows.lower).norm(), 1e-7 * rows.lower.norm());
  }
}

TEST(NoContactMotion, damps_the_velocity_of_the_contact_points) {
  Scene scene;
  Random random(23);
  scene.plan = plan_with_contacts({true, false, true, true});
  const TaskInput input = stand(scene, random);
  const WrittenRows still = written(NoContactMotion({.kd = 0.0}), input);
  const WrittenRows damped = written(NoContactMotion({.kd = 7.0}), input);
  EXPECT_EQ(still.ids, (std::vector<int>{0, 1, 2, 6, 7, 8, 9, 10, 11}));
  EXPECT_TRUE(damped.A == still.A);
  VecX velocity(9);
  velocity << input.dynamics.contact[0].v, input.dynamics.contact[2].v, input.dynamics.contact[3].v;
  EXPECT_LT((damped.lower - (still.lower - 7.0 * velocity)).norm(), 1e-12);
  EXPECT_TRUE(damped.upper == damped.lower);
}

TEST(FrictionCone, agrees_with_a_direct_check_of_the_contact_forces) {
  Scene scene;
  Random random(24);
  int inside = 0;
  int outside = 0;
  for (const FrictionCone::Pyramid pyramid :
       {FrictionCone::Pyramid::inner, FrictionCone::Pyramid::outer}) {
    const FrictionCone task({.pyramid = pyramid});
    const double inner = pyramid == FrictionCone::Pyramid::inner ? std::numbers::sqrt2 / 2.0 : 1.0;
    for (const PerLeg<bool>& contacts : all_contact_sets()) {
      scene.plan = plan_with_contacts(contacts);
      for (FootPlan& foot : scene.plan.feet) foot.friction = random.uniform(0.2, 0.8);
      scene.plan.R_WC = random.small_rotation(0.06).toRotationMatrix();
      const TaskInput input = stand(scene, random);
      const WrittenRows rows = written(task, input);
      const VecX x = forward_dynamics(input, random_torque(random));
      const VecX value = rows.A * x;
      Eigen::Index row = 0;
      for (const Leg leg : kLegs) {
        if (!scene.plan.contact(leg)) continue;
        const Vec3 f = scene.plan.R_WC.transpose() * scene.support.force(leg, x);
        const double reach = inner * scene.plan.feet[index(leg)].friction * f.z();
        const std::array<double, 4> faces{f.x() - reach, -f.x() - reach, f.y() - reach,
                                          -f.y() - reach};
        for (const double face : faces) {
          EXPECT_NEAR(value[row] - rows.upper[row], face, 1e-6);
          EXPECT_EQ(rows.lower[row], -std::numeric_limits<double>::infinity());
          face <= 0.0 ? ++inside : ++outside;
          ++row;
        }
        EXPECT_NEAR(value[row] - rows.lower[row], f.z() - 10.0, 1e-6);
        EXPECT_NEAR(rows.upper[row] - value[row], 250.0 - f.z(), 1e-6);
        ++row;
      }
      EXPECT_EQ(row, rows.count());
    }
  }
  EXPECT_GT(inside, 50);
  EXPECT_GT(outside, 50);
}

TEST(FrictionCone, says_what_share_of_the_pyramid_that_it_writes_a_force_uses) {
  Scene scene;
  Random random(30);
  for (const auto pyramid : {FrictionCone::Pyramid::inner, FrictionCone::Pyramid::outer}) {
    for (const auto axes : {FrictionCone::Axes::control, FrictionCone::Axes::gravity}) {
      const FrictionCone task({.pyramid = pyramid, .axes = axes});
      for (const double lean : {0.0, 0.1, 0.3, 0.6}) {  // the last exceeds friction
        scene.plan.R_WC = Eigen::AngleAxisd(lean, Vec3(0.6, -0.8, 0.0)) *
                          rotation_about_z(random.uniform(-3.0, 3.0));
        for (FootPlan& foot : scene.plan.feet) foot.friction = random.uniform(0.1, 0.8);
        const TaskInput input = stand(scene, random);
        const WrittenRows rows = written(task, input);
        const VecX x = forward_dynamics(input, random_torque(random));
        const VecX beyond = rows.A * x - rows.upper;
        for (const Leg leg : kLegs) {
          const Vec3 force = scene.support.force(leg, x);
          const FrictionPyramid holds = task.pyramid(scene.plan, leg);
          const double reach = holds.mu * holds.normal().dot(force);
          const auto first = FrictionCone::kRowsPerLeg * static_cast<Eigen::Index>(leg);
          EXPECT_NEAR((holds.use(force) - 1.0) * reach, beyond.segment<4>(first).maxCoeff(), 1e-6);
        }
      }
    }
  }
}

/// A pyramid about a normal that leans by `lean`, with friction μ under each foot.
WrittenRows leaning_pyramids(Scene& scene, double lean, double mu) {
  scene.plan = plan_with_contacts(all_contact_sets().back());
  for (FootPlan& foot : scene.plan.feet) foot.friction = mu;
  scene.plan.R_WC = Eigen::AngleAxisd(lean, Vec3(0.6, -0.8, 0.0)).toRotationMatrix();
  Random random(25);
  return written(FrictionCone({}), stand(scene, random));
}

// A foot that slid has less assumed friction than the slope is steep: about the slope's normal no
// force could carry the robot.
TEST(FrictionCone, lets_feet_carry_on_ground_that_is_steeper_than_their_friction) {
  for (const double lean : {0.1, 0.2, 0.3, 0.4}) {
    for (const double mu : {0.1, 0.2, 0.35, 0.6}) {
      Scene scene;
      const WrittenRows rows = leaning_pyramids(scene, lean, mu);
      VecX upward(3 * kNumLegs);
      for (Eigen::Index k = 0; k < kNumLegs; ++k) upward.segment<3>(3 * k) = Vec3(0.0, 0.0, 50.0);
      const VecX x = test::least_squares(scene.support.Lambda(), upward - scene.support.lambda_0());
      for (Eigen::Index row = 0; row < rows.count(); ++row) {
        EXPECT_LT((rows.A * x)[row], rows.upper[row]) << lean << " rad, " << mu;
      }
    }
  }
}

TEST(FrictionCone, is_about_the_normal_where_a_foot_can_stand_on_it) {
  Scene scene, level;
  const WrittenRows there = leaning_pyramids(scene, 0.2, 0.5);
  const WrittenRows almost = leaning_pyramids(level, 0.2, 0.29);
  EXPECT_GT((there.A - almost.A).norm(), 0.0);
  const Vec3 normal = scene.plan.R_WC.col(2);
  const auto along = [&](const WrittenRows& rows) {  // n̂ᵀΛ of the first foot
    const MatX along_normal = normal.transpose() * scene.support.Lambda().topRows<3>();
    return (rows.A.row(4) - along_normal).norm();
  };
  EXPECT_LT(along(there), 1e-9);
  EXPECT_GT(along(almost), 1e-3);
}

TEST(FrictionCone, lies_inside_the_round_cone_or_around_it) {
  Scene scene;
  Random random(25);
  const TaskInput input = stand(scene, random);
  const WrittenRows inner = written(FrictionCone({FrictionCone::Pyramid::inner}), input);
  const WrittenRows outer = written(FrictionCone({FrictionCone::Pyramid::outer}), input);
  const double mu = scene.plan.feet[0].friction;
  const MatX Lambda = scene.support.Lambda();
  const VecX lambda_0 = scene.support.lambda_0();
  for (int trial = 0; trial < 200; ++trial) {
    // Forces on the round cone; an x that makes them.
    VecX forces(12);
    for (int i = 0; i < 4; ++i) {
      const double angle = random.uniform(0.0, 2.0 * kPi);
      forces.segment<3>(3 * i) = 50.0 * Vec3(mu * std::cos(angle), mu * std::sin(angle), 1.0);
    }
    const VecX x = test::least_squares(Lambda, forces - lambda_0);
    EXPECT_TRUE(((outer.A * x).array() <= outer.upper.array() + 1e-6).all());
    for (int i = 0; i < 4; ++i) {
      const auto leg_rows = (inner.A * x - inner.upper).segment<4>(5 * i);
      EXPECT_GE(leg_rows.maxCoeff(), -1e-6);
    }
  }
}

TEST(FrictionCone, never_asks_for_more_normal_force_than_it_allows) {
  Scene scene;
  scene.plan.feet[1].force_max = 4.0;  // unloading, below force_min
  const TaskInput input = stand(scene, Random(26));
  const WrittenRows rows = written(FrictionCone({}), input);
  EXPECT_NEAR(rows.upper[9] - rows.lower[9], 0.0, 1e-12);
  EXPECT_NEAR(rows.upper[4] - rows.lower[4], 240.0, 1e-9);
}

TEST(FrictionCone, keeps_the_ids_of_a_leg_when_another_lifts_off) {
  Scene scene;
  const RobotState state = Random(27).standing_state(scene.model.description().q_nominal);
  const FrictionCone task({});
  const WrittenRows four = written(task, scene.update(state));
  scene.plan = plan_with_contacts({true, false, true, true});
  const WrittenRows three = written(task, scene.update(state));
  EXPECT_EQ(four.ids.back(), 19);
  EXPECT_EQ(three.ids.front(), 0);
  EXPECT_EQ(three.ids[5], 10);
  EXPECT_EQ(three.ids.back(), 19);
  EXPECT_EQ(task.row_name(19), "RH normal force");
}

TEST(ContactForceMinimisation, has_the_weighted_contact_forces_as_its_violation) {
  Scene scene;
  Random random(28);
  const ContactForceMinimisation task({.weight_tangential = 2.0, .weight_normal = 0.5});
  for (const PerLeg<bool>& contacts : all_contact_sets()) {
    scene.plan = plan_with_contacts(contacts);
    scene.plan.R_WC = random.small_rotation(0.3).toRotationMatrix();
    const TaskInput input = stand(scene, random);
    const WrittenRows rows = written(task, input);
    ASSERT_EQ(rows.count(), 3 * scene.plan.num_contacts());
    const VecX x = forward_dynamics(input, random_torque(random));
    const VecX violation = rows.A * x - rows.lower;
    Eigen::Index row = 0;
    for (const Leg leg : kLegs) {
      if (!scene.plan.contact(leg)) continue;
      const Vec3 f = scene.plan.R_WC.transpose() * scene.support.force(leg, x);
      EXPECT_LT((violation.segment<3>(row) - Vec3(2.0 * f.x(), 2.0 * f.y(), 0.5 * f.z())).norm(),
                1e-6);
      row += 3;
    }
  }
}

TEST(ContactForceMinimisation, and_the_friction_cone_see_forces_by_the_same_map) {
  Scene scene;
  Random random(29);
  const ContactForceMinimisation minimisation({.weight_tangential = 2.0, .weight_normal = 0.5});
  const FrictionCone friction({});
  for (const PerLeg<bool>& contacts : all_contact_sets()) {
    scene.plan = plan_with_contacts(contacts);
    const TaskInput input = stand(scene, random);
    const WrittenRows least = written(minimisation, input), cone = written(friction, input);
    for (int leg = 0; leg < scene.plan.num_contacts(); ++leg) {
      // Λ and λ₀ of the leg, from the rows of one task, give those of the other.
      const MatX force = least.A.middleRows(3 * leg, 3);
      const MatX rows = cone.A.middleRows(FrictionCone::kRowsPerLeg * leg, 4);
      const MatX by_force = test::least_squares(force.transpose(), rows.transpose()).transpose();
      EXPECT_LT((by_force * force - rows).norm(), 1e-12 * rows.norm());
      const VecX bound = cone.upper.segment(FrictionCone::kRowsPerLeg * leg, 4);
      EXPECT_LT((by_force * least.upper.segment(3 * leg, 3) - bound).norm(),
                1e-9 * (1.0 + bound.norm()));
    }
  }
}

TEST(TorqueMinimisation, has_the_weighted_torques_as_its_violation) {
  Scene scene;
  Random random(29);
  const TaskInput input = scene.update(random.state());
  const WrittenRows rows = written(TorqueMinimisation({1.0, 2.0, 3.0}), input);
  VecX x = VecX::Random(kNumUnknowns);
  const VecX expected =
      x.tail<kNumLegJoints>().cwiseProduct(Vec3(1.0, 2.0, 3.0).replicate<kNumLegs, 1>());
  EXPECT_LT((rows.A * x - rows.lower - expected).norm(), 1e-12);
  EXPECT_TRUE(rows.lower == rows.upper);
}

TEST(TorqueLimits, are_those_of_the_robot) {
  Scene scene;
  const TaskInput input = scene.update(Random(30).state());
  const WrittenRows rows = written(TorqueLimits({.fraction = 0.9}), input);
  const VecX x = VecX::Random(kNumUnknowns);
  EXPECT_TRUE(rows.A * x == x.tail<kNumLegJoints>());
  EXPECT_TRUE(rows.lower.isApproxToConstant(-36.0));
  EXPECT_TRUE(rows.upper.isApproxToConstant(36.0));
}

TEST(TorqueLimits, fall_with_speed_only_in_the_direction_of_motion) {
  Scene scene;
  RobotState state = Random(31).state();
  state.qd.setZero();
  state.qd.head<5>() << 7.5, 11.25, 15.0, 20.0, -11.25;  // of 15 rad/s
  const WrittenRows rows =
      written(TorqueLimits({.speed_line = TorqueLimits::SpeedLine::linear, .corner_speed = 0.5}),
              scene.update(state));
  const Eigen::Matrix<double, 6, 1> upper{40.0, 20.0, 0.0, 0.0, 40.0, 40.0};
  const Eigen::Matrix<double, 6, 1> lower{-40.0, -40.0, -40.0, -40.0, -20.0, -40.0};
  EXPECT_LT((rows.upper.head<6>() - upper).norm(), 1e-12);
  EXPECT_LT((rows.lower.head<6>() - lower).norm(), 1e-12);
}

TEST(TorqueLimits, refuse_options_that_make_no_sense) {
  EXPECT_THROW(TorqueLimits({.fraction = 0.0}), Error);
  EXPECT_THROW(TorqueLimits({.fraction = 1.1}), Error);
  EXPECT_THROW(TorqueLimits({.corner_speed = 1.0}), Error);
}

}  // namespace
}  // namespace surefoot::tasks
