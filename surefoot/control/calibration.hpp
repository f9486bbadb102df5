#pragma once

#include "surefoot/control/last_tick.hpp"
#include "surefoot/estimation/com_calibration.hpp"
#include "surefoot/estimation/kinematic_calibration.hpp"
#include "surefoot/estimation/link_mass_estimator.hpp"

namespace surefoot::control {

/// What the robot learns of itself: lengths and zeros of its legs, masses of its links, its load.
/// Does not allocate.
class Calibration {
 public:
  /// `base_mass` without a load [kg], `period` of the control loop [s].
  Calibration(const estimation::LinkMassOptions& options, const model::RobotDescription& robot,
              double base_mass, double period);

  /// One tick of a robot on its feet. `gyro_B` [rad/s]; `is_quiet`: it stands on all feet and
  /// nothing disturbs it.
  void update(const RobotState& state, const model::Dynamics& dynamics, const Vec3& gyro_B,
              const LastTick& last, bool is_quiet) noexcept;
  /// The robot is off its feet: what was heard of this turn is worth nothing.
  void forget() noexcept { kinematics_.forget(); }

  [[nodiscard]] const KinematicErrors& kinematics() const { return kinematics_.errors(); }
  [[nodiscard]] BaseLoad load() const noexcept { return com_.load(); }
  /// Both are known from the last turn and weighing.
  [[nodiscard]] bool is_known() const { return kinematics_.knows_legs() && com_.knows_load(); }

 private:
  estimation::KinematicCalibration kinematics_;
  estimation::LinkMassEstimator link_masses_;
  estimation::ComCalibration com_;
};

}  // namespace surefoot::control
