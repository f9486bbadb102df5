#include "surefoot/estimation/rest_check.hpp"

#include "surefoot/math/rotation.hpp"
#include "tests/support/random_motion.hpp"

#include <gtest/gtest.h>

namespace surefoot::estimation {
namespace {

using test::Random;

constexpr double kPeriod = 0.0025;
constexpr double kMass = 30.0;

/// Duration of the IMU's fault after 0.05 s with these numbers.
double wrong_for(const Vec3& accelerometer, const Vec3& force, const Vec3& gyro = Vec3::Zero(),
                 const JointVector& qd = JointVector::Zero(kNumLegJoints)) {
  RestCheck check(kPeriod);
  SensorReading reading;
  reading.accelerometer = accelerometer;
  reading.gyro = gyro;
  for (int i = 0; i < 20; ++i) check.update(reading, qd, force, kMass);
  return check.wrong_for();
}

TEST(RestCheck, AnImuThatFeelsWhatTheLegsBearIsRightOnAnySlopeAndUnderAnyPayload) {
  Random random(1);
  for (int i = 0; i < 200; ++i) {
    const Vec3 up = exp_rotation(random.vector(0.6)) * Vec3::UnitZ();
    const Vec3 felt = exp_rotation(random.vector(0.02)) * up;
    for (const double load : {0.8, 1.0, 1.5}) {
      EXPECT_EQ(wrong_for(kGravity * felt, load * kMass * kGravity * up), 0.0);
    }
  }
}

TEST(RestCheck, AnImuThatIsUpsideDownOrHasAnotherUnitSignOrAxisIsWrong) {
  const Vec3 up(0.05, -0.1, 0.99);
  for (const double load : {0.8, 1.0, 1.5}) {
    const Vec3 force = load * kMass * kGravity * up;
    EXPECT_NEAR(wrong_for(-kGravity * up, force), 0.05, 1e-9);
    EXPECT_NEAR(wrong_for(up, force), 0.05, 1e-9) << "in g";
    EXPECT_NEAR(wrong_for({kGravity, 0.0, 0.0}, force), 0.05, 1e-9);
    EXPECT_NEAR(wrong_for(kGravity * up, force, {0.0, 0.0, 1.0}), 0.05, 1e-9) << "turns";
  }
}

TEST(RestCheck, LegsThatMoveOrBearLittleSayNothing) {
  const Vec3 weight(0.0, 0.0, kMass * kGravity), down(0.0, 0.0, -kGravity);
  EXPECT_EQ(wrong_for(down, 0.3 * weight), 0.0) << "it lies on its back";
  EXPECT_EQ(wrong_for(down, Vec3::Constant(kNaN)), 0.0);
  EXPECT_EQ(wrong_for(down, weight, Vec3::Zero(), JointVector::Constant(kNumLegJoints, 1.0)), 0.0);
}

}  // namespace
}  // namespace surefoot::estimation
