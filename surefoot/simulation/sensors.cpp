#include "surefoot/simulation/sensors.hpp"

#include "surefoot/math/random_bits.hpp"
#include "surefoot/math/rotation.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot::simulation {

namespace {

template <typename Vector>
Vector normal_vector(Random& random, Vector result = {}) {
  for (double& value : result) value = random.normal();
  return result;
}

/// One step of a Gauss–Markov process with this standard deviation and correlation time.
Vec3 drifted(const Vec3& drift, double deviation, double time, double step, Random& random) {
  const double kept = std::exp(-step / time);
  return kept * drift + deviation * std::sqrt(1.0 - kept * kept) * normal_vector<Vec3>(random);
}

}  // namespace

SampleClock::SampleClock(double rate_hz, double control_period)
    : samples_per_tick_(std::min(1.0, rate_hz * control_period)) {}

bool SampleClock::is_due() noexcept {
  constexpr double kRounding = 1e-9;
  const double due = static_cast<double>(tick_++) * samples_per_tick_ + kRounding;
  const auto samples = static_cast<std::int64_t>(std::floor(due));
  if (samples == samples_) return false;
  samples_ = samples;
  return true;
}

Sensors::Sensors(const SensorOptions& options, double control_period, std::uint64_t seed)
    : options_(options),
      encoder_clock_(options.encoders.rate_hz, control_period),
      torque_clock_(options.joint_torques.rate_hz, control_period),
      imu_clock_(options.imu.rate_hz, control_period),
      foot_clock_(options.foot_force.rate_hz, control_period),
      random_(seed),
      encoder_random_(named_bits(seed, "encoders")),
      foot_random_(named_bits(seed, "foot_force")),
      drift_random_(named_bits(seed, "imu_drift")),
      control_period_(control_period),
      q_BI_(from_roll_pitch_yaw(options.imu.tilt)),
      gyro_bias_(options.imu.gyro_bias * normal_vector<Vec3>(random_)),
      accelerometer_bias_(options.imu.accelerometer_bias * normal_vector<Vec3>(random_)) {}

void Sensors::accumulate(const Vec3& specific_force) noexcept {
  force_sum_ += specific_force;
  ++num_forces_;
}

// Draws noise at every tick, so that a rate changes no other noise.
void Sensors::read(const GroundTruth& truth, SensorReading& reading) noexcept {
  const Noise noise = draw(truth.q.size());
  reading.time = truth.time;
  if (reading.foot_force.size() != truth.feet.size())
    reading.foot_force = per_leg(kNaN, static_cast<int>(truth.feet.size()));
  drift();
  read_encoders(truth, reading);
  if (torque_clock_.is_due()) {
    reading.torque = truth.torque + options_.joint_torques.noise * noise.torque;
    reading.torque_time = truth.time;
  }
  if (imu_clock_.is_due()) read_imu(truth, noise, reading);
  if (options_.foot_force.present) read_feet(truth, reading);
}

Sensors::Noise Sensors::draw(Eigen::Index num_joints) noexcept {
  Noise noise;
  noise.torque = normal_vector(random_, JointVector(num_joints));
  noise.gyro = normal_vector<Vec3>(random_);
  noise.accelerometer = normal_vector<Vec3>(random_);
  return noise;
}

void Sensors::drift() noexcept {
  const ImuOptions& imu = options_.imu;
  gyro_drift_ =
      drifted(gyro_drift_, imu.gyro_drift, imu.gyro_drift_time, control_period_, drift_random_);
  accelerometer_drift_ = drifted(accelerometer_drift_, imu.accelerometer_drift,
                                 imu.accelerometer_drift_time, control_period_, drift_random_);
}

void Sensors::read_encoders(const GroundTruth& truth, SensorReading& reading) noexcept {
  const EncoderOptions& encoders = options_.encoders;
  JointVector q = truth.q + encoders.offset;
  if (encoders.noise > 0.0) q += encoders.noise * normal_vector(encoder_random_, q);
  if (!encoder_clock_.is_due()) return;
  const double step = encoders.resolution;
  for (double& angle : q) angle = step > 0.0 ? step * std::round(angle / step) : angle;
  reading.q = q;
  reading.encoder_time = truth.time;
}

void Sensors::read_imu(const GroundTruth& truth, const Noise& noise,
                       SensorReading& reading) noexcept {
  const ImuOptions& imu = options_.imu;
  const Vec3 at_rest = truth.q_SB.conjugate() * Vec3(0.0, 0.0, kGravity);
  const Vec3 specific_force = num_forces_ > 0 ? Vec3(force_sum_ / num_forces_) : at_rest;
  force_sum_.setZero();
  num_forces_ = 0;
  const Quat q_IB = q_BI_.conjugate();
  reading.gyro = q_IB * truth.w_SB_B + gyro_bias_ + gyro_drift_ + imu.gyro_noise * noise.gyro;
  reading.accelerometer = q_IB * specific_force + accelerometer_bias_ + accelerometer_drift_ +
                          imu.accelerometer_noise * noise.accelerometer;
  reading.imu_time = truth.time;
}

void Sensors::read_feet(const GroundTruth& truth, SensorReading& reading) noexcept {
  PerLeg<double> noise(static_cast<int>(truth.feet.size()), 0.0);
  for (double& number : noise) number = foot_random_.normal();
  reading.foot_force.resize(static_cast<int>(noise.size()));
  if (!foot_clock_.is_due()) return;
  for (const Leg leg : noise.legs()) {
    const TrueContact& contact = truth.feet[index(leg)];
    reading.foot_force[index(leg)] =
        contact.force.dot(contact.normal) + options_.foot_force.noise * noise[index(leg)];
  }
}

}  // namespace surefoot::simulation
