#pragma once

#include "surefoot/base/scale.hpp"
#include "surefoot/estimation/frozen_joints.hpp"
#include "surefoot/estimation/imu_check.hpp"
#include "surefoot/estimation/imu_step_check.hpp"
#include "surefoot/estimation/torque_check.hpp"
#include "surefoot/signals/sensor_health.hpp"

namespace surefoot::estimation {

/// Inputs of a tick for cross-checks of the sensors.
struct ConsistencyInputs {
  const RobotState& state;
  const model::Dynamics& dynamics;
  const PerLeg<bool>& stands;  ///< the feet planned to carry load, of the tick before
  const PerLeg<Vec3>& v_WF;    ///< planned velocities of the swing feet [m/s]
  const Vec3& normal_W;        ///< of the terrain
  const JointVector& command;  ///< torques of the tick before [N·m]
};

/// Checks the sensors against each other: the IMU against the stance feet (`ImuCheck`,
/// `ImuStepCheck`), joints against the requested motion (`FrozenJoints`), joint torques against the
/// command and against plausible pushes and loads (`TorqueCheck`). Does not allocate after
/// construction.
class SensorConsistency {
 public:
  /// `period` of the control loop [s]; `scale` and number of legs of the robot.
  SensorConsistency(const SensorConsistencyOptions& options, double period,
                    const JointStops& stops = {}, int num_legs = kNumLegs, const Scale& scale = {})
      : enabled_(options.enabled),
        rate_(scale.rate()),
        imu_(options.imu, period, num_legs),
        imu_step_(period),
        frozen_(options.frozen, period, stops),
        torques_(options.torques, period, static_cast<int>(stops.min.size())) {}

  /// One tick, with the reading as repaired by `ReadingGuard`, and with the `offered` raw samples
  /// of the IMU. Writes contradictions into `health`, unless a worse fault is known.
  void update(const SensorReading& reading, const SensorReading& offered,
              const ConsistencyInputs& known, SensorHealth& health) noexcept;
  /// The legs' verdict on a step of the IMU that is doubted at this tick.
  [[nodiscard]] ImuStep imu_step() const { return imu_step_.verdict(); }
  /// The leg geometry has changed: discards comparisons with it.
  void legs_have_changed() noexcept;
  /// The robot is off its feet: discards the past.
  void forget() noexcept;

 private:
  bool enabled_;
  double rate_;  // of the robot against that of scale 1
  ImuCheck imu_;
  ImuStepCheck imu_step_;
  FrozenJoints frozen_;
  TorqueCheck torques_;
  double encoder_time_ = kNaN;  // [s]
  bool jumped_ = false;         // did the IMU jump in the tick before, and its values then:
  Vec3 held_force_ = Vec3::Constant(kNaN), held_turn_ = Vec3::Constant(kNaN);
};

}  // namespace surefoot::estimation
