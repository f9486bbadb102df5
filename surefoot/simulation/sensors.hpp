#pragma once

#include "surefoot/signals/sensor_reading.hpp"
#include "surefoot/simulation/ground_truth.hpp"
#include "surefoot/simulation/plant_options.hpp"
#include "surefoot/simulation/random.hpp"

namespace surefoot::simulation {

/// Decides at each control tick whether a sensor has a new sample.
class SampleClock {
 public:
  SampleClock(double rate_hz, double control_period);

  /// Call once a tick; always true at the first.
  [[nodiscard]] bool is_due() noexcept;

 private:
  double samples_per_tick_;
  std::int64_t tick_ = 0;
  std::int64_t samples_ = -1;
};

/// Measures the truth: noisy rounded encoders, noisy torques, an IMU at the base frame, perhaps
/// tilted, with random and drifting biases, optional foot force sensors. Each has its rate and
/// holds a sample until the next.
///
/// The gyroscope gives the current angular velocity. The accelerometer gives the mean specific
/// force since its last sample, like strapdown IMUs, so that its integral is the change of velocity
/// also through impacts; before the first step the robot is at rest.
///
/// A sensor's noise at a tick depends on the seed alone, not on noise, rate or presence of the
/// others.
class Sensors {
 public:
  Sensors(const SensorOptions& options, double control_period, std::uint64_t seed);

  /// Specific force of the base over one physics step, in B [m/s²].
  void accumulate(const Vec3& specific_force) noexcept;
  /// Updates `reading` at a control tick.
  void read(const GroundTruth& truth, SensorReading& reading) noexcept;

 private:
  /// Standard normal deviates of one tick.
  struct Noise {
    JointVector torque;
    Vec3 gyro, accelerometer;
  };
  [[nodiscard]] Noise draw(Eigen::Index num_joints) noexcept;
  void drift() noexcept;
  void read_encoders(const GroundTruth& truth, SensorReading& reading) noexcept;
  void read_imu(const GroundTruth& truth, const Noise& noise, SensorReading& reading) noexcept;
  void read_feet(const GroundTruth& truth, SensorReading& reading) noexcept;

  SensorOptions options_;
  SampleClock encoder_clock_, torque_clock_, imu_clock_, foot_clock_;
  Random random_;  // for biases, torques and IMU
  Random encoder_random_, foot_random_, drift_random_;
  double control_period_;
  Quat q_BI_;  // orientation of the IMU's own frame I
  Vec3 gyro_bias_, accelerometer_bias_;
  Vec3 gyro_drift_ = Vec3::Zero(), accelerometer_drift_ = Vec3::Zero();
  Vec3 force_sum_ = Vec3::Zero();
  int num_forces_ = 0;
};

}  // namespace surefoot::simulation
