#include "surefoot/estimation/imu_step_check.hpp"

#include "surefoot/math/rotation.hpp"
#include "tests/support/random_motion.hpp"

#include <gtest/gtest.h>

namespace surefoot::estimation {
namespace {

using test::Random;

constexpr double kPeriod = 0.0025;
const Vec3 kUp = Vec3::UnitZ();

/// A base over four feet, which from a moment on is accelerated and turned faster than any walk
/// does, or whose IMU says so.
struct Stepping {
  explicit Stepping(unsigned seed = 1) {
    Random random(seed);
    v = random.vector(0.3);
    w_B = random.vector(0.5);
    R = exp_rotation(random.vector(0.2)).toRotationMatrix();
    for (const Leg leg : kLegs) {
      foot[index(leg)] = {is_front(leg) ? 0.33 : -0.33, is_left(leg) ? 0.22 : -0.22, 0.0};
      state.foot_force[index(leg)] = 75.0 * kUp;
    }
    tick(false);
  }

  /// `is_doubted`: the guard holds what the IMU said before `step_f` and `step_w`.
  void tick(bool is_doubted) {
    if (is_doubted && moves) {
      a = R * step_f;
      w_B += is_first ? step_w : Vec3::Zero();
    }
    is_first = is_first && !is_doubted;
    const Mat3 R_half = R * exp_rotation(0.5 * kPeriod * w_B).toRotationMatrix();
    held.gyro = is_doubted ? held.gyro : w_B;
    held.accelerometer = R_half.transpose() * (kGravity * kUp + (is_doubted ? Vec3::Zero() : a));
    offered.gyro = w_B + (is_doubted && !moves ? step_w : Vec3::Zero());
    offered.accelerometer =
        R_half.transpose() * (kGravity * kUp + a) + (is_doubted && !moves ? step_f : Vec3::Zero());
    p += kPeriod * (v + 0.5 * kPeriod * a);
    v += kPeriod * a;
    R = R * exp_rotation(kPeriod * w_B).toRotationMatrix();
    describe(is_doubted);
    check.update(offered, held, is_doubted, state, dynamics, stands, kUp);
  }

  /// The estimate of the base gets nothing new while the step is doubted: only the legs count.
  void describe(bool is_doubted) {
    if (!is_doubted) {
      state.q_WB = Quat(R);
      state.v_WB = v;
      dynamics.base.p = p;
      dynamics.base_rotation.R = R;
    }
    for (const Leg leg : kLegs) {
      const std::size_t k = index(leg);
      foot[k] += kPeriod * slip[k];
      const Vec3 h_B = R.transpose() * (foot[k] - p);
      dynamics.foot[k].p = dynamics.base.p + dynamics.base_rotation.R * h_B;
    }
  }

  ImuStep after(int ticks) {
    for (int i = 0; i < ticks; ++i) tick(true);
    return check.verdict();
  }

  ImuStepCheck check{kPeriod};
  model::Dynamics dynamics;
  RobotState state;
  SensorReading offered, held;
  PerLeg<bool> stands{true, true, true, true};
  PerLeg<Vec3> foot{}, slip{Vec3::Zero(), Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
  Mat3 R;
  Vec3 p = 0.46 * kUp, v, w_B, a = Vec3::Zero();
  Vec3 step_f = Vec3::Zero(), step_w = Vec3::Zero();
  bool moves = true, is_first = true;
};

constexpr int kBridged = 7;  // samples that may be held

TEST(ImuStepCheck, ABlowThatTheLegsFeelIsConfirmedWhicheverInstrumentStepped) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    Random random(seed);
    Stepping hit(seed), turned(seed);
    hit.step_f = 30.0 * random.vector(1.0).normalized();
    turned.step_w = 1.0 * random.vector(1.0).normalized();
    EXPECT_EQ(hit.after(kBridged), ImuStep::confirmed) << seed;
    EXPECT_EQ(turned.after(kBridged), ImuStep::confirmed) << seed;
  }
}

TEST(ImuStepCheck, AStepThatNoLegFeelsIsContradicted) {
  for (const Vec3& axis : {Vec3(1.0, 0.0, 0.0), Vec3(0.0, -1.0, 0.0), Vec3(0.0, 0.0, 1.0)}) {
    for (const double size : {1.0, 4.0}) {
      Stepping hit, turned;
      hit.moves = turned.moves = false;
      hit.step_f = size * 30.0 * axis;
      turned.step_w = size * axis;
      EXPECT_EQ(hit.after(kBridged), ImuStep::contradicted) << axis.transpose();
      EXPECT_EQ(turned.after(kBridged), ImuStep::contradicted) << axis.transpose();
    }
  }
}

TEST(ImuStepCheck, AFootThatSlidesUnderABlowMakesItNoFault) {
  for (const Leg leg : kLegs) {
    Stepping robot;
    robot.step_f = {0.0, 30.0, 0.0};
    robot.slip[index(leg)] = {0.0, 0.6, 0.0};
    EXPECT_EQ(robot.after(kBridged), ImuStep::confirmed);
  }
}

TEST(ImuStepCheck, ASampleOrTwoDecideNothing) {
  Stepping robot;
  robot.step_f = {30.0, 0.0, 0.0};
  EXPECT_EQ(robot.check.verdict(), ImuStep::not_judged);
  EXPECT_EQ(robot.after(2), ImuStep::undecided);
}

TEST(ImuStepCheck, WithoutTwoFeetThatStoodBeforeThereIsNoWitness) {
  Stepping robot;
  for (const Leg leg : {Leg::LF, Leg::RF}) robot.state.foot_force[index(leg)].setZero();
  robot.stands[index(Leg::LH)] = false;
  robot.tick(false);
  EXPECT_EQ(robot.after(kBridged), ImuStep::no_witness);
  robot.check.forget();
  EXPECT_EQ(robot.check.verdict(), ImuStep::not_judged);
  EXPECT_EQ(robot.after(1), ImuStep::no_witness) << "nothing is known of before";
}

// The estimated velocity then lacks the held samples.
TEST(ImuStepCheck, BehindABlowThatWasHeldThereIsNoWitnessForAMoment) {
  for (const double size : {30.0, 0.0}) {
    Stepping robot;
    robot.step_f = {size, 0.0, 0.0};
    (void)robot.after(kBridged);
    robot.tick(false);
    EXPECT_EQ(robot.after(1), ImuStep::no_witness);
    for (int i = 0; i < 30; ++i) robot.tick(false);
    EXPECT_EQ(robot.after(1), ImuStep::undecided);
  }
}

}  // namespace
}  // namespace surefoot::estimation
