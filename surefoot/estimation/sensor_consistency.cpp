#include "surefoot/estimation/sensor_consistency.hpp"

#include <cmath>

namespace surefoot::estimation {
namespace {

constexpr double kSameForce = 12.0;        // of the IMU before and after an impact [m/s²]
constexpr double kSameTurn = 0.3;          // of the IMU before and after an impact [rad/s]
constexpr double kMaxWalkingForce = 25.0;  // sensed beyond g by a walking robot's base [m/s²]

void report(GroupHealth& group, SampleFault fault, double age, int joint = -1) {
  group = {.fault = fault, .age = std::fmax(group.age, age), .joint = joint};
}

}  // namespace

void SensorConsistency::forget() noexcept {
  legs_have_changed();
  imu_step_.forget();
  frozen_.forget();
  jumped_ = false;
}

void SensorConsistency::legs_have_changed() noexcept {
  imu_.forget();
  torques_.forget();
}

void SensorConsistency::update(const SensorReading& reading, const SensorReading& offered,
                               const ConsistencyInputs& known, SensorHealth& health) noexcept {
  if (!enabled_) return;
  const bool is_new = reading.encoder_time > encoder_time_;
  encoder_time_ = reading.encoder_time;
  // Replaced values are no evidence, except for one sample that waits for confirmation.
  const auto is_well = [](const GroupHealth& group) { return group.fault == SampleFault::none; };
  const bool encoders_ok = is_well(health.encoders), torques_ok = is_well(health.joint_torques),
             jumps = health.imu.fault == SampleFault::jump,
             imu_ok = is_well(health.imu) || (jumps && !jumped_);
  if (encoders_ok) {
    imu_step_.update(offered, reading, jumps, known.state, known.dynamics, known.stands,
                     known.normal_W);
  } else {
    imu_step_.forget();
  }
  // An impact of a single sample: its replacement was no motion.
  const bool is_over = jumped_ && is_well(health.imu) &&
                       (reading.accelerometer - held_force_).norm() < kSameForce &&
                       (reading.gyro - held_turn_).norm() < rate_ * kSameTurn;
  if (is_over) imu_.forget();
  jumped_ = jumps;
  held_force_ = reading.accelerometer;
  held_turn_ = reading.gyro;
  if (encoders_ok && imu_ok) {
    imu_.update(reading, known.state, known.dynamics, known.stands, known.normal_W);
  } else {
    imu_.forget();
  }
  // The IMU determines the requested joint motion.
  const bool is_shaken =
      imu_.tumbles(reading) || std::abs(reading.accelerometer.norm() - kGravity) > kMaxWalkingForce;
  if (encoders_ok && imu_ok && !is_shaken) {
    frozen_.update(reading, known.dynamics, known.stands, known.v_WF, known.command);
  } else {
    frozen_.forget();
  }
  if (encoders_ok && torques_ok && imu_ok && imu_.wrong_for() == 0.0) {
    torques_.update(known.state, known.dynamics, known.stands, known.command, is_new);
  } else {
    torques_.forget();
  }
  if (imu_.wrong_for() > 0.0) report(health.imu, SampleFault::contradicts, imu_.wrong_for());
  const FrozenJoints::Frozen &angles = frozen_.encoders(), &torques = frozen_.torques();
  if (angles.count > 0) report(health.encoders, SampleFault::repeats, angles.age, angles.joint);
  if (torques.count > 0 && torques_ok)
    report(health.joint_torques, SampleFault::repeats, torques.age, torques.joint);
  if (torques_.wrong_for() > 0.0)
    report(health.joint_torques, SampleFault::contradicts, torques_.wrong_for(), torques_.joint());
}

}  // namespace surefoot::estimation
