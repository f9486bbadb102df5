#pragma once

#include "surefoot/estimation/frozen_joints.hpp"
#include "surefoot/estimation/imu_check.hpp"
#include "surefoot/estimation/imu_step_check.hpp"
#include "surefoot/estimation/torque_check.hpp"
#include "surefoot/signals/sensor_health.hpp"

namespace surefoot {

/// What a tick knows beside the reading, for the sensors to be held against.
struct ConsistencyInputs {
  const RobotState& state;
  const Dynamics& dynamics;
  const PerLeg<bool>& stands;  ///< which feet the plan of the tick before lets carry
  const PerLeg<Vec3>& v_WF;    ///< how fast it wants the feet in the air [m/s]
  const Vec3& normal_W;        ///< of the terrain
  const JointVector& command;  ///< torques of the tick before [N·m]
};

/// Holds the sensors against each other: IMU against the feet that stand (`ImuCheck`,
/// `ImuStepCheck`), joints
/// against what is asked of them (`FrozenJoints`), joint torques against what was commanded and
/// what can push or load the robot (`TorqueCheck`). Does not allocate after construction.
class SensorConsistency {
 public:
  SensorConsistency(const SensorConsistencyOptions& options, double period)
      : enabled_(options.enabled),
        imu_(options.imu, period),
        imu_step_(period),
        frozen_(options.frozen, period),
        torques_(options.torques, period) {}

  /// One tick, with the reading as `ReadingGuard` repairs it, and with the IMU's samples as they
  /// were `offered`. What contradicts the others is written into `health`, where nothing worse is
  /// known of it.
  void update(const SensorReading& reading, const SensorReading& offered,
              const ConsistencyInputs& known, SensorHealth& health) noexcept;
  /// What the legs say of a step of the IMU that is doubted at this tick.
  [[nodiscard]] ImuStep imu_step() const { return imu_step_.verdict(); }
  /// The legs are found to be other than was believed: what was held against them says nothing.
  void legs_have_changed() noexcept;
  /// The robot is not on its feet: nothing that was before says anything.
  void forget() noexcept;

 private:
  bool enabled_;
  ImuCheck imu_;
  ImuStepCheck imu_step_;
  FrozenJoints frozen_;
  TorqueCheck torques_;
  double encoder_time_ = kNaN;  // [s]
  bool jumped_ = false;         // the IMU, in the tick before, when it gave these:
  Vec3 held_force_ = Vec3::Constant(kNaN), held_turn_ = Vec3::Constant(kNaN);
};

}  // namespace surefoot
