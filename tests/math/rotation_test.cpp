#include "surefoot/math/rotation.hpp"

#include "tests/support/random_motion.hpp"

#include <gtest/gtest.h>

namespace surefoot {
namespace {

using test::Random;

TEST(Rotation, skew_is_the_cross_product) {
  Random random(1);
  for (int trial = 0; trial < 20; ++trial) {
    const Vec3 a = random.vector(2.0);
    const Vec3 b = random.vector(2.0);
    EXPECT_LT((skew(a) * b - a.cross(b)).norm(), 1e-15);
  }
}

TEST(Rotation, log_undoes_exp_for_large_and_tiny_angles) {
  Random random(2);
  for (const double size : {1.8, 1e-2, 1e-4, 1e-5, 1e-9, 1e-200}) {
    for (int trial = 0; trial < 20; ++trial) {
      const Vec3 v = random.vector(size);
      EXPECT_LT((log_rotation(exp_rotation(v)) - v).norm(), 1e-14 * size + 1e-300) << size;
    }
  }
  EXPECT_EQ(log_rotation(Quat::Identity()), Vec3::Zero());
}

TEST(Rotation, log_takes_the_short_way_for_both_signs_of_a_quaternion) {
  Random random(3);
  for (int trial = 0; trial < 50; ++trial) {
    const Quat q = random.rotation();
    const Quat same(-q.w(), -q.x(), -q.y(), -q.z());
    EXPECT_LT((log_rotation(q) - log_rotation(same)).norm(), 1e-14);
    EXPECT_LE(log_rotation(q).norm(), kPi + 1e-12);
  }
}

TEST(Rotation, box_minus_is_the_turn_in_the_outer_frame) {
  Random random(4);
  for (int trial = 0; trial < 20; ++trial) {
    const Quat b = random.rotation();
    const Vec3 turn = random.vector(1.0);
    EXPECT_LT((box_minus(exp_rotation(turn) * b, b) - turn).norm(), 1e-13);
  }
}

TEST(Rotation, roll_pitch_yaw_are_those_that_made_a_rotation) {
  Random random(5);
  for (int trial = 0; trial < 50; ++trial) {
    const Vec3 angles(random.uniform(-3.0, 3.0), random.uniform(-1.5, 1.5),
                      random.uniform(-3.0, 3.0));
    const Mat3 R = from_roll_pitch_yaw(angles).toRotationMatrix();
    EXPECT_LT((roll_pitch_yaw(R) - angles).norm(), 1e-12);
    EXPECT_NEAR(yaw(R), angles.z(), 1e-12);
    const Mat3 without_tilt = rotation_about_z(angles.z());
    EXPECT_LT((without_tilt.col(0).head<2>().normalized() - R.col(0).head<2>().normalized()).norm(),
              1e-12);
  }
}

TEST(Rotation, clip_norm_shortens_and_keeps_the_direction) {
  EXPECT_EQ(clip_norm<3>(Vec3(0.1, 0.0, 0.0), 0.2), Vec3(0.1, 0.0, 0.0));
  EXPECT_LT((clip_norm<3>(Vec3(3.0, 0.0, -4.0), 0.5) - Vec3(0.3, 0.0, -0.4)).norm(), 1e-15);
  EXPECT_EQ(clip_norm<2>(Vec2::Zero(), 0.0), Vec2::Zero());
}

}  // namespace
}  // namespace surefoot
