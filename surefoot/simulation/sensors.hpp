#pragma once

#include "surefoot/signals/sensor_reading.hpp"
#include "surefoot/simulation/ground_truth.hpp"
#include "surefoot/simulation/plant_options.hpp"
#include "surefoot/simulation/random.hpp"

namespace surefoot::simulation {

/// What the robot's sensors make of the truth: quantised encoders, noisy torques, an IMU at the
/// base frame with constant biases drawn from the seed, optional foot force sensors.
///
/// The gyroscope gives the angular velocity at the moment of the sample. The accelerometer gives
/// the mean specific force since its last sample, as strapdown IMUs do, so that its integral is the
/// change of velocity also through impacts; before the first step the robot is held at rest. With a
/// rate below the control rate a sample is held until the next one is due.
class Sensors {
 public:
  Sensors(const SensorOptions& options, double control_period, std::uint64_t seed);

  /// Specific force of the base over one physics step, in B [m/s²].
  void accumulate(const Vec3& specific_force) noexcept;
  /// Updates `reading` at a control tick.
  void read(const GroundTruth& truth, SensorReading& reading) noexcept;

 private:
  [[nodiscard]] bool sample_is_due() noexcept;
  [[nodiscard]] Vec3 normal_vector() noexcept;
  void read_joints(const GroundTruth& truth, SensorReading& reading) noexcept;
  void read_imu(const GroundTruth& truth, SensorReading& reading) noexcept;
  void read_feet(const GroundTruth& truth, SensorReading& reading) noexcept;

  SensorOptions options_;
  double samples_per_tick_;
  Random random_;
  Vec3 gyro_bias_;
  Vec3 accelerometer_bias_;
  Vec3 force_sum_ = Vec3::Zero();
  int num_forces_ = 0;
  std::int64_t tick_ = 0;
  std::int64_t samples_ = -1;
};

}  // namespace surefoot::simulation
