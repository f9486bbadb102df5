#include "surefoot/estimation/standing_start.hpp"

#include "surefoot/math/rotation.hpp"

#include <gtest/gtest.h>

namespace surefoot::estimation {
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
    return start.stands(reading, JointVector::Zero(kNumLegJoints), p_BC, v_BC);
  }
  [[nodiscard]] bool seen_by(StandingStart& start) const { return seen_by(start, reading()); }
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

// By the legs the base turns, by the gyroscope it does not.
TEST(StandingStart, LegsThatMoveUnderABaseThatDoesNotAreNoStance) {
  Base base;
  StandingStart start(kPeriod);
  see_it_fall(base, start);
  base.w_B = Vec3(0.11, 0.0, 0.0);
  base.gyro_bias -= base.w_B;
  EXPECT_EQ(ticks_until_it_stands(base, start), 100);
}

}  // namespace
}  // namespace surefoot::estimation
