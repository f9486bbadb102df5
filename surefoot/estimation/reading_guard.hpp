#pragma once

#include "surefoot/estimation/guarded_values.hpp"
#include "surefoot/estimation/imu_step_check.hpp"
#include "surefoot/estimation/reading_guard_options.hpp"
#include "surefoot/model/description.hpp"

namespace surefoot::estimation {

/// Finds impossible samples before anything reads them, and replaces them.
///
/// A sample is faulty if it is not a number, out of range, too far from the value predicted from
/// the last good one, overdue or too old, or, for the IMU, repeatedly bit-identical. Joints
/// then continue with their velocity; torques, gyroscope and accelerometer hold the last good
/// value. Nothing of a faulty sample is kept. The health reports the age of the last good
/// sample, by which Safety decides on a stop. Does not allocate.
class ReadingGuard {
 public:
  /// `period` of the control loop [s].
  ReadingGuard(const ReadingGuardOptions& options, const model::RobotDescription& robot,
               double period);

  /// One tick. `joint_velocity` is of the tick before [rad/s]. A reading whose clock is not a
  /// number, stands still, goes back, or leaps by more than 0.1 s gives no samples: all sensors
  /// count as silent, but encoders whose angles still change as late. The first reading after a
  /// leap of more than 4 periods gives none either; it is confirmed if the next one continues from
  /// it, by no more than one and a half times the leap.
  void update(const SensorReading& reading, const JointVector& joint_velocity) noexcept {
    update(reading, joint_velocity, reading);
  }
  /// The same with the driver's raw reading `given`, if `reading` has corrections that change from
  /// tick to tick: bit-identical numbers are searched in `given`.
  void update(const SensorReading& reading, const JointVector& joint_velocity,
              const SensorReading& given) noexcept;

  /// The legs' verdict of the tick before on the doubted step; counts for the next update.
  void judge_imu_step(ImuStep step) { imu_step_ = step; }

  /// Loose: the robot is not controlled, so joint velocities are unknown, and the next sample can
  /// confirm a jump of any size.
  void set_loose(bool loose) { is_loose_ = loose; }

  /// Within `patience` the IMU's samples, or half of the joints', made unusual steps, accepted or
  /// not: impact or fault.
  [[nodiscard]] bool is_shaken() const;

  /// False if the reading's clock was wrong as above.
  [[nodiscard]] bool clock_is_right() const { return clock_is_right_; }
  /// The reading with replacements and accepted sample times (SampleWatch).
  [[nodiscard]] const SensorReading& repaired() const { return repaired_; }
  /// The same with NaN for joint angles that are faulty, held (without information on the motion
  /// since) or of an unusual age. With a wrong clock it has no time and no angles; if that lasts
  /// longer than `patience` and the angles change within 0.2 s, the reading's plausible ones.
  [[nodiscard]] const SensorReading& measured() const { return measured_; }
  [[nodiscard]] const SensorHealth& health() const { return health_; }
  /// repaired() with the IMU's raw samples, as long as they are in range.
  [[nodiscard]] const SensorReading& offered() const { return offered_; }
  /// Time since each joint's last good angle [s].
  [[nodiscard]] JointVector encoder_age() const;
  /// Age of repaired()'s joints and IMU samples [s].
  [[nodiscard]] double joint_lag() const { return encoder_watch_.lag(); }
  [[nodiscard]] double imu_lag() const { return imu_watch_.lag(); }
  /// Usual delay of joint angle and torque samples [s]; a later or held one does not change it.
  [[nodiscard]] double encoder_delay() const { return encoder_watch_.delay(); }
  [[nodiscard]] double torque_delay() const { return torque_watch_.delay(); }

 private:
  /// One of the IMU's two instruments.
  struct Instrument {
    GuardedValues<Vec3> values{3};
    Vec3 last = Vec3::Constant(kNaN);  // sample in range, good or not
    double last_time = kNaN;           // of that sample [s]
    double stepped = kNaN;             // time of the last large step [s]
    Vec3 given = Vec3::Constant(kNaN);
    double given_since = kNaN;  // of the first sample with these numbers [s]
    int repeats = 0;
  };

  [[nodiscard]] bool imu_is_shaken() const;
  /// Within `patience` both instruments stepped.
  [[nodiscard]] bool is_impact() const;
  [[nodiscard]] bool accepts_imu_step();
  [[nodiscard]] bool accepts_clock(double time) noexcept;
  void miss(const SensorReading& reading, const JointVector& given_q) noexcept;
  [[nodiscard]] GuardedValues<JointVector>::Limits angle_limits(const JointVector& unseen) const;
  void take_joints(const SensorReading& reading, const JointVector& joint_velocity, double dt);
  void take_imu(const SensorReading& reading, const SensorReading& given);
  void note_step(Instrument& instrument, const Vec3& value, const Vec3& large, double range) const;
  void take(Instrument& instrument, const Vec3& value, const Vec3& given,
            const GuardedValues<Vec3>::Limits& limits);
  void describe(const SensorReading& reading);

  ReadingGuardOptions options_;
  double period_;
  JointVector velocity_limit_, torque_limit_;
  SampleWatch encoder_watch_, torque_watch_, imu_watch_;
  GuardedValues<JointVector> angles_, torques_;
  Instrument gyro_, accelerometer_;
  double time_ = kNaN;
  double lost_ = kNaN;      // time without a good sample after which any value is accepted [s]
  double leapt_to_ = kNaN;  // refused time of the reading before [s]
  int missed_ = 0;          // readings since the last with a right clock
  int still_ = 0;           // of these, since their angles last changed
  bool moves_ = false;      // their angles change
  JointVector given_q_;     // of the last reading, with any clock
  bool clock_is_right_ = true;
  bool is_loose_ = false;
  ImuStep imu_step_ = ImuStep::not_judged;
  SensorReading repaired_, measured_, offered_;
  SensorHealth health_;
};

}  // namespace surefoot::estimation
