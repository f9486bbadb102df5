#include "tests/support/turning_robot.hpp"

#include "surefoot/math/rotation.hpp"
#include "tests/support/anymal_b.hpp"

#include <cmath>

namespace surefoot::test {

TurningRobot::TurningRobot(const KinematicErrors& errors, const gaits::CalibrationOptions& motion)
    : description_(anymal_b()), motion_(motion), errors_(errors), q_(description_.q_nominal) {
  const model::BodyTree tree =
      model::make_body_tree(description_, model::read_urdf(description_.urdf_path));
  for (const Leg leg : kLegs) {
    const std::size_t k = index(leg);
    described_[k] = tree.legs[k].chain;
    chains_[k] = described_[k].lengthened(errors.thigh[k], errors.shank[k]);
    p_WF_[k] = p_BF(leg);
    R_BK_[k] = chains_[k].shank_in_base(q_.segment<3>(first_joint(leg)));
  }
  reading_.time = -kPeriod;
  tick();
}

void TurningRobot::tick() {
  time_ = reading_.time + kPeriod;
  const Mat3 R_before = R_WB_;
  R_WB_ = orientation(time_).toRotationMatrix();
  for (const Leg leg : kLegs) move_leg(leg, R_before);
  reading_.time = reading_.encoder_time = reading_.imu_time = reading_.torque_time = time_;
  reading_.q = q_ + errors_.zero;
  reading_.torque.setZero();
  const Quat before = orientation(time_ - 0.5 * kPeriod),
             after = orientation(time_ + 0.5 * kPeriod);
  reading_.gyro = log_rotation(before.conjugate() * after) / kPeriod;
  reading_.accelerometer = kGravity * R_WB_.transpose().col(2);
}

void TurningRobot::shift_base(const Vec3& step) {
  for (Vec3& p : p_WF_) p -= step;
}

Quat TurningRobot::orientation(double time) const {
  return from_roll_pitch_yaw(motion_.at(time).p);
}

// Twice, because how far the sphere rolls depends on how the leg turns.
void TurningRobot::move_leg(Leg leg, const Mat3& R_before) {
  const std::size_t k = index(leg);
  const Vec3 p_before = p_WF_[k];
  const Mat3 R_WK_before = R_before * R_BK_[k];
  for (int i = 0; i < 2; ++i) {
    const Vec3 guess = q_.segment<3>(first_joint(leg));
    Vec3 q;
    (void)chains_[k].inverse_kinematics(R_WB_.transpose() * p_WF_[k], guess, q);
    q_.segment<3>(first_joint(leg)) = q;
    R_BK_[k] = chains_[k].shank_in_base(q);
    const Vec3 turn = log_rotation(Quat(Mat3(R_WB_ * R_BK_[k] * R_WK_before.transpose())));
    p_WF_[k] = p_before + turn.cross(description_.legs[k].foot_radius * Vec3::UnitZ());
  }
}

Vec3 TurningRobot::p_BF(Leg leg) const {
  return chains_[index(leg)].foot_in_base(q_.segment<3>(first_joint(leg)));
}

Vec3 TurningRobot::believed_p_BF(Leg leg, const KinematicErrors& errors) const {
  const JointVector q = q_ + errors_.zero - errors.zero;
  return described_[index(leg)]
      .lengthened(errors.thigh[index(leg)], errors.shank[index(leg)])
      .foot_in_base(q.segment<3>(first_joint(leg)));
}

double error_between_feet(const TurningRobot& robot, const KinematicErrors& believed) {
  PerLeg<Vec3> errors;
  Vec3 mean = Vec3::Zero();
  for (const Leg leg : kLegs) {
    errors[index(leg)] = robot.believed_p_BF(leg, believed) - robot.p_BF(leg);
    mean += errors[index(leg)] / kNumLegs;
  }
  double squares = 0.0;
  for (const Vec3& error : errors) squares += (error - mean).squaredNorm() / kNumLegs;
  return std::sqrt(squares);
}

}  // namespace surefoot::test
