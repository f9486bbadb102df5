#pragma once

#include "surefoot/estimation/sensor_consistency_options.hpp"
#include "surefoot/model/dynamics.hpp"
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
  struct Frozen {
    int count = 0;
    int joint = -1;    ///< the only one; −1: none, or several
    double age = 0.0;  ///< since the first of them gave another number [s]
  };

  FrozenJoints(const FrozenJointOptions& options, double period)
      : options_(options), period_(period) {}

  /// One tick. `stands`: which feet the plan lets carry; `v_WF`: how fast it wants those in the air
  /// [m/s]; `command`: torques [N·m]; all of the tick before.
  void update(const SensorReading& reading, const Dynamics& dynamics, const PerLeg<bool>& stands,
              const PerLeg<Vec3>& v_WF, const JointVector& command) noexcept;

  /// What was seen before says nothing.
  void forget() noexcept { *this = FrozenJoints(options_, period_); }

  /// Which are frozen, and since when. Beside an encoder that is found, others that have stood
  /// still though a quarter of that was asked of them count, too.
  [[nodiscard]] const Frozen& encoders() const { return encoders_; }
  [[nodiscard]] const Frozen& torques() const { return torques_; }
  /// What the joints should have moved by since their encoders gave another number [rad].
  [[nodiscard]] const JointVector& unseen_motion() const { return unseen_; }

 private:
  void add(Frozen& frozen, int joint, int same_ticks) const;
  void look_at_angles(const SensorReading& reading, const JointVector& motion);
  void look_at_torques(const SensorReading& reading, const JointVector& command);

  FrozenJointOptions options_;
  double period_;
  JointVector q_ = JointVector::Constant(kNaN), unseen_ = JointVector::Zero();
  JointVector measured_ = JointVector::Constant(kNaN), command_ = JointVector::Zero();
  std::array<int, kNumJoints> same_angle_{}, same_torque_{}, off_{};  // [ticks]
  double encoder_time_ = kNaN, torque_time_ = kNaN;
  Frozen encoders_, torques_;
};

}  // namespace surefoot
