#pragma once

#include "surefoot/gaits/parts/calibration_motion.hpp"
#include "surefoot/model/body_tree.hpp"
#include "surefoot/signals/kinematic_errors.hpp"
#include "surefoot/signals/sensor_reading.hpp"

namespace surefoot::test {

/// ANYmal B with legs that differ from their description, its feet rolling on the ground while its
/// torso makes the calibration's motion.
class TurningRobot {
 public:
  static constexpr double kPeriod = 0.0025;

  TurningRobot(const KinematicErrors& errors, const gaits::CalibrationOptions& motion);

  void tick();
  /// Before a tick: in it the base moves by this, in W [m]. The accelerometer does not tell.
  void shift_base(const Vec3& step);

  [[nodiscard]] double time() const { return time_; }
  [[nodiscard]] CalibrationStage stage() const { return motion_.stage(time_); }
  [[nodiscard]] const SensorReading& reading() const { return reading_; }
  [[nodiscard]] const Mat3& R_WB() const { return R_WB_; }
  [[nodiscard]] const model::RobotDescription& description() const { return description_; }
  /// Where the foot really is, in B.
  [[nodiscard]] Vec3 p_BF(Leg leg) const;
  /// Where legs with the given errors would put it.
  [[nodiscard]] Vec3 believed_p_BF(Leg leg, const KinematicErrors& errors) const;

 private:
  [[nodiscard]] Quat orientation(double time) const;
  void move_leg(Leg leg, const Mat3& R_before);

  model::RobotDescription description_;
  gaits::CalibrationMotion motion_;
  KinematicErrors errors_;
  PerLeg<model::LegChain> described_, chains_;
  double time_ = 0.0;
  Mat3 R_WB_ = Mat3::Identity();
  JointVector q_;
  PerLeg<Vec3> p_WF_{};  // from the base's origin, which stays where it is
  PerLeg<Mat3> R_BK_{};
  SensorReading reading_;
};

/// Root mean square over the feet of what is wrong between them, their common shift left out [m].
[[nodiscard]] double error_between_feet(const TurningRobot& robot, const KinematicErrors& believed);

}  // namespace surefoot::test
