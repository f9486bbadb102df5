#include "surefoot/simulation/sensors.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot::simulation {

Sensors::Sensors(const SensorOptions& options, double control_period, std::uint64_t seed)
    : options_(options),
      samples_per_tick_(std::min(1.0, options.rate_hz * control_period)),
      random_(seed),
      gyro_bias_(options.gyro_bias * normal_vector()),
      accelerometer_bias_(options.accelerometer_bias * normal_vector()) {}

void Sensors::accumulate(const Vec3& specific_force) noexcept {
  force_sum_ += specific_force;
  ++num_forces_;
}

void Sensors::read(const GroundTruth& truth, SensorReading& reading) noexcept {
  reading.time = truth.time;
  if (!sample_is_due()) return;
  read_joints(truth, reading);
  read_imu(truth, reading);
  if (options_.foot_force) read_feet(truth, reading);
}

bool Sensors::sample_is_due() noexcept {
  constexpr double kRounding = 1e-9;
  const double due = static_cast<double>(tick_++) * samples_per_tick_ + kRounding;
  const auto samples = static_cast<std::int64_t>(std::floor(due));
  if (samples == samples_) return false;
  samples_ = samples;
  return true;
}

Vec3 Sensors::normal_vector() noexcept {
  const double x = random_.normal();
  const double y = random_.normal();
  const double z = random_.normal();
  return {x, y, z};
}

void Sensors::read_joints(const GroundTruth& truth, SensorReading& reading) noexcept {
  const double step = options_.encoder_resolution;
  for (Eigen::Index i = 0; i < truth.q.size(); ++i) {
    reading.q[i] = step > 0.0 ? step * std::round(truth.q[i] / step) : truth.q[i];
    reading.torque[i] = truth.torque[i] + options_.torque_noise * random_.normal();
  }
}

void Sensors::read_imu(const GroundTruth& truth, SensorReading& reading) noexcept {
  const Vec3 at_rest = truth.q_WB.conjugate() * Vec3(0.0, 0.0, kGravity);
  const Vec3 specific_force = num_forces_ > 0 ? Vec3(force_sum_ / num_forces_) : at_rest;
  force_sum_.setZero();
  num_forces_ = 0;
  reading.gyro = truth.w_WB_B + gyro_bias_ + options_.gyro_noise * normal_vector();
  reading.accelerometer =
      specific_force + accelerometer_bias_ + options_.accelerometer_noise * normal_vector();
}

void Sensors::read_feet(const GroundTruth& truth, SensorReading& reading) noexcept {
  for (const Leg leg : kLegs) {
    const TrueContact& contact = truth.feet[index(leg)];
    reading.foot_force[index(leg)] =
        contact.force.dot(contact.normal) + options_.foot_force_noise * random_.normal();
  }
}

}  // namespace surefoot::simulation
