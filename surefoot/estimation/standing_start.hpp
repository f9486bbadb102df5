#pragma once

#include "surefoot/base/scale.hpp"
#include "surefoot/estimation/base_motion.hpp"
#include "surefoot/math/line_fit.hpp"
#include "surefoot/signals/sensor_reading.hpp"

namespace surefoot::estimation {

/// Waits until a robot stands, and gives its motion at that time.
///
/// A robot whose driver starts while it stands counts as at rest at its first reading. One whose
/// sensors begin late falls until its drives have torques, hits the ground, and sways for seconds.
/// The estimate then begins in the sway, after standing for 0.1 s, with the legs' motion
/// (`base_motion`): their mean turn subtracted from the gyroscope gives its bias, their mean
/// acceleration subtracted from the accelerometer gives the vertical.
class StandingStart {
 public:
  struct State {
    Vec3 gyro_bias = Vec3::Zero();       ///< in B [rad/s]
    Vec3 specific_force = Vec3::Zero();  ///< in B, as if it were at rest [m/s²]
    Vec3 v_WB_B = Vec3::Zero();          ///< [m/s]
    double doubt = 1.0;                  ///< factor of the uncertainty against a robot at rest
  };

  /// `period` of the control loop [s]; joints of the legs and `scale` of the robot.
  explicit StandingStart(double period, int num_leg_joints = kNumLegJoints, const Scale& scale = {})
      : period_(period), num_leg_joints_(num_leg_joints), scale_(scale) {}

  /// One tick before the start: does the robot stand? `p_BC` and `v_BC` as in `base_motion`. False
  /// while numbers are missing, or legs and gyroscope disagree, as with a foot in the air.
  [[nodiscard]] bool stands(const SensorReading& reading, const JointVector& joint_velocity,
                            const PerLeg<Vec3>& p_BC, const PerLeg<Vec3>& v_BC) noexcept;

  /// Discards the readings so far: the robot must stand for 0.1 s.
  void restart() noexcept;

  /// Its state, once it stands.
  [[nodiscard]] State state() const noexcept;

 private:
  /// One sample a tick since it stands.
  struct Window {
    LineFit gyro, force, v, w;
  };

  double period_;
  int num_leg_joints_;
  Scale scale_;
  double time_ = kNaN;
  bool has_waited_ = false;
  Window window_;
};

}  // namespace surefoot::estimation
