#include "tests/simulation/plant_support.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace surefoot::simulation {
namespace {

using test::HeldRobot;
using test::kMass;

constexpr double kWeight = kMass * kGravity;

TEST(Standing, FeetCarryTheWeightAndSinkAndCreepByFractionsOfAMillimetre) {
  HeldRobot robot(test::standing_options());
  robot.run(1.0);
  EXPECT_NEAR(robot.ground_force().z(), kWeight, 0.01 * kWeight);
  EXPECT_LT(robot.ground_force().head<2>().norm(), 0.01 * kWeight);
  EXPECT_FALSE(robot.truth().torso_contact);
  EXPECT_EQ(robot.truth().shank_contacts, 0);
  EXPECT_EQ(robot.truth().body_contact_force, 0.0);
  const PerLeg<Vec3> before = robot.truth().p_SF;
  robot.run(2.0);
  for (std::size_t leg = 0; leg < kNumLegs; ++leg) {
    const TrueContact& foot = robot.truth().feet[leg];
    EXPECT_TRUE(foot.touching);
    EXPECT_LT((foot.normal - Vec3::UnitZ()).norm(), 1e-12);
    EXPECT_GT(foot.penetration, 1e-5);
    EXPECT_LT(foot.penetration, 5e-4);
    EXPECT_LT((robot.truth().p_SF[leg] - before[leg]).norm() / 2.0, 8e-5) << "m/s";
  }
}

TEST(Standing, ASofterContactSinksDeeper) {
  double previous = 0.0;
  for (const double time : {0.005, 0.01, 0.02}) {
    PlantOptions options = test::standing_options();
    options.contact.solref_time = time;
    HeldRobot robot(options);
    robot.run(1.0);
    EXPECT_GT(robot.truth().feet[0].penetration, 1.2 * previous);
    previous = robot.truth().feet[0].penetration;
  }
}

TEST(Standing, StartsWithTheLowestFeetJustTouching) {
  const Plant plant(test::anymal_b(), test::standing_options());
  for (const Vec3& p_SF : plant.truth().p_SF) EXPECT_NEAR(p_SF.z(), 0.031, 1e-9);
}

TEST(Contact, ForcesExplainTheMotionOfTheCenterOfMass) {
  PlantOptions options = test::standing_options();
  options.control_period = options.timestep;
  options.initial.position.z() = 0.52;
  Plant plant(test::anymal_b(), options);
  const JointCommand command;  // constant, so that a force holds for the next step
  double largest = 0.0;
  for (int step = 0; step < 400; ++step) {
    const Vec3 v_before = plant.truth().v_SCom;
    Vec3 force = Vec3(0.0, 0.0, -kWeight);
    for (const TrueContact& foot : plant.truth().feet) force += foot.force;
    const bool only_feet = plant.truth().body_contact_force == 0.0;
    plant.write(command);
    const Vec3 momentum = kMass * (plant.truth().v_SCom - v_before);
    if (!only_feet) break;
    largest = std::max(largest, force.norm());
    EXPECT_LT((momentum - options.timestep * force).norm(), options.timestep * 0.01 * kWeight);
  }
  EXPECT_GT(largest, kWeight) << "the robot must have hit the ground";
}

TEST(Contact, VelocitiesAreTheDerivativesOfPositions) {
  PlantOptions options = test::falling_options();
  options.control_period = options.timestep;
  options.disturbances.pushes = {{"", 0.0, 0.05, Vec3(60.0, 80.0, 0.0)}};
  Plant plant(test::anymal_b(), options);
  JointCommand command;
  for (Eigen::Index i = 0; i < kNumLegJoints; ++i) command.torque[i] = i % 2 == 0 ? 2.0 : -3.0;
  for (int step = 0; step < 60; ++step) plant.write(command);
  const GroundTruth before = plant.truth();
  plant.write(command);
  const GroundTruth& after = plant.truth();
  const auto rate = [&options](const Vec3& a, const Vec3& b) { return (b - a) / options.timestep; };
  EXPECT_GT(after.qd.norm(), 1.0);
  EXPECT_LT((rate(before.p_SB, after.p_SB) - after.v_SB).norm(), 1e-6);
  EXPECT_LT((rate(before.p_SCom, after.p_SCom) - after.v_SCom).norm(), 0.02);
  for (std::size_t leg = 0; leg < kNumLegs; ++leg) {
    EXPECT_LT((rate(before.p_SF[leg], after.p_SF[leg]) - after.v_SF[leg]).norm(), 0.02);
  }
  const Quat turn = before.q_SB.conjugate() * after.q_SB;
  EXPECT_LT((2.0 * turn.vec() / options.timestep - after.w_SB_B).norm(), 1e-4);
  EXPECT_LT(((after.q - before.q) / options.timestep - after.qd).norm(), 1e-9);
}

/// Largest share of its friction that a foot uses; no foot may use more than all of it.
double used_friction(const GroundTruth& truth, double friction) {
  double largest = 0.0;
  for (const TrueContact& foot : truth.feet) {
    const double normal = foot.force.dot(foot.normal);
    const double tangential = (foot.force - normal * foot.normal).norm();
    EXPECT_TRUE(!foot.touching || std::abs(foot.friction - friction) < 1e-12);
    EXPECT_LE(tangential, 1.001 * friction * normal + 1e-6);
    if (normal > 5.0) largest = std::max(largest, tangential / (friction * normal));
  }
  return largest;
}

/// How a standing robot's feet slip some time after a horizontal push has begun.
struct PushResult {
  double slip_speed = 0.0;  ///< mean over time of the mean over the feet [m/s]
  double used_friction = 0.0;
};

PushResult push_forwards(double friction, double push_per_weight) {
  PlantOptions options = test::standing_options();
  options.terrain.friction = friction;
  options.control_period = options.timestep;
  options.disturbances.pushes = {{"", 0.3, 2.0, Vec3(push_per_weight * kWeight, 0.0, 0.0)}};
  model::RobotDescription description = test::anymal_b();
  description.torque_limit.setConstant(200.0);
  HeldRobot robot(options, description);
  robot.stiffness = 2000.0;
  robot.damping = 12.0;
  robot.run(0.7);
  constexpr int kTicks = 200;
  PushResult result;
  for (int tick = 0; tick < kTicks; ++tick) {
    robot.tick();
    result.used_friction = std::max(result.used_friction, used_friction(robot.truth(), friction));
    for (const TrueContact& foot : robot.truth().feet) {
      result.slip_speed += foot.slip_velocity.norm() / (kTicks * kNumLegs);
    }
  }
  return result;
}

class Friction : public testing::TestWithParam<double> {};

TEST_P(Friction, HoldsTheFeetBelowItsCone) {
  const PushResult result = push_forwards(GetParam(), 0.8 * GetParam());
  EXPECT_GT(result.used_friction, 0.7);
  EXPECT_LT(result.slip_speed, 2e-3);
}

TEST_P(Friction, LetsTheFeetSlideBeyondItsCone) {
  const PushResult result = push_forwards(GetParam(), 1.2 * GetParam());
  EXPECT_GT(result.used_friction, 0.99);
  EXPECT_GT(result.slip_speed, 0.05);
}

INSTANTIATE_TEST_SUITE_P(OfTheTerrain, Friction, testing::Values(0.2, 0.35, 0.6));

TEST(Friction, IsThatOfTheTerrainElementUnderEachFoot) {
  PlantOptions options = test::standing_options();
  TerrainBox front, hind;
  front.position = Vec3(1.0, 0.0, -0.1);
  hind.position = Vec3(-1.0, 0.0, -0.1);
  front.size = hind.size = Vec3(2.0, 2.0, 0.2);
  front.friction = 0.3;
  options.terrain.friction = 1.1;
  options.terrain.elements = {front, hind};
  HeldRobot robot(options);
  robot.run(0.5);
  for (const Leg leg : kLegs) {
    EXPECT_NEAR(robot.truth().feet[index(leg)].friction, is_front(leg) ? 0.3 : 1.1, 1e-12);
  }
}

TEST(Contact, AFootThatRollsDoesNotSlip) {
  HeldRobot robot(test::standing_options());
  robot.run(0.5);
  const JointVector q_start = robot.q_hold;
  double fastest_center = 0.0;
  double fastest_slip = 0.0;
  for (int tick = 0; tick < 400; ++tick) {
    const double sway = 0.04 * std::sin(2.0 * kPi * tick / 400.0);
    for (const Leg leg : kLegs)
      robot.q_hold[first_joint(leg) + 1] = q_start[first_joint(leg) + 1] + sway;
    robot.tick();
    for (const Leg leg : kLegs) {
      fastest_center = std::max(fastest_center, robot.truth().v_SF[index(leg)].head<2>().norm());
      fastest_slip = std::max(fastest_slip, robot.truth().feet[index(leg)].slip_velocity.norm());
    }
  }
  EXPECT_GT(fastest_center, 0.005) << "the sphere's centre moves with r ω";
  EXPECT_LT(fastest_slip, 0.2 * fastest_center);
}

// A bounce lasts a few physics steps and can begin and end between two ticks.
TEST(Contact, AFootTouchedIfItDidInAnyPhysicsStepOfTheTick) {
  PlantOptions options = test::standing_options();
  options.initial.settle = 0.0;
  options.initial.position.z() = 0.60;
  constexpr int kSteps = 5, kTicks = 200;
  options.control_period = kSteps * options.timestep;
  Plant plant(test::anymal_b(), options);
  options.control_period = options.timestep;
  Plant fine(test::anymal_b(), options);
  const JointCommand limp{};
  int missed = 0, seen = 0;
  for (int tick = 0; tick < kTicks; ++tick) {
    PerLeg<bool> touched{};
    for (int step = 0; step <= kSteps; ++step) {
      for (const Leg leg : kLegs) {
        touched[index(leg)] |= fine.truth().feet[index(leg)].touching;
      }
      if (step < kSteps) fine.write(limp);
    }
    plant.write(limp);
    for (const Leg leg : kLegs) {
      const TrueContact& foot = plant.truth().feet[index(leg)];
      EXPECT_EQ(foot.touched, touched[index(leg)]) << "tick " << tick;
      seen += foot.touched;
      missed += foot.touched && !foot.touching;
    }
  }
  EXPECT_GT(missed, 0) << "no foot bounced between two ticks";
  EXPECT_GT(seen, missed);
}

TEST(Contact, AFallIsSeenAsTheTorsoTouchingTheGround) {
  Plant plant(test::anymal_b(), test::standing_options());
  EXPECT_FALSE(plant.truth().torso_contact);
  bool seen = false;
  for (int tick = 0; tick < 800; ++tick) {
    plant.write({});
    seen = seen || plant.truth().torso_contact;
  }
  EXPECT_TRUE(seen);
  EXPECT_LT(plant.truth().p_SB.z(), 0.25);
  EXPECT_GT(plant.truth().body_contact_force, 10.0);
}

TEST(Contact, AShankThatTouchesABoxIsSeenOnItsLegAlone) {
  const PlantOptions standing = test::standing_options();
  const PerLeg<Vec3> p_SF = Plant(test::anymal_b(), standing).truth().p_SF;
  for (const Leg leg : kLegs) {
    PlantOptions options = standing;
    const double pitch = is_front(leg) ? -0.4 : 0.4;
    TerrainBox obstacle;
    obstacle.position = p_SF[index(leg)] + 0.15 * Vec3(std::sin(pitch), 0.0, std::cos(pitch));
    obstacle.size = Vec3(0.02, 0.02, 0.02);
    options.terrain.elements = {TerrainLevel{}, obstacle};
    options.initial.position.z() = Plant(test::anymal_b(), standing).truth().p_SB.z();
    const Plant plant(test::anymal_b(), options);
    EXPECT_EQ(plant.truth().shank_contacts, 1 << static_cast<int>(leg));
    EXPECT_GT(plant.truth().body_contact_force, 0.0);
    EXPECT_FALSE(plant.truth().torso_contact);
  }
}

TEST(Contact, ATorsoThatTouchesABoxIsSeen) {
  PlantOptions options = test::standing_options();
  options.initial.position.z() = Plant(test::anymal_b(), options).truth().p_SB.z();
  TerrainBox block;
  block.size = Vec3(0.2, 0.1, 0.8);  // up to 0.4 m, the belly is at 0.37 m
  options.terrain.elements = {TerrainLevel{}, block};
  const Plant plant(test::anymal_b(), options);
  EXPECT_TRUE(plant.truth().torso_contact);
  EXPECT_EQ(plant.truth().shank_contacts, 0);
}

TEST(Contact, OnASlopeTheNormalIsThatOfTheSlope) {
  const double angle = 0.2;
  PlantOptions options = test::standing_options();
  TerrainLevel slope;
  slope.rpy = Vec3(0.0, angle, 0.0);
  options.terrain.elements = {slope};
  HeldRobot robot(options);
  robot.run(1.0);
  const Vec3 normal(std::sin(angle), 0.0, std::cos(angle));
  int touching = 0;
  for (const TrueContact& foot : robot.truth().feet) {
    if (!foot.touching) continue;
    ++touching;
    EXPECT_LT((foot.normal - normal).norm(), 1e-9);
    EXPECT_NEAR(foot.point.dot(normal), 0.0, 1e-3);
  }
  EXPECT_GE(touching, 2);
}

}  // namespace
}  // namespace surefoot::simulation
