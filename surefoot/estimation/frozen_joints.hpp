#pragma once

#include "surefoot/estimation/sensor_consistency_options.hpp"
#include "surefoot/model/dynamics.hpp"
#include "surefoot/signals/sensor_reading.hpp"

#include <array>

namespace surefoot::estimation {

/// Mechanical limits of the joints [rad].
struct JointStops {
  JointVector min = JointVector::Constant(kNumLegJoints, -kInfinity),
              max = JointVector::Constant(kNumLegJoints, kInfinity);

  /// Within a hundredth of a radian of a stop, or beyond.
  [[nodiscard]] bool holds(Eigen::Index joint, double q) const {
    constexpr double kNear = 0.01;
    return q < min[joint] + kNear || q > max[joint] - kNear;
  }
};

/// Finds frozen encoders and joint torque sensors: bit-identical values in new samples, though the
/// joint should move or its command changes.
///
/// An arm's joints are looked at only for their torques. A leg's joints must move by q̇ = J⁺ (v_F −
/// J_b u_b), with v_F = 0 of a stance foot's contact point and the planned velocity of a swing
/// foot. A joint at rest may repeat its value; one that should have turned by `motion` can't,
/// unless it stands at its stop. Does not allocate.
class FrozenJoints {
 public:
  struct Frozen {
    int count = 0;
    int joint = -1;    ///< the only one; −1: none, or several
    double age = 0.0;  ///< since the value of any of them last changed [s]
  };

  FrozenJoints(const FrozenJointOptions& options, double period, const JointStops& stops = {})
      : options_(options),
        period_(period),
        stops_(stops),
        q_(JointVector::Constant(stops.min.size(), kNaN)),
        unseen_(JointVector::Zero(stops.min.size())),
        measured_(q_),
        command_(unseen_) {}

  /// One tick. `stands`: the feet planned to carry load; `v_WF`: planned velocity of swing feet
  /// [m/s]; `command`: torques [N·m]; all of the tick before.
  void update(const SensorReading& reading, const model::Dynamics& dynamics,
              const PerLeg<bool>& stands, const PerLeg<Vec3>& v_WF,
              const JointVector& command) noexcept;

  /// Discards the past.
  void forget() noexcept { *this = FrozenJoints(options_, period_, stops_); }

  /// The frozen sensors. Next to a frozen encoder, another that has not moved for a quarter of the
  /// motion counts, too.
  [[nodiscard]] const Frozen& encoders() const { return encoders_; }
  [[nodiscard]] const Frozen& torques() const { return torques_; }

 private:
  void add(Frozen& frozen, int joint, int same_ticks) const;
  void look_at_angles(const SensorReading& reading, const JointVector& motion);
  void look_at_torques(const SensorReading& reading, const JointVector& command);

  FrozenJointOptions options_;
  double period_;
  JointStops stops_;
  JointVector q_;
  JointVector unseen_;  // expected motion since the value last changed [rad]
  JointVector measured_, command_;
  std::array<int, kMaxJoints> same_angle_{}, same_torque_{}, off_{};  // [ticks]
  double encoder_time_ = kNaN, torque_time_ = kNaN;
  Frozen encoders_, torques_;
};

}  // namespace surefoot::estimation
