#include "surefoot/simulation/sensor_link.hpp"

#include "surefoot/math/numbers.hpp"

#include <algorithm>
#include <utility>

namespace surefoot::simulation {

namespace {

/// A spike lasts for one tick.
double duration_of(const SensorFault& fault, double control_period) {
  return fault.kind == FaultKind::spike ? control_period : fault.duration;
}

/// Calls `change(value, other value)` on each value of the fault's sensor.
template <typename Change>
void change_values(const SensorFault& fault, SensorReading& reading, const SensorReading& other,
                   const Change& change) {
  const auto each = [&](auto& values, const auto& others, int only = -1) {
    for (std::size_t i = 0; i < static_cast<std::size_t>(values.size()); ++i) {
      if (only < 0 || static_cast<std::size_t>(only) == i) change(values[i], others[i]);
    }
  };
  const bool whole_imu = fault.sensor == FaultySensor::imu;
  if (fault.sensor == FaultySensor::encoders) each(reading.q, other.q, fault.joint);
  if (fault.sensor == FaultySensor::joint_torques) each(reading.torque, other.torque, fault.joint);
  if (whole_imu || fault.sensor == FaultySensor::gyro) each(reading.gyro, other.gyro);
  if (whole_imu || fault.sensor == FaultySensor::accelerometer)
    each(reading.accelerometer, other.accelerometer);
  if (fault.sensor == FaultySensor::foot_force)
    each(reading.foot_force, other.foot_force, fault.leg);
}

/// Takes the other reading's sample times, if the whole sensor is faulty.
void take_time(const SensorFault& fault, SensorReading& reading, const SensorReading& other) {
  if (fault.joint >= 0) return;
  if (fault.sensor == FaultySensor::encoders) reading.encoder_time = other.encoder_time;
  if (fault.sensor == FaultySensor::joint_torques) reading.torque_time = other.torque_time;
  if (fault.sensor == FaultySensor::imu) reading.imu_time = other.imu_time;
}

}  // namespace

SensorLink::SensorLink(const SensorOptions& options, double control_period)
    : control_period_(control_period),
      encoder_delay_(options.encoders.delay_ticks),
      torque_delay_(options.joint_torques.delay_ticks),
      imu_delay_(options.imu.delay_ticks),
      foot_delay_(options.foot_force.delay_ticks) {
  keep(std::max({encoder_delay_, torque_delay_, imu_delay_, foot_delay_}));
  for (const SensorFault& fault : options.faults) add(fault);
}

int SensorLink::usual_delay(FaultySensor sensor) const {
  if (sensor == FaultySensor::encoders) return encoder_delay_;
  if (sensor == FaultySensor::joint_torques) return torque_delay_;
  return sensor == FaultySensor::foot_force ? foot_delay_ : imu_delay_;
}

void SensorLink::add(const SensorFault& fault) {
  const int late = fault.kind == FaultKind::late ? static_cast<int>(fault.size) : 0;
  const int delay = usual_delay(fault.sensor) + late;
  keep(delay);
  faults_.push_back({.options = fault,
                     .end = fault.time + duration_of(fault, control_period_),
                     .delay = delay,
                     .before = received_});
}

void SensorLink::keep(int ticks) {
  const std::size_t size = static_cast<std::size_t>(ticks) + 1;
  if (size <= sent_.size()) return;
  std::vector<SensorReading> longer(size);
  // Before the oldest sample it is repeated.
  for (std::size_t ago = 0; ago < std::min(size, num_sent_); ++ago) {
    const auto known = static_cast<int>(std::min(ago, sent_.size() - 1));
    longer[(num_sent_ - 1 - ago) % size] = sent(known);
  }
  sent_ = std::move(longer);
}

void SensorLink::transmit(const SensorReading& sampled) noexcept {
  sent_[num_sent_++ % sent_.size()] = sampled;
  delay(sampled);
  for (Fault& fault : faults_) apply(fault);
}

const SensorReading& SensorLink::sent(int ticks_ago) const noexcept {
  const std::size_t ago = std::min(static_cast<std::size_t>(ticks_ago), num_sent_ - 1);
  return sent_[(num_sent_ - 1 - ago) % sent_.size()];
}

void SensorLink::delay(const SensorReading& sampled) noexcept {
  received_ = sampled;
  received_.q = sent(encoder_delay_).q;
  received_.encoder_time = sent(encoder_delay_).encoder_time;
  received_.torque = sent(torque_delay_).torque;
  received_.torque_time = sent(torque_delay_).torque_time;
  received_.gyro = sent(imu_delay_).gyro;
  received_.accelerometer = sent(imu_delay_).accelerometer;
  received_.imu_time = sent(imu_delay_).imu_time;
  received_.foot_force = sent(foot_delay_).foot_force;
}

void SensorLink::apply(Fault& fault) noexcept {
  const SensorFault& options = fault.options;
  const double time = received_.time;
  const bool active = time >= options.time - kTimeRounding && time < fault.end - kTimeRounding;
  if (!active || num_sent_ == 1) fault.before = received_;
  if (!active) return;
  const SensorReading& other = options.kind == FaultKind::late ? sent(fault.delay) : fault.before;
  change_values(options, received_, other, [&](double& value, double other_value) {
    switch (options.kind) {
      case FaultKind::stops:
      case FaultKind::nan:
        value = kNaN;
        break;
      case FaultKind::repeats:
      case FaultKind::late:
        value = other_value;
        break;
      case FaultKind::jump:
      case FaultKind::spike:
        value += options.size;
        break;
      case FaultKind::scaled:
        value *= options.size;
        break;
    }
  });
  const bool has_other_time = options.kind == FaultKind::stops ||
                              options.kind == FaultKind::repeats || options.kind == FaultKind::late;
  if (has_other_time) take_time(options, received_, other);
}

}  // namespace surefoot::simulation
