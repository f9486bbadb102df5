#include "surefoot/estimation/sensor_consistency.hpp"

#include <cmath>

namespace surefoot {
namespace {

void blame(GroupHealth& group, SampleFault fault, double age, int joint = -1) {
  group = {.fault = fault, .age = std::fmax(group.age, age), .joint = joint};
}

}  // namespace

void SensorConsistency::forget() noexcept {
  imu_.forget();
  torques_.forget();
}

void SensorConsistency::update(const SensorReading& reading, const ConsistencyInputs& known,
                               SensorHealth& health) noexcept {
  if (!enabled_) return;
  const bool is_new = reading.encoder_time > encoder_time_;
  encoder_time_ = reading.encoder_time;
  if (health.encoders.fault != SampleFault::none || health.imu.fault != SampleFault::none ||
      health.joint_torques.fault != SampleFault::none) {
    forget();  // what is filled in says nothing
    return;
  }
  imu_.update(reading, known.state, known.dynamics, known.stands, known.normal_W);
  frozen_.update(reading, known.dynamics, known.plan, known.command);
  torques_.update(known.state, known.dynamics, known.stands, known.command, is_new);
  if (imu_.wrong_for() > 0.0) blame(health.imu, SampleFault::contradicts, imu_.wrong_for());
  if (frozen_.encoder() >= 0)
    blame(health.encoders, SampleFault::repeats, frozen_.encoder_age(), frozen_.encoder());
  if (frozen_.torque() >= 0)
    blame(health.joint_torques, SampleFault::repeats, frozen_.torque_age(), frozen_.torque());
  if (torques_.wrong_for() > 0.0)
    blame(health.joint_torques, SampleFault::contradicts, torques_.wrong_for(), torques_.joint());
}

}  // namespace surefoot
