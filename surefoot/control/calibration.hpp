#pragma once

#include "surefoot/control/last_tick.hpp"
#include "surefoot/estimation/com_calibration.hpp"
#include "surefoot/estimation/kinematic_calibration.hpp"
#include "surefoot/estimation/link_mass_estimator.hpp"

namespace surefoot::control {

/// Calibrates leg lengths, encoder zeros, link masses and payload. Does not allocate.
class Calibration {
 public:
  /// `base_mass` without payload [kg], `period` of the control loop [s].
  Calibration(const estimation::LinkMassOptions& options, const model::RobotDescription& robot,
              double base_mass, double period);

  /// One tick of a robot on its feet. `gyro_B` [rad/s]; `is_quiet`: it stands on all feet,
  /// undisturbed.
  void update(const RobotState& state, const model::Dynamics& dynamics, const Vec3& gyro_B,
              const LastTick& last, bool is_quiet) noexcept;
  /// The robot is off its feet: discards this calibration motion.
  void forget() noexcept { kinematics_.forget(); }

  [[nodiscard]] const KinematicErrors& kinematics() const { return kinematics_.errors(); }
  [[nodiscard]] BaseLoad load() const noexcept { return com_.load(); }
  /// The last turn and weighing gave both kinematics and load.
  [[nodiscard]] bool is_known() const { return kinematics_.knows_legs() && com_.knows_load(); }

 private:
  estimation::KinematicCalibration kinematics_;
  estimation::LinkMassEstimator link_masses_;
  estimation::ComCalibration com_;
};

}  // namespace surefoot::control
