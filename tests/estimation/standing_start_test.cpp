#include "surefoot/estimation/standing_start.hpp"

#include "surefoot/math/rotation.hpp"
#include "tests/support/malloc_counter.hpp"

#include <gtest/gtest.h>

namespace surefoot {
namespace {

constexpr double kPeriod = 0.0025;  // [s]
constexpr int kLasting = 41;        // ticks: more than 0.1 s

/// A base over four points that stand on the ground; it starts with v and ω, and gathers speed.
struct Base {
  Mat3 R = rotation_about_z(0.4) * exp_rotation(Vec3(0.05, -0.08, 0.0)).toRotationMatrix();
  Vec3 p = Vec3(0.02, 0.01, 0.5);
  Vec3 v_W = Vec3::Zero(), w_B = Vec3::Zero(), a_W = Vec3::Zero();
  Vec3 gyro_bias = Vec3(0.01, -0.02, 0.005);
  double time = 0.0;

  void tick() {
    p += kPeriod * v_W + 0.5 * kPeriod * kPeriod * a_W;
    v_W += kPeriod * a_W;
    R = R * exp_rotation(kPeriod * w_B).toRotationMatrix();
    time += kPeriod;
  }
  [[nodiscard]] SensorReading reading() const {
    SensorReading reading;
    reading.time = time;
    reading.q.setZero();
    reading.gyro = w_B + gyro_bias;
    reading.accelerometer = R.transpose() * (a_W - kGravityVector);
    return reading;
  }
  [[nodiscard]] bool seen_by(StandingStart& start, const SensorReading& reading) const {
    const PerLeg<Vec3> p_WC{Vec3(0.3, 0.2, 0.0), Vec3(0.3, -0.2, 0.0), Vec3(-0.3, 0.2, 0.0),
                            Vec3(-0.3, -0.2, 0.0)};
    PerLeg<Vec3> p_BC, v_BC;
    for (std::size_t k = 0; k < kNumLegs; ++k) {
      p_BC[k] = R.transpose() * (p_WC[k] - p);
      v_BC[k] = -R.transpose() * v_W - w_B.cross(p_BC[k]);
    }
    return start.stands(reading, JointVector::Zero(), p_BC, v_BC);
  }
  [[nodiscard]] bool seen_by(StandingStart& start) const { return seen_by(start, reading()); }
  /// In B, at rest.
  [[nodiscard]] Vec3 specific_force() const { return -R.transpose() * kGravityVector; }
};

/// Ticks until the base counts as standing, at most a hundred.
int ticks_until_it_stands(Base& base, StandingStart& start) {
  int ticks = 1;
  for (; !base.seen_by(start) && ticks < 100; ++ticks) base.tick();
  return ticks;
}

void see_it_fall(Base& base, StandingStart& start) {
  SensorReading falls = base.reading();
  falls.accelerometer.setZero();
  EXPECT_FALSE(base.seen_by(start, falls));
  base.tick();
}

TEST(StandingStart, ARobotAtRestStandsWithItsFirstReading) {
  Base base;
  StandingStart start(kPeriod);
  ASSERT_TRUE(base.seen_by(start));
  const StandingStart::State state = start.state();
  EXPECT_EQ(state.gyro_bias, base.reading().gyro);
  EXPECT_EQ(state.specific_force, base.reading().accelerometer);
  EXPECT_EQ(state.v_WB_B, Vec3::Zero());
  EXPECT_EQ(state.doubt, 1.0);
}

// Its turn is no bias, its acceleration no tilt: 0.08 rad of it.
TEST(StandingStart, OfOneThatSwaysTheLegsSayHowFast) {
  Base base;
  base.v_W = Vec3(0.02, -0.03, 0.01);
  base.a_W = Vec3(0.8, 0.2, 0.0);
  base.w_B = Vec3(0.05, 0.1, -0.03);
  StandingStart start(kPeriod);
  see_it_fall(base, start);
  EXPECT_EQ(ticks_until_it_stands(base, start), kLasting);
  const StandingStart::State state = start.state();
  EXPECT_LT((state.gyro_bias - base.gyro_bias).norm(), 1e-9);
  EXPECT_LT((state.v_WB_B - base.R.transpose() * base.v_W).norm(), 5e-4);
  EXPECT_LT((state.specific_force - base.specific_force()).norm(), 0.01) << "0.001 rad";
  EXPECT_GT(state.doubt, 1.0);
}

TEST(StandingStart, ItIsWaitedForWhereNumbersWereMissing) {
  for (const bool is_imu : {false, true}) {
    Base base;
    StandingStart start(kPeriod);
    SensorReading missing = base.reading();
    if (is_imu) missing.gyro[1] = kNaN;
    if (!is_imu) missing.q[7] = kNaN;
    EXPECT_FALSE(base.seen_by(start, missing));
    base.tick();
    EXPECT_EQ(ticks_until_it_stands(base, start), kLasting);
  }
}

TEST(StandingStart, WhatBreaksOffOrHasAGapBeginsAnew) {
  for (const bool is_gap : {false, true}) {
    Base base;
    StandingStart start(kPeriod);
    see_it_fall(base, start);
    for (int tick = 0; tick < kLasting - 1; ++tick) {
      EXPECT_FALSE(base.seen_by(start));
      base.tick();
    }
    if (is_gap) base.time += 3.0 * kPeriod;
    if (!is_gap) see_it_fall(base, start);
    EXPECT_EQ(ticks_until_it_stands(base, start), kLasting);
  }
}

TEST(StandingStart, WhatStoodByReadingsThatAreWorthNothingIsWaitedFor) {
  Base base;
  StandingStart start(kPeriod);
  ASSERT_TRUE(base.seen_by(start));
  start.begin_anew();
  base.time = -5.0;  // by another clock
  EXPECT_EQ(ticks_until_it_stands(base, start), kLasting);
}

// By the legs the base turns, by the gyroscope it does not.
TEST(StandingStart, LegsThatMoveUnderABaseThatDoesNotAreNoStance) {
  Base base;
  StandingStart start(kPeriod);
  see_it_fall(base, start);
  base.w_B = Vec3(0.11, 0.0, 0.0);
  base.gyro_bias -= base.w_B;
  EXPECT_EQ(ticks_until_it_stands(base, start), 100);
}

TEST(StandingStart, AllocatesNothing) {
  Base base;
  StandingStart start(kPeriod);
  const test::MallocCounter counter;
  (void)base.seen_by(start);
  (void)start.state();
  EXPECT_EQ(counter.count(), 0U);
}

}  // namespace
}  // namespace surefoot
