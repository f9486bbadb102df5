#include "surefoot/estimation/frozen_joints.hpp"

#include "surefoot/model/leg_jacobian.hpp"

#include <cmath>

namespace surefoot::estimation {
namespace {

/// Time constant: the velocity error of a base at rest must not add up to a motion [s].
constexpr double kMotionMemory = 2.0;
constexpr double kSecondJointShare = 0.25;  // of the motion, next to another frozen joint

/// Velocities of a leg's joints that hold its stance foot or move its swing foot as planned
/// [rad/s].
Vec3 desired_velocity(const model::Dynamics& dynamics, bool stands, const Vec3& v_WF, Leg leg) {
  const std::size_t k = index(leg);
  const model::PointKinematics& point = stands ? dynamics.contact[k] : dynamics.foot[k];
  const Vec3 target = stands ? Vec3(Vec3::Zero()) : v_WF;
  const Vec3 by_base = point.J.leftCols<6>() * dynamics.u.head<6>();
  return model::damped_inverse(model::leg_jacobian(point, leg), dynamics.scale) *
         (target - by_base);
}

}  // namespace

void FrozenJoints::update(const SensorReading& reading, const model::Dynamics& dynamics,
                          const PerLeg<bool>& stands, const PerLeg<Vec3>& v_WF,
                          const JointVector& command) noexcept {
  JointVector motion = JointVector::Zero(q_.size());
  for (const Leg leg : stands.legs()) {
    const std::size_t k = index(leg);
    motion.segment<kJointsPerLeg>(first_joint(leg)) =
        period_ * desired_velocity(dynamics, stands[k], v_WF[k], leg);
  }
  look_at_angles(reading, motion);
  look_at_torques(reading, command);
}

void FrozenJoints::look_at_angles(const SensorReading& reading, const JointVector& motion) {
  const bool is_new = reading.encoder_time > encoder_time_;
  encoder_time_ = reading.encoder_time;
  const double kept = 1.0 - period_ / kMotionMemory;
  for (int i = 0; i < q_.size(); ++i) {
    int& same = same_angle_[static_cast<std::size_t>(i)];
    const bool moves =
        reading.q[i] != q_[i] || !std::isfinite(motion[i]) || stops_.holds(i, reading.q[i]);
    same = moves ? 0 : same + 1;
    unseen_[i] = moves ? 0.0 : kept * unseen_[i] + motion[i];
  }
  q_ = reading.q;
  encoders_ = {};
  const bool finds = is_new && unseen_.cwiseAbs().maxCoeff() > options_.motion;
  for (int i = 0; i < q_.size() && finds; ++i) {
    const int same = same_angle_[static_cast<std::size_t>(i)];
    if (same > 1 && std::abs(unseen_[i]) > kSecondJointShare * options_.motion)
      add(encoders_, i, same);
  }
}

void FrozenJoints::add(Frozen& frozen, int joint, int same_ticks) const {
  frozen.joint = frozen.count == 0 ? joint : -1;
  ++frozen.count;
  frozen.age = std::fmax(frozen.age, period_ * same_ticks);
}

void FrozenJoints::look_at_torques(const SensorReading& reading, const JointVector& command) {
  const bool is_new = reading.torque_time > torque_time_;
  torque_time_ = reading.torque_time;
  torques_ = {};
  for (int i = 0; i < q_.size(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    const bool moves = reading.torque[i] != measured_[i];
    same_torque_[k] = moves ? 0 : same_torque_[k] + 1;
    if (moves) command_[i] = command[i];
    const bool is_off = std::abs(command[i] - command_[i]) > options_.torque;
    off_[k] = !moves && is_off ? off_[k] + 1 : 0;
    if (is_new && period_ * off_[k] > options_.duration) add(torques_, i, same_torque_[k]);
  }
  measured_ = reading.torque;
}

}  // namespace surefoot::estimation
