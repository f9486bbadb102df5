#pragma once

#include "surefoot/control/controller.hpp"
#include "surefoot/control/last_tick.hpp"
#include "surefoot/estimation/lift_detector.hpp"
#include "surefoot/estimation/reading_guard.hpp"
#include "surefoot/estimation/rest_check.hpp"
#include "surefoot/estimation/sensor_consistency.hpp"
#include "surefoot/model/robot_model.hpp"

namespace surefoot::control {

/// What the robot was about before this tick.
struct RobotMode {
  bool stands = true;        ///< on its feet; else it is lifted, or lies
  bool has_begun = false;    ///< there was a good tick
  bool has_stopped = false;  ///< for good
};

/// Makes the state that the controller believes, in two steps: base and joints (`follow`), then,
/// with the dynamics there, what the ground and others push with, and which feet slide (`feel`).
/// Also says which sensors contradict the rest. Does not allocate after construction.
class StateEstimation {
 public:
  StateEstimation(const ControllerOptions& options, estimation::StateEstimator& estimator,
                  model::RobotModel& model);

  /// Base and joints by this tick's sensors. False: the state is not one to plan with. Sensors that
  /// contradict each other at rest are written into `health`.
  [[nodiscard]] bool follow(const estimation::ReadingGuard& seen, const LastTick& last,
                            const RobotMode& mode, SensorHealth& health) noexcept;
  /// Completes the state, with the dynamics at it. As above.
  void feel(const estimation::ReadingGuard& seen, const model::Dynamics& dynamics,
            const LastTick& last, const RobotMode& mode, SensorHealth& health) noexcept;

  /// It has come to stand: of who pushed it, and of what its legs were felt to weigh as they lay on
  /// the ground, nothing holds any more.
  void stand_anew(const StateEstimation& at_start) noexcept;
  /// The robot is not on its feet: nothing of before says anything of its sensors.
  void forget_contacts() noexcept { consistency_.forget(); }

  [[nodiscard]] const RobotState& state() const { return state_; }
  [[nodiscard]] const estimation::LiftDetector& lift() const { return lift_; }
  /// Of the joints, observed [rad/s].
  [[nodiscard]] const JointVector& joint_velocity() const { return joint_velocity_; }
  /// What the legs say of a step of the IMU at this tick; empty: they were not asked.
  [[nodiscard]] const std::optional<estimation::ImuStep>& imu_step() const { return imu_step_; }
  /// There was a state that could be.
  [[nodiscard]] bool has_begun() const;

 private:
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
  double time_ = kNaN;  // of the last state that could be [s]
  std::optional<estimation::ImuStep> imu_step_;
  RobotState state_;
};

}  // namespace surefoot::control
