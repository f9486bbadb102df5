#pragma once

#include "surefoot/estimation/base_motion.hpp"
#include "surefoot/math/line_fit.hpp"
#include "surefoot/signals/sensor_reading.hpp"

namespace surefoot {

/// Waits until a robot stands, and says how it moves then.
///
/// A robot that its driver starts as it stands is believed to be at rest with its first reading.
/// One whose sensors begin late falls until its drives have torques, hits the ground, and then
/// sways on its legs for seconds. It is begun in the sway, when it has stood for 0.1 s, by what its
/// legs say of that (`base_motion`): their mean turn is taken off the gyroscope's to find its bias,
/// their mean acceleration off the accelerometer's to find the vertical.
class StandingStart {
 public:
  struct State {
    Vec3 gyro_bias = Vec3::Zero();       ///< in B [rad/s]
    Vec3 specific_force = Vec3::Zero();  ///< in B, as if it were at rest [m/s²]
    Vec3 v_WB_B = Vec3::Zero();          ///< [m/s]
    double doubt = 1.0;                  ///< how many times less is known than of one at rest
  };

  /// `period` of the control loop [s].
  explicit StandingStart(double period) : period_(period) {}

  /// One tick before the start: does the robot stand? `p_BC` and `v_BC` as `base_motion` wants
  /// them. Not while numbers are missing, nor where legs and gyroscope disagree, as they do where a
  /// foot is in the air.
  [[nodiscard]] bool stands(const SensorReading& reading, const JointVector& joint_velocity,
                            const PerLeg<Vec3>& p_BC, const PerLeg<Vec3>& v_BC) noexcept;

  /// The readings so far are worth nothing: it has to be seen to stand for 0.1 s.
  void begin_anew() noexcept;

  /// Now that it does.
  [[nodiscard]] State state() const noexcept;

 private:
  /// Since it stands, each a tick.
  struct Window {
    LineFit gyro, force, v, w;
  };

  double period_;
  double time_ = kNaN;
  bool has_waited_ = false;
  Window window_;
};

}  // namespace surefoot
