#include "surefoot/estimation/contact_force_estimator.hpp"

#include "surefoot/model/robot_model.hpp"
#include "tests/support/anymal_b.hpp"
#include "tests/support/random_motion.hpp"

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace surefoot::estimation {
namespace {

using test::anymal_b;
using test::Random;

constexpr double kPeriod = 0.0025;
constexpr int kTrials = 30;
constexpr double kBias = 0.05;  // of the damped inverse, as a share of a force
const Vec3 kUp = Vec3::UnitZ();

/// Σ J_kᵀ f_k.
GeneralizedVector generalized(const model::Dynamics& dynamics, const PerLeg<Vec3>& forces) {
  GeneralizedVector sum = GeneralizedVector::Zero(6 + kNumLegJoints);
  for (std::size_t k = 0; k < kNumLegs; ++k) sum += dynamics.contact[k].J.transpose() * forces[k];
  return sum;
}

/// Random forces on the feet that balance the robot at rest: the base rows of h = Sᵀτ + Σ Jᵀ f.
PerLeg<Vec3> balancing_forces(const model::Dynamics& dynamics, Random& random) {
  PerLeg<Vec3> forces;
  Eigen::Matrix<double, 6, 12> grasp;
  for (std::size_t k = 0; k < kNumLegs; ++k) {
    forces[k] = Vec3(0.0, 0.0, 75.0) + random.vector(15.0);
    grasp.middleCols<3>(3 * static_cast<Eigen::Index>(k)) =
        dynamics.contact[k].J.leftCols<6>().transpose();
  }
  const Eigen::Matrix<double, 6, 1> missing =
      dynamics.h.head<6>() - generalized(dynamics, forces).head<6>();
  const Eigen::Matrix<double, 12, 1> correction =
      grasp.completeOrthogonalDecomposition().solve(missing);
  for (std::size_t k = 0; k < kNumLegs; ++k) {
    forces[k] += correction.segment<3>(3 * static_cast<Eigen::Index>(k));
  }
  return forces;
}

RobotState at_rest(Random& random, const model::RobotDescription& robot) {
  RobotState state = random.standing_state(robot.q_nominal);
  state.v_WB.setZero();
  state.w_WB_B.setZero();
  state.qd.setZero();
  return state;
}

/// A robot at rest that hangs from its base.
struct Still {
  explicit Still(unsigned seed, const Vec3& normal = kUp)
      : model(anymal_b()),
        random(seed),
        state(at_rest(random, model.description())),
        dynamics(model.update(state, normal)) {
    state.time = 0.0;
    state.torque = dynamics.h.tail<kNumLegJoints>();
  }

  model::RobotModel model;
  Random random;
  RobotState state;
  const model::Dynamics& dynamics;
};

/// A robot at rest that stands, pressing its feet against the ground.
struct Standing : Still {
  explicit Standing(unsigned seed) : Still(seed), forces(balancing_forces(dynamics, random)) {
    state.torque = (dynamics.h - generalized(dynamics, forces)).tail<kNumLegJoints>();
  }

  void expect_to_be_felt() const {
    for (std::size_t k = 0; k < kNumLegs; ++k) {
      EXPECT_LT((state.foot_force[k] - forces[k]).norm(), kBias * forces[k].norm())
          << k << " at " << state.time;
    }
  }

  PerLeg<Vec3> forces;
};

constexpr PerLeg<bool> kInTheAir{}, kStanding{true, true, true, true};
/// Forces on feet in the air are no forces of the ground otherwise.
const ContactForceOptions kWithoutTare{.tare = {.enabled = false}};

/// An estimator whose robot's encoders read state.q.
struct Bench {
  explicit Bench(const ContactForceOptions& options = {}) : estimator(options, kPeriod) {}

  void observe(const RobotState& state) {
    reading.time = state.time;
    reading.q = state.q;
    reading.torque = state.torque;
    velocity = estimator.observe(reading, delays);
  }

  void tick(const model::Dynamics& dynamics, RobotState& state, const Vec3& normal = kUp) {
    observe(state);
    estimator.update(dynamics, stands, normal, reading, state);
  }

  ContactForceEstimator estimator;
  SensorReading reading;
  PerLeg<bool> stands = kInTheAir;
  JointVector velocity = JointVector::Zero(kNumLegJoints);
  JointDelays delays;
};

/// `dt` on with a constant acceleration.
void move(model::Dynamics& dynamics, RobotState& state, const GeneralizedVector& acceleration,
          double dt) {
  state.q +=
      dt * dynamics.u.tail<kNumLegJoints>() + 0.5 * dt * dt * acceleration.tail<kNumLegJoints>();
  dynamics.u += dt * acceleration;
  state.time += dt;
}

TEST(ContactForceEstimator, FindsTheForcesOfAStandingRobotFromItsJointTorques) {
  for (unsigned seed = 1; seed <= kTrials; ++seed) {
    Standing robot(seed);
    Bench().tick(robot.dynamics, robot.state);
    robot.expect_to_be_felt();
    Vec3 sum = Vec3::Zero();
    for (const Vec3& force : robot.state.foot_force) sum += force;
    const double weight = robot.model.mass() * kGravity;
    EXPECT_LT((sum - weight * kUp).norm(), kBias * weight);
  }
}

// The state of the first tick was refused; the torques are a tick ahead of the angles.
TEST(ContactForceEstimator, ATickWithoutAStateAtTheBeginningChangesNothing) {
  Standing robot(1);
  Bench bench;
  bench.delays.encoders = kPeriod;
  bench.observe(robot.state);
  for (int i = 0; i < 20; ++i) {
    robot.state.time += kPeriod;
    bench.tick(robot.dynamics, robot.state);
    robot.expect_to_be_felt();
  }
}

TEST(ContactForceEstimator, FindsTheForcesOfAMovingRobotFromItsAcceleration) {
  model::RobotModel model(anymal_b());
  Random random(2);
  for (int trial = 0; trial < kTrials; ++trial) {
    SCOPED_TRACE("trial " + std::to_string(trial));
    RobotState state = random.standing_state(model.description().q_nominal);
    state.time = 0.0;
    model::Dynamics dynamics = model.update(state, kUp);
    PerLeg<Vec3> forces;
    for (Vec3& force : forces) force = Vec3(0.0, 0.0, 70.0) + random.vector(30.0);
    for (double& torque : state.torque) torque = random.uniform(-20.0, 20.0);
    GeneralizedVector applied = generalized(dynamics, forces) - dynamics.h;
    applied.tail<kNumLegJoints>() += state.torque;
    const GeneralizedVector acceleration = dynamics.M.ldlt().solve(applied);
    Bench bench(kWithoutTare);
    for (int tick = 0; tick < 60; ++tick) {  // the observer settles
      bench.tick(dynamics, state);
      move(dynamics, state, acceleration, kPeriod);
    }
    for (std::size_t k = 0; k < kNumLegs; ++k) {
      EXPECT_LT((state.foot_force[k] - forces[k]).norm(), kBias * forces[k].norm()) << k;
    }
  }
}

/// A robot without torques that falls freely from a random posture.
struct Fall {
  Fall(model::RobotModel& model, Random& random)
      : state(random.standing_state(model.description().q_nominal)) {
    state.time = random.uniform(0.0, 1000.0);
    state.torque.setZero();
    dynamics = model.update(state, kUp);
    acceleration = -dynamics.M.ldlt().solve(dynamics.h);
  }
  void on(double dt) { move(dynamics, state, acceleration, dt); }

  RobotState state;
  model::Dynamics dynamics;
  GeneralizedVector acceleration;
};

TEST(ContactForceEstimator, CountsTheTicksThatWereLeftOut) {
  model::RobotModel model(anymal_b());
  Random random(7);
  for (int left_out = 0; left_out < 40; ++left_out) {
    SCOPED_TRACE(std::to_string(left_out) + " ticks left out");
    Fall fall(model, random);
    Bench bench(kWithoutTare);
    for (int tick = 0; tick < 200; ++tick) {
      fall.on(tick < 199 ? kPeriod : (1 + left_out) * kPeriod);
      bench.tick(fall.dynamics, fall.state);
    }
    for (const Vec3& force : fall.state.foot_force) EXPECT_LT(force.norm(), 1e-3);
  }
}

// Ticks without a state don't count as a hard stop of the base.
TEST(ContactForceEstimator, CountsTheTicksThatHadNoState) {
  model::RobotModel model(anymal_b());
  Random random(7);
  for (int without = 0; without < 20; ++without) {
    SCOPED_TRACE(std::to_string(without) + " ticks without a state");
    Fall fall(model, random);
    Bench bench(kWithoutTare);
    for (int tick = 0; tick < 220; ++tick) {
      fall.on(kPeriod);
      if (tick >= 180 && tick < 180 + without) {
        bench.observe(fall.state);
        continue;
      }
      bench.tick(fall.dynamics, fall.state);
      if (tick < 180) continue;  // it settles
      for (const Vec3& force : fall.state.foot_force) EXPECT_LT(force.norm(), 1e-3) << tick;
    }
  }
}

/// The largest force found on feet in the air, where torques that swing are `lag` ticks behind the
/// joint angles, and it is known or not [N].
double force_in_the_air(int lag, bool is_told) {
  model::RobotModel model(anymal_b());
  Random random(9);
  RobotState state = random.standing_state(model.description().q_nominal);
  state.time = 0.0;
  model::Dynamics dynamics = model.update(state, kUp);
  const auto joints = dynamics.M.bottomRightCorner<kNumLegJoints, kNumLegJoints>().ldlt();
  Bench bench(kWithoutTare);
  if (is_told)
    bench.delays = {.encoders = std::max(0, -lag) * kPeriod, .torques = std::max(0, lag) * kPeriod};
  std::vector<JointVector> torques, angles;
  double most = 0.0;
  for (int tick = 0; tick < 200; ++tick) {
    torques.push_back(JointVector::Constant(kNumLegJoints, 5.0 * std::sin(0.3 * tick)));
    angles.push_back(state.q);
    GeneralizedVector acceleration =
        GeneralizedVector::Zero(6 + kNumLegJoints);  // the base is held
    acceleration.tail<kNumLegJoints>() =
        joints.solve(torques.back() - dynamics.h.tail<kNumLegJoints>());
    RobotState sensed = state;
    sensed.torque = torques[static_cast<std::size_t>(std::max(0, tick - std::max(0, lag)))];
    sensed.q = angles[static_cast<std::size_t>(std::max(0, tick - std::max(0, -lag)))];
    bench.tick(dynamics, sensed);
    move(dynamics, state, acceleration, kPeriod);
    if (tick < 100) continue;
    for (const Vec3& force : sensed.foot_force) {
      EXPECT_TRUE(force.allFinite());
      most = std::max(most, force.norm());
    }
  }
  return most;
}

TEST(ContactForceEstimator, TorquesAndAnglesOfDifferentTimesAreNoForce) {
  for (const int lag : {-3, -1, 1, 3}) {
    EXPECT_LT(force_in_the_air(lag, true), 0.4 * force_in_the_air(lag, false)) << lag;
  }
}

// Torques that come a tick after the encoders, and begin a tick later, too.
TEST(ContactForceEstimator, TorquesThatBeginLateAreKnownFromThenOn) {
  Standing robot(12);
  Bench bench;
  bench.stands = kStanding;
  bench.delays.encoders = kPeriod;
  RobotState without = robot.state;
  without.torque.setConstant(kNaN);
  bench.observe(without);
  for (int tick = 0; tick < 3; ++tick) {
    robot.state.time += kPeriod;
    bench.tick(robot.dynamics, robot.state);
    robot.expect_to_be_felt();
  }
}

TEST(ContactForceEstimator, VelocitiesOfAMovingLegDoNotLag) {
  model::RobotModel model(anymal_b());
  Random random(3);
  RobotState state = random.standing_state(model.description().q_nominal);
  state.time = 0.0;
  state.torque.setConstant(3.0);
  model::Dynamics dynamics = model.update(state, kUp);
  GeneralizedVector applied = -dynamics.h;
  applied.tail<kNumLegJoints>() += state.torque;
  const GeneralizedVector acceleration = dynamics.M.ldlt().solve(applied);
  Bench bench;
  for (int tick = 0; tick < 200; ++tick) {
    move(dynamics, state, acceleration, kPeriod);
    bench.tick(dynamics, state);
  }
  EXPECT_LT((bench.velocity - dynamics.u.tail<kNumLegJoints>()).norm(), 1e-6);
}

TEST(ContactForceEstimator, TorquesThatTheGroundTakesUpMoveNoJoint) {
  Still robot(10);
  Bench standing, hanging;
  standing.stands = kStanding;
  for (Bench* bench : {&standing, &hanging}) bench->tick(robot.dynamics, robot.state);
  robot.state.torque.array() += 10.0;
  for (int tick = 0; tick < 4; ++tick) {
    robot.state.time += kPeriod;
    for (Bench* bench : {&standing, &hanging}) bench->tick(robot.dynamics, robot.state);
  }
  EXPECT_LT(standing.velocity.norm(), 1e-9);
  EXPECT_GT(hanging.velocity.norm(), 0.05);
}

TEST(ContactForceEstimator, AReadingThatIsMissingIsBridged) {
  Still robot(8);
  Bench bench;
  bench.stands = kStanding;
  bench.tick(robot.dynamics, robot.state);
  RobotState missing = robot.state;
  missing.q[4] = kNaN;
  missing.time += kPeriod;
  bench.tick(robot.dynamics, missing);
  EXPECT_LT(bench.velocity.norm(), 1e-9);
  for (const Vec3& force : missing.foot_force) EXPECT_LT(force.norm(), 1e-6);
}

TEST(ContactForceEstimator, FollowsASuddenForceWithinAFewTicks) {
  model::RobotModel model(anymal_b());
  Random random(4);
  RobotState state = at_rest(random, model.description());
  state.time = 0.0;
  const model::Dynamics& dynamics = model.update(state, kUp);
  Bench bench;
  state.torque = dynamics.h.tail<kNumLegJoints>();
  bench.tick(dynamics, state);
  EXPECT_LT(state.foot_force[0].norm(), 1e-9);
  const PerLeg<Vec3> touch{Vec3(0.0, 0.0, 50.0), Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
  state.torque -= generalized(dynamics, touch).tail<kNumLegJoints>();
  std::vector<double> force;
  for (int tick = 0; tick < 12; ++tick) {
    state.time += kPeriod;
    bench.tick(dynamics, state);
    force.push_back(state.foot_force[0].z());
  }
  EXPECT_GT(force[3], 10.0) << "a touchdown's threshold, 10 ms after it";
  EXPECT_GT(force.back(), 45.0);
  EXPECT_LT(force.back(), 60.0);
  EXPECT_LT(state.foot_force[1].norm(), 0.5);
}

TEST(ContactForceEstimator, WhatASwingLegsTorquesAreOffByIsLearntToBeNoForce) {
  const auto felt_in_the_air = [](const ContactForceOptions& options) {
    Still robot(13);
    robot.state.torque.head<3>().array() += 1.0;
    Bench bench(options);
    for (int tick = 0; tick < 1900; ++tick) {
      bench.stands = kStanding;
      bench.stands[index(Leg::LF)] = tick % 200 >= 160;
      robot.state.time += kPeriod;
      bench.tick(robot.dynamics, robot.state);
    }
    return robot.state.foot_force[index(Leg::LF)].norm();
  };
  EXPECT_GT(felt_in_the_air(kWithoutTare), 1.0);
  EXPECT_LT(felt_in_the_air({}), 0.5 * felt_in_the_air(kWithoutTare));
}

TEST(ContactForceEstimator, StaysFiniteWithStraightLegs) {
  model::RobotModel model(anymal_b());
  RobotState state = test::straight_legged_state();
  state.torque.setConstant(5.0);
  Bench().tick(model.update(state, kUp), state);
  for (const Vec3& force : state.foot_force) {
    EXPECT_TRUE(force.allFinite());
    EXPECT_LT(force.norm(), 2000.0);
  }
}

TEST(ContactForceEstimator, TakesAFootSensorsForceOnlyWhereItIsAskedToAndThereIsOneThatCanBe) {
  Still robot(5);
  Bench with({.use_foot_sensor = true}), without;
  with.reading.foot_force = without.reading.foot_force = {38.0, kNaN, 7.0, 1e300};
  with.tick(robot.dynamics, robot.state);
  const PerLeg<Vec3>& felt = robot.state.foot_force;
  EXPECT_LT((felt[0] - Vec3(0.0, 0.0, 38.0)).norm(), 1e-9);
  EXPECT_LT(felt[1].norm(), 1e-9);
  EXPECT_LT((felt[2] - Vec3(0.0, 0.0, 7.0)).norm(), 1e-9);
  EXPECT_LT(felt[3].norm(), 1e-9) << "no foot bears that";
  without.tick(robot.dynamics, robot.state);
  EXPECT_LT(felt[0].norm(), 1e-9);
}

TEST(ContactForceEstimator, AFootSensorGivesTheForceAlongTheTerrainNormalJointsTheRest) {
  const Vec3 normal = Vec3(0.2, -0.1, 1.0).normalized();
  Still robot(9, normal);
  robot.state.torque.setZero();
  Bench with({.use_foot_sensor = true}), without;
  with.reading.foot_force = {42.0, 0.0, 7.0, -1.0};
  without.tick(robot.dynamics, robot.state, normal);
  const PerLeg<Vec3> felt = robot.state.foot_force;
  with.tick(robot.dynamics, robot.state, normal);
  for (std::size_t k = 0; k < kNumLegs; ++k) {
    const Vec3 along = felt[k] - normal.dot(felt[k]) * normal;
    FootSensorTrust trust(kPeriod);
    const Vec3 sensed = trust.force(with.reading.foot_force[k], normal.dot(felt[k])) * normal;
    EXPECT_GT(along.norm(), 1.0) << "or it shows nothing";
    EXPECT_LT((robot.state.foot_force[k] - sensed - along).norm(), 1e-9);
  }
}

}  // namespace
}  // namespace surefoot::estimation
