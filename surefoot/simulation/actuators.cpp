#include "surefoot/simulation/actuators.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot::simulation {

namespace {

double limited_by_speed(double torque, double qd, const ActuatorOptions& options) {
  const double speed = qd / options.no_load_speed;
  const double highest = options.stall_torque * std::clamp(1.0 - speed, 0.0, 1.0);
  const double lowest = -options.stall_torque * std::clamp(1.0 + speed, 0.0, 1.0);
  return std::clamp(torque, lowest, highest);
}

/// The nearest multiple of the quantum inside ± limit.
double quantised(double torque, double quantum, double limit) {
  constexpr double kRounding = 1e-9;  // 40 / 0.2 may come out just below 200
  if (quantum <= 0.0) return std::clamp(torque, -limit, limit);
  const double most = std::floor(limit / quantum + kRounding);
  return quantum * std::clamp(std::round(torque / quantum), -most, most);
}

}  // namespace

Actuators::Actuators(const ActuatorOptions& options, const JointVector& torque_limit,
                     double timestep)
    : options_(options),
      limit_(torque_limit),
      lag_(-std::expm1(-2.0 * kPi * options.bandwidth_hz * timestep)),
      delayed_(static_cast<std::size_t>(options.delay_ticks), JointVector::Zero()) {}

void Actuators::command(const JointVector& torque) noexcept {
  const JointVector clipped = torque.cwiseMin(limit_).cwiseMax(-limit_);
  if (options_.model == ActuatorModel::ideal || delayed_.empty()) {
    commanded_ = clipped;
    return;
  }
  commanded_ = delayed_[oldest_];
  delayed_[oldest_] = clipped;
  oldest_ = (oldest_ + 1) % delayed_.size();
}

JointVector Actuators::torque(const JointVector& qd) const noexcept {
  if (options_.model == ActuatorModel::ideal) return commanded_;
  JointVector result;
  for (Eigen::Index i = 0; i < result.size(); ++i) {
    const double limited = limited_by_speed(motor_[i], qd[i], options_);
    result[i] = quantised(limited, options_.quantisation, limit_[i]);
  }
  return result;
}

void Actuators::advance() noexcept {
  motor_ += lag_ * (options_.torque_gain * commanded_ - motor_);
}

}  // namespace surefoot::simulation
