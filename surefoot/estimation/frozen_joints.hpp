#pragma once

#include "surefoot/estimation/sensor_consistency_options.hpp"
#include "surefoot/model/dynamics.hpp"
#include "surefoot/signals/motion_plan.hpp"
#include "surefoot/signals/sensor_reading.hpp"

#include <array>

namespace surefoot {

/// Finds encoders and joint torque sensors that give the same number bit by bit, while their
/// samples go on, though the joint is asked to move or the command to it changes.
///
/// A leg's joints must move by q̇ = J⁺ (v_F − J_b u_b), with v_F = 0 of a contact point that stands
/// and the planned velocity of a foot in the air. A joint at rest may well give the same number;
/// one that turned by `motion` can't. Does not allocate.
class FrozenJoints {
 public:
  FrozenJoints(const FrozenJointOptions& options, double period)
      : options_(options), period_(period) {}

  /// One tick. `plan` and `command` are of the tick before.
  void update(const SensorReading& reading, const Dynamics& dynamics, const MotionPlan& plan,
              const JointVector& command) noexcept;

  /// Of an encoder that is frozen; −1: none.
  [[nodiscard]] int encoder() const { return encoder_; }
  [[nodiscard]] int torque() const { return torque_; }
  /// Since these gave another number [s].
  [[nodiscard]] double encoder_age() const { return age(encoder_, same_angle_); }
  [[nodiscard]] double torque_age() const { return age(torque_, same_torque_); }
  /// What the joints should have moved by since their encoders gave another number [rad].
  [[nodiscard]] const JointVector& unseen_motion() const { return unseen_; }

 private:
  [[nodiscard]] double age(int joint, const std::array<int, kNumJoints>& ticks) const {
    return joint < 0 ? 0.0 : period_ * ticks[static_cast<std::size_t>(joint)];
  }
  void look_at_angles(const SensorReading& reading, const JointVector& motion);
  void look_at_torques(const SensorReading& reading, const JointVector& command);

  FrozenJointOptions options_;
  double period_;
  JointVector q_ = JointVector::Constant(kNaN), unseen_ = JointVector::Zero();
  JointVector measured_ = JointVector::Constant(kNaN), command_ = JointVector::Zero();
  std::array<int, kNumJoints> same_angle_{}, same_torque_{}, off_{};  // [ticks]
  double encoder_time_ = kNaN, torque_time_ = kNaN;
  int encoder_ = -1, torque_ = -1;
};

}  // namespace surefoot
