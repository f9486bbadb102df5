#pragma once

#include "surefoot/control/controller.hpp"
#include "surefoot/control/last_tick.hpp"
#include "surefoot/control/part_fault.hpp"
#include "surefoot/estimation/lift_detector.hpp"
#include "surefoot/estimation/reading_guard.hpp"
#include "surefoot/estimation/rest_check.hpp"
#include "surefoot/estimation/sensor_consistency.hpp"
#include "surefoot/model/robot_model.hpp"

namespace surefoot::control {

/// Mode of the robot before this tick.
struct RobotMode {
  bool stands = true;        ///< on its feet, neither lifted nor lying
  bool has_begun = false;    ///< there was a good tick
  bool has_stopped = false;  ///< for good
};

/// Estimates the robot's state in two steps: base and joints, then, with the dynamics at these,
/// foot forces, external forces and slips. Also reports sensors that contradict the others. Does
/// not allocate after construction.
class StateEstimation {
 public:
  StateEstimation(const ControllerOptions& options, estimation::StateEstimator& estimator,
                  model::RobotModel& model);

  /// Estimates base and joints. False: the state can't be used for planning. Writes sensors that
  /// contradict each other at rest into `health`.
  [[nodiscard]] bool estimate_motion(const estimation::ReadingGuard& seen, const LastTick& last,
                                     const RobotMode& mode, SensorHealth& health) noexcept;
  /// Completes the state, with its dynamics. Writes contradicting sensors into `health`.
  void estimate_forces(const estimation::ReadingGuard& seen, const model::Dynamics& dynamics,
                       const LastTick& last, const RobotMode& mode, SensorHealth& health) noexcept;

  /// The robot has stood up: discards the external force and leg weights estimated before.
  void restart_standing(const StateEstimation& at_start) noexcept;
  /// The robot is off its feet: discards comparisons of its sensors.
  void forget_contacts() noexcept { consistency_.forget(); }

  [[nodiscard]] const RobotState& state() const { return state_; }
  [[nodiscard]] const estimation::LiftDetector& lift() const { return lift_; }
  /// Observed [rad/s].
  [[nodiscard]] const JointVector& joint_velocity() const { return joint_velocity_; }
  /// The legs' verdict on a step of the IMU at this tick; empty if not checked.
  [[nodiscard]] const std::optional<estimation::ImuStep>& imu_step() const { return imu_step_; }
  /// What the estimator did wrong at this tick.
  [[nodiscard]] const PartFault& fault() const { return fault_; }
  /// There was a plausible state.
  [[nodiscard]] bool has_begun() const;

 private:
  [[nodiscard]] bool ask_estimator(const estimation::ReadingGuard& seen, const LastTick& last,
                                   const RobotMode& mode) noexcept;
  void take_joints_alone(const estimation::ReadingGuard& seen) noexcept;
  void observe_joints(const estimation::ReadingGuard& seen) noexcept;
  [[nodiscard]] bool fits_at_rest(const estimation::ReadingGuard& seen,
                                  SensorHealth& health) noexcept;
  void forget_lost_joints(const estimation::ReadingGuard& seen,
                          const SensorHealth& health) noexcept;
  void compare_sensors(const estimation::ReadingGuard& seen, const model::Dynamics& dynamics,
                       const LastTick& last, SensorHealth& health) noexcept;

  estimation::StateEstimator* estimator_;
  model::RobotModel* model_;
  double bridge_time_;  // [s]
  estimation::RestCheck rest_check_;
  estimation::ContactForceEstimator contact_force_;
  estimation::SlipDetector slip_;
  estimation::ExternalForceEstimator external_force_;
  estimation::SensorConsistency consistency_;
  estimation::LiftDetector lift_;
  JointVector joint_velocity_;  // [rad/s]
  KinematicErrors kinematics_before_;
  double time_ = kNaN;  // of the last plausible state [s]
  std::optional<estimation::ImuStep> imu_step_;
  RobotState state_;
  PartFault fault_;
};

}  // namespace surefoot::control
