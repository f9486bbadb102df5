#pragma once

#include "surefoot/estimation/guarded_values.hpp"
#include "surefoot/estimation/imu_step_check.hpp"
#include "surefoot/estimation/reading_guard_options.hpp"
#include "surefoot/model/description.hpp"

namespace surefoot {

/// Stands between the sensors and everything that reads them: finds samples that can't be right,
/// and fills in for them.
///
/// A sample is at fault where it is not a number, outside what can be, too far from where the last
/// good one led, overdue or too old, or, of the IMU, the same bit by bit again and again. In its
/// place joints go on with their velocity; torques, gyroscope and accelerometer hold the last good
/// value. Nothing of a faulty sample is kept. How long that may go on is for others to say: the
/// health has the age of the last good sample. Does not allocate.
class ReadingGuard {
 public:
  /// `period` of the control loop [s].
  ReadingGuard(const ReadingGuardOptions& options, const RobotDescription& robot, double period);

  /// One tick. `joint_velocity` is that of the last one [rad/s]. A reading whose clock is not a
  /// number, stands still, goes back, or leaps by more than 0.1 s brings no samples: all
  /// sensors are silent; but of encoders whose angles change from reading to reading it is told
  /// that they are late. So does the first after a leap of more than 4 periods, which is believed
  /// when the next goes on from there, by no more than half as far again.
  void update(const SensorReading& reading, const JointVector& joint_velocity) noexcept {
    update(reading, joint_velocity, reading);
  }
  /// The same with the reading as the driver gave it, `given`, where `reading` is corrected by what
  /// changes from tick to tick: numbers that stay the same bit by bit are looked for there.
  void update(const SensorReading& reading, const JointVector& joint_velocity,
              const SensorReading& given) noexcept;

  /// What the legs said in the tick before of the step that it doubts; counts for the next update.
  void judge_imu_step(ImuStep step) { imu_step_ = step; }

  /// Of a robot that is not controlled nobody knows how fast its joints turn: then no jump is too
  /// large for the next sample to confirm it.
  void set_loose(bool loose) { is_loose_ = loose; }

  /// Within `patience` the IMU's samples, or those of half of the joints, stepped further than
  /// walks show, believed or not: blow or fault.
  [[nodiscard]] bool is_shaken() const;

  /// False where the reading's clock was such.
  [[nodiscard]] bool clock_is_right() const { return clock_is_right_; }
  /// The reading with what is filled in, and the sample times that are believed (SampleWatch).
  [[nodiscard]] const SensorReading& repaired() const { return repaired_; }
  /// The same, but with NaN in the place of joint angles that are at fault, of a sample that was
  /// there before, as it says nothing of what the joints did meanwhile, or that is of another time
  /// than usual. Where the clock is
  /// wrong it has no time and no angles, or, when that lasts longer than `patience` and they
  /// change within 0.2 s, those of the reading's that can be.
  [[nodiscard]] const SensorReading& measured() const { return measured_; }
  [[nodiscard]] const SensorHealth& health() const { return health_; }
  /// repaired() with the IMU's samples as they came, where they can be, however far they stepped.
  [[nodiscard]] const SensorReading& offered() const { return offered_; }
  /// Time since each joint's last good angle [s].
  [[nodiscard]] JointVector encoder_age() const;
  /// How far what repaired() has of the joints, and of the IMU, is behind its time [s].
  [[nodiscard]] double joint_lag() const { return encoder_watch_.lag(); }
  [[nodiscard]] double imu_lag() const { return imu_watch_.lag(); }
  /// How late the samples of joint angles and torques usually come [s]: that one is later, or is
  /// held until the next, is no matter.
  [[nodiscard]] double encoder_delay() const { return encoder_watch_.delay(); }
  [[nodiscard]] double torque_delay() const { return torque_watch_.delay(); }

 private:
  /// One of the IMU's two instruments.
  struct Instrument {
    GuardedValues<3> values;
    Vec3 last = Vec3::Constant(kNaN);  // sample that can be, good or not, …
    double last_time = kNaN;           // … and when [s]
    double stepped = kNaN;             // when one was far from the one before [s]
    Vec3 given = Vec3::Constant(kNaN);
    double given_since = kNaN;  // of the first sample with these numbers [s]
    int repeats = 0;
  };

  [[nodiscard]] bool imu_is_shaken() const;
  /// Within `patience` both of its instruments stepped.
  [[nodiscard]] bool is_hit() const;
  [[nodiscard]] bool believes_imu_step();
  [[nodiscard]] bool goes_on(double time) noexcept;
  void miss(const SensorReading& reading, const JointVector& given_q) noexcept;
  [[nodiscard]] GuardedValues<kNumJoints>::Limits angle_limits(const JointVector& unseen) const;
  void take_joints(const SensorReading& reading, const JointVector& joint_velocity, double dt);
  void take_imu(const SensorReading& reading, const SensorReading& given);
  void note_step(Instrument& instrument, const Vec3& value, const Vec3& large, double range) const;
  void take(Instrument& instrument, const Vec3& value, const Vec3& given,
            const GuardedValues<3>::Limits& limits);
  void describe(const SensorReading& reading);

  ReadingGuardOptions options_;
  double period_;
  JointVector velocity_limit_, torque_limit_;
  SampleWatch encoder_watch_, torque_watch_, imu_watch_;
  GuardedValues<kNumJoints> angles_, torques_;
  Instrument gyro_, accelerometer_;
  double time_ = kNaN;
  double lost_ = kNaN;      // without a good sample for so long, any value is believed [s]
  double leapt_to_ = kNaN;  // by the clock of the reading before, if that was not believed [s]
  int missed_ = 0;          // readings since the last that was
  int still_ = 0;           // of these, readings since their angles changed
  bool moves_ = false;      // their angles change
  JointVector given_q_ = JointVector::Constant(kNaN);  // of the last, whatever its clock
  bool clock_is_right_ = true;
  bool is_loose_ = false;
  ImuStep imu_step_ = ImuStep::not_judged;
  SensorReading repaired_, measured_, offered_;
  SensorHealth health_;
};

}  // namespace surefoot
